// SPDX-License-Identifier: MIT
// The nearest fragments of each pixel's list, sorted, become its layers, unless lists do not hold
// all fragments of the view. At equal depth the triangle drawn first stays alone, as in peeling
// (hard case 12). Memory has not been cleared: a depth of 0 is stored where each pixel's layers end
// and wherever another pixel of the workgroup has a layer (LayeredDepth). One thread a pixel.
#include "layered_depth/fragment_lists_fit.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform ivec2 firstPixel;  // of those that are asked for
layout(r32ui) readonly uniform uimage2D heads;
layout(rgba32f) writeonly uniform image2DArray layerDepths;
layout(rgba32f) writeonly uniform image2DArray layerSurfaces;
layout(std430) readonly buffer FragmentDepths {
    uvec4 fragmentDepths[];
};
layout(std430) readonly buffer FragmentSurfaces {
    uvec4 fragmentSurfaces[];
};
layout(std430) readonly buffer FragmentTriangles {
    uint fragmentTriangles[];
};

// So many layers are sorted at once, in registers, all indices being constant: a list is walked once
// for each eight.
const int kChunkSize = 8;
const float kNoDepth = 3.0e38;

shared int maxLayers;  // of the workgroup's pixels

void store(ivec2 pixel, int layer, uint place) {
    uvec3 words = fragmentDepths[place].xyz;
    uvec4 surface = fragmentSurfaces[place];
    float material = float(surface.w + 1u);
    ivec3 texel = ivec3(pixel, face * layerCount + layer);
    imageStore(layerDepths, texel, vec4(uintBitsToFloat(words), material));
    imageStore(layerSurfaces, texel, vec4(uintBitsToFloat(surface.xyz), material));
}

// Stores the layers of a pixel; how many there are.
int storeLayers(ivec2 pixel) {
    float reached = -kNoDepth;  // the depth of the last layer that is stored
    int layer = 0;
    while (layer < layerCount && reached < kNoDepth) {
        float depths[kChunkSize];
        uint places[kChunkSize];
        uint triangles[kChunkSize];
        for (int i = 0; i < kChunkSize; ++i) depths[i] = kNoDepth;
        uint next = imageLoad(heads, pixel).x;
        while (next != 0u) {
            uint place = next - 1u;
            float depth = uintBitsToFloat(fragmentDepths[place].x);
            next = fragmentDepths[place].w;
            uint triangle = fragmentTriangles[place];
            if (depth <= reached) depth = kNoDepth;
            // Whatever it is nearer than moves on by a layer, the last one out.
            for (int i = 0; i < kChunkSize; ++i) {
                float depthThere = depths[i];
                bool isTwice = depth == depthThere;
                if (depth < depthThere || (isTwice && triangle < triangles[i])) {
                    uint there = places[i];
                    uint triangleThere = triangles[i];
                    depths[i] = depth;
                    places[i] = place;
                    triangles[i] = triangle;
                    depth = depthThere;
                    place = there;
                    triangle = triangleThere;
                }
                // Of two at one depth the other goes no farther.
                if (isTwice) depth = kNoDepth;
            }
        }
        reached = depths[kChunkSize - 1];
        for (int left = kChunkSize; left > 0 && layer < layerCount && depths[0] < kNoDepth; --left) {
            store(pixel, layer++, places[0]);
            for (int i = 1; i < kChunkSize; ++i) {
                depths[i - 1] = depths[i];
                places[i - 1] = places[i];
            }
            depths[kChunkSize - 1] = kNoDepth;
        }
    }
    return layer;
}

void main() {
    ivec2 pixel = firstPixel + ivec2(gl_GlobalInvocationID.xy);
    if (gl_LocalInvocationIndex == 0u) maxLayers = 0;
    barrier();
    bool isPixel = all(lessThan(pixel, imageSize(heads))) && listsFit();
    int layers = isPixel ? storeLayers(pixel) : layerCount;
    if (isPixel) atomicMax(maxLayers, layers);
    barrier();
    int end = min(maxLayers + 1, layerCount);
    for (int layer = layers; layer < end; ++layer)
        imageStore(layerDepths, ivec3(pixel, face * layerCount + layer), vec4(0.0));
}
