// SPDX-License-Identifier: MIT
// What surfaces of a cube's layers are told apart by when they are put into slots: which way they
// face on which material, and how many of these the texel has had before.
#include "framework/transport/octahedral.h"
#include "include/views/view.glsl"

uniform sampler2DArray layerDepths;
uniform int layerCount;

const uint kKinds = 256u;
const int kMaxLayers = 8;
const uint kNoSlot = 15u;

ivec3 layerTexel(ivec2 texel, int layer) {
    return ivec3(texel, viewIndex * layerCount + layer);
}

// The kinds of a texel's layers; how many there are.
int kindsAt(ivec2 texel, out uint kinds[kMaxLayers]) {
    int count = 0;
    vec3 ray = viewRay(vec2(texel) + 0.5);
    uint sides[kMaxLayers];
    for (int layer = 0; layer < kMaxLayers; ++layer) {
        kinds[layer] = 0u;
        sides[layer] = 0u;
        if (layer >= layerCount || layer > count) continue;
        vec4 data = texelFetch(layerDepths, layerTexel(texel, layer), 0);
        if (data.x <= 0.0) continue;
        bool isFront = dot(unpackUnitVector(data.yz), ray) < 0.0;
        uint side = 2u * uint(data.w) + (isFront ? 1u : 0u);
        uint before = 0u;
        for (int i = 0; i < layer; ++i) before += sides[i] == side ? 1u : 0u;
        sides[layer] = side;
        kinds[layer] = (side * uint(kMaxLayers) + before) % kKinds;
        ++count;
    }
    return count;
}

// The texel of a thread, whose face becomes the view; whether there is one.
bool texelOfThread(uvec2 id, out ivec2 texel) {
    ivec2 size = ivec2(view.sizePixels.xy);
    viewIndex = int(id.y) / size.y;
    texel = ivec2(id.x, int(id.y) % size.y);
    return int(id.x) < size.x && viewIndex < viewCount;
}
