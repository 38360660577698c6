// SPDX-License-Identifier: MIT
// Radiance as a picture: exposure, a shoulder above which highlights are compressed (luminance
// only, so that hues stay), sRGB.
#include "include/maps/srgb.glsl"

layout(location = 0) out vec4 display;

uniform sampler2D radiance;
uniform float exposure;

void main() {
    vec3 color = max(texelFetch(radiance, ivec2(gl_FragCoord.xy), 0).rgb * exposure, vec3(0.0));
    float luminance = dot(color, vec3(0.2126, 0.7152, 0.0722));
    const float shoulder = 0.7;
    if (luminance > shoulder) {
        float over = luminance - shoulder;
        float compressed = shoulder + (1.0 - shoulder) * over / (over + 1.0 - shoulder);
        color *= compressed / luminance;
    }
    display = vec4(encodeSrgb(color), 1.0);
}
