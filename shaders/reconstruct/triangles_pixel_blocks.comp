// SPDX-License-Identifier: MIT
// reconstruct.triangles: which squares of the view's pixels show one surface, before any light comes.
// One thread a square.
#include "include/thread.glsl"
#include "include/views/continued_plane.glsl"
#include "reconstruct/triangles_patch.glsl"
#include "reconstruct/triangles_pixel_blocks.glsl"

// Cosine between the normals of pixels that one stands for: what falls on them differs by less than
// a few per cent, and on average by nothing.
const float kMinBlockCosine = 0.9995;

const vec4 kSeveralSurfaces = vec4(0.0, -1.0, 0.0, 0.0);

vec4 receiverOfBlock(ivec2 corner) {
    if (any(greaterThan(corner + kPixelBlockSide, ivec2(view.sizePixels.xy)))) return kSeveralSurfaces;
    ivec2 middle = corner + kPixelBlockSide / 2;
    float depth = receiverAt(middle).x;
    vec3 normal = receiverSurfaceAt(middle).xyz;
    vec2 at = vec2(middle) + 0.5;
    vec3 point = viewPoint(at, depth);
    float margin = depthMargin(viewRay(at), depth, normal);
    float area = 0.0;
    vec3 normals = vec3(0.0);
    for (int i = 0; i < kPixelBlockSide * kPixelBlockSide; ++i) {
        ivec2 pixel = corner + ivec2(i % kPixelBlockSide, i / kPixelBlockSide);
        PixelParts parts = partsOf(pixel);
        vec2 seen = parts.middle;
        if (parts.count > 1 || (seen.x == 0.0) != (depth == 0.0)) return kSeveralSurfaces;
        if (depth == 0.0) continue;
        vec3 own = receiverSurfaceAt(pixel).xyz;
        bool isSame = dot(own, normal) >= kMinBlockCosine &&
                      continuesPlane(point, normal, margin, vec2(pixel) + 0.5, seen.x, own);
        if (!isSame) return kSeveralSurfaces;
        area += seen.y;
        normals += own;
    }
    if (depth == 0.0) return vec4(0.0);
    vec3 mean = normalize(normals);
    vec3 ray = viewRay(vec2(middle));
    float onPlane = depthOnPlane(vec2(middle), mean, point, boundedSlant(dot(mean, ray), 1e-4));
    return vec4(onPlane, area / float(kPixelBlockSide * kPixelBlockSide), packUnitVector(mean));
}

void main() {
    ivec2 blocks = blocksOfView();
    uint index = threadNumber();
    if (index >= uint(blocks.x * blocks.y)) return;
    ivec2 block = ivec2(index % uint(blocks.x), index / uint(blocks.x));
    pixelBlocks[index].receiver = receiverOfBlock(kPixelBlockSide * block);
    pixelBlocks[index].sums = uint[6](0u, 0u, 0u, 0u, 0u, 0u);
}
