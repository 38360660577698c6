// SPDX-License-Identifier: MIT
// One depth layer: the nearest surface beyond the previous layer (Everitt 2001). The depth buffer
// holds view depth itself, scaled by a power of two and so without rounding: layers are told apart
// down to what 32-bit view depth can (hard cases 12, 13). COUNTED: memory was not cleared, and what
// a pixel's layers hold is defined as far as it has fragments.
#include "framework/transport/octahedral.h"
#include "include/surfaces/fragment_normal.glsl"
#include "include/surfaces/scene_fragment.glsl"
#include "include/surfaces/surface.glsl"

layout(location = 0) out vec4 layerDepth;
layout(location = 1) out vec4 layerSurface;

uniform sampler2DArray layerDepths;
uniform int layer;
uniform int before;  // the index of the layer before this one
#ifdef COUNTED
uniform sampler2D counts;
#endif

const float kDepthScale = 1.0 / 1048576.0;

void main() {
    float depth = -positionVs.z;
    // Derivatives, and so both normals, come before any discard.
    vec3 geometric = geometricNormal(positionVs, towardsViewer(positionVs));
    vec3 shading = fragmentNormal(geometric);
    if (layer > 0) {
#ifdef COUNTED
        if (layer >= int(texelFetch(counts, ivec2(gl_FragCoord.xy), 0).x)) discard;
#endif
        float depthBefore = texelFetch(layerDepths, ivec3(gl_FragCoord.xy, before), 0).x;
        if (depthBefore <= 0.0 || depth <= depthBefore) discard;
    }
    gl_FragDepth = min(depth * kDepthScale, 1.0 - 1.0 / 16777216.0);
    layerDepth = vec4(depth, packUnitVector(geometric), float(material + 1u));
    layerSurface = vec4(shading, float(material + 1u));
}
