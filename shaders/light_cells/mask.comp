// SPDX-License-Identifier: MIT
// A level of the mask: the finest from what a light's texels see, the others from the four cells
// below. A cell that touches a specular texel has something specular; one that touches another texel
// has something else. One thread a cell.
#include "light_cells/mask.glsl"
#include "include/surfaces/surface_data.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430) buffer NextMask {
    uvec2 nextMask[];
};
uniform uint level;
#ifdef FINEST
uniform sampler2DArray deferredSurface;
uniform int lightIndex;
uniform vec2 cellsOfView;
#endif

void main() {
    uvec2 cell = gl_GlobalInvocationID.xy;
    uint side = 1u << level;
    if (any(greaterThanEqual(cell, uvec2(side)))) return;
    uint entry = maskEntry(cell.x, cell.y, level);
#ifdef FINEST
    vec2 size = vec2(textureSize(deferredSurface, 0).xy);
    vec2 low = (0.5 + (vec2(cell) / float(side) - 0.5) * cellsOfView) * size;
    vec2 high = (0.5 + (vec2(cell + 1u) / float(side) - 0.5) * cellsOfView) * size;
    // What the middle of a texel does not see may still reach a photon next to it.
    uvec2 begin = uvec2(max(floor(low) - 1.0, vec2(0.0)));
    uvec2 end = uvec2(min(ceil(high) + 1.0, size));
    bool isSomewhere = false;
    bool isEverywhere = true;
    for (uint y = begin.y; y < end.y; ++y) {
        for (uint x = begin.x; x < end.x; ++x) {
            float material = texelFetch(deferredSurface, ivec3(x, y, 0), 0).w;
            bool isSpecular = material > 0.0 && !isReceiver(materialKind(uint(material) - 1u));
            isSomewhere = isSomewhere || isSpecular;
            isEverywhere = isEverywhere && isSpecular;
        }
    }
    uint word = entry + uint(lightIndex) / 32u;
    uint bit = uint(lightIndex) % 32u;
    uvec2 before = bit == 0u ? uvec2(0u) : nextMask[word];
    nextMask[word] = before | (uvec2(isSomewhere, isEverywhere) << bit);
#else
    for (uint word = 0u; word < maskWords; ++word) {
        uvec2 mask = uvec2(0u, 0xffffffffu);
        for (uint i = 0u; i < 4u; ++i) {
            uvec2 part = nextMask[maskEntry(2u * cell.x + (i & 1u), 2u * cell.y + (i >> 1u),
                                            level + 1u) + word];
            mask = uvec2(mask.x | part.x, mask.y & part.y);
        }
        nextMask[entry + word] = mask;
    }
#endif
}
