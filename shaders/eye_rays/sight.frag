// SPDX-License-Identifier: MIT
// The first surface that rays next to the pixels' middles see (SightTexel): of a receiver, where
// nothing specular lies before it, the depth is negative.
#include "framework/transport/octahedral.h"
#include "include/surfaces/fragment_normal.glsl"
#include "include/surfaces/scene_fragment.glsl"
#include "include/surfaces/surface.glsl"

layout(location = 0) out vec4 sight;
layout(location = 1) out vec4 sightSurface;

void main() {
    float depth = -positionVs.z;
    vec3 geometric = geometricNormal(positionVs, towardsViewer(positionVs));
    sight = vec4(isReceiver(materialKind(material)) ? -depth : depth, packUnitVector(geometric),
                 float(material + 1u));
    sightSurface = vec4(fragmentNormal(geometric), float(material + 1u));
}
