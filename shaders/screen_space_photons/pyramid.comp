// SPDX-License-Identifier: MIT
// One level of the layers' depth pyramid: for each square and layer the range of depths over which a
// ray may meet the layer there, margins included; an empty range (y <= 0) where it has no fragment.
#include "common/view.glsl"
#include "screen_space_photons/pyramid_layout.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(rg32f) uniform image2DArray pyramid;
uniform sampler2DArray layerDepths;
uniform int level;

void main() {
    ivec2 pixels = textureSize(layerDepths, 0).xy;
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(texel.xy, pyramidSize(pixels, level)))) return;
    ivec2 first = 4 * texel.xy;
    ivec2 end = min(first + 4, level == 1 ? pixels : pyramidSize(pixels, level - 1));
    ivec2 below = level == 1 ? ivec2(0) : pyramidOffset(pixels, level - 1);
    vec2 range = vec2(3e38, 0.0);
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) {
            vec2 part;
            if (level == 1) {
                vec2 depth = texelFetch(layerDepths, ivec3(x, y, texel.z), 0).xy;
                // As wide as the hit test's first question (common/hit_test.glsl, testStep).
                float margin = depth.y + pixelFootprint(depth.x);
                part = depth.x > 0.0 ? vec2(depth.x - margin, depth.x + margin) : vec2(3e38, 0.0);
            } else {
                part = imageLoad(pyramid, ivec3(below + ivec2(x, y), texel.z)).xy;
            }
            range = vec2(min(range.x, part.x), max(range.y, part.y));
        }
    }
    imageStore(pyramid, ivec3(pyramidOffset(pixels, level) + texel.xy, texel.z),
               vec4(range, 0.0, 0.0));
}
