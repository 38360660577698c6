// SPDX-License-Identifier: MIT
// view.bvh: the pixels that have to be looked through; the others see what lies straight ahead. One
// thread a pixel. A device that runs all threads of a group through the longest of their ways then
// traces rays for those only that have one.
#include "view/bvh_pixels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

shared uint listedInGroup;
shared uint firstOfGroup;

// Threads that run together look at pixels that lie together: squares of squares.
ivec2 pixelOfThread() {
    uint i = gl_LocalInvocationIndex;
    uvec2 at = uvec2((i & 1u) | (i >> 1u & 2u) | (i >> 2u & 4u),
                     (i >> 1u & 1u) | (i >> 2u & 2u) | (i >> 3u & 4u));
    return ivec2(8u * gl_WorkGroupID.xy + at);
}

void seeStraight(ivec2 pixel) {
    storeExit(pixel, vec4(0.0), vec4(0.0));
    storeRadiance(pixel, radianceStraight(pixel));
}

void main() {
    ivec2 pixel = pixelOfThread();
    bool isInside = all(lessThan(pixel, ivec2(view.sizePixels.xy)));
    bool isListed = isInside && firstDepth(pixel) > 0.0;
    if (gl_LocalInvocationIndex == 0u) listedInGroup = 0u;
    barrier();
    uint place = 0u;
    if (isListed) place = atomicAdd(listedInGroup, 1u);
    barrier();
    if (gl_LocalInvocationIndex == 0u)
        firstOfGroup = atomicAdd(lookedThrough.count, listedInGroup);
    barrier();
    if (isListed) {
        listedPixels[firstOfGroup + place] = uint(pixel.x) | uint(pixel.y) << 16u;
    } else if (isInside) {
        seeStraight(pixel);
    }
}
