// SPDX-License-Identifier: MIT
// What a ray of the eye meets first, and what it sees where that is not specular.
#include "include/views/first_surface.glsl"
#include "framework/transport/octahedral.h"
#include "include/views/view.glsl"

// What the eye's ray sees that meets no specular surface: the receiver at the pixel's middle, unless
// the ray's is a nearer or a farther one, at an edge within the pixel; then that of the pixels
// next to which is nearest to it in depth.
vec4 radianceStraight(ivec2 pixel) {
#ifdef BESIDE_MIDDLE
    float depth = max(-texelFetch(sight, pixel, 0).x, 0.0);
    float middle = texelFetch(receiver, pixel, 0).x;
    float nearest = abs(depth - middle);
    vec3 normal = texelFetch(receiverSurface, pixel, 0).xyz;
    if (middle > 0.0 && nearest <= depthMargin(viewRay(vec2(pixel) + 0.5), middle, normal))
        return texelFetch(receiverRadiance, pixel, 0);
    ivec2 towards = ivec2(sampleOffset.x < 0.0 ? -1 : 1, sampleOffset.y < 0.0 ? -1 : 1);
    ivec2 best = pixel;
    for (int i = 1; i < 4; ++i) {
        ivec2 other = clamp(pixel + towards * ivec2(i & 1, i >> 1), ivec2(0),
                            ivec2(view.sizePixels.xy) - 1);
        float difference = abs(depth - texelFetch(receiver, other, 0).x);
        if (difference >= nearest) continue;
        nearest = difference;
        best = other;
    }
    return texelFetch(receiverRadiance, best, 0);
#else
    return texelFetch(receiverRadiance, pixel, 0);
#endif
}
