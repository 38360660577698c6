// SPDX-License-Identifier: MIT
// What the eye sees where its ray meets no specular surface first. These pixels are marked by 1 in a
// depth buffer of zeros: shaders that look into specular surfaces do not run for them.
#include "include/views/view_outputs.glsl"
#include "include/views/view_sample.glsl"

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    radiance = radianceStraight(pixel);
    exitPosition = vec4(0.0);
    exitDirection = vec4(0.0);
    finishPixel();
    gl_FragDepth = firstDepth(pixel) > 0.0 ? 0.0 : 1.0;
}
