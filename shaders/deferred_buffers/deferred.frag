// SPDX-License-Identifier: MIT
// Of a front or a back: its depth, its normal, with SHAPES how that turns, and with TRIANGLES which
// triangle it is; all in the view's space.
#include "include/surfaces/fragment_normal.glsl"
#include "include/surfaces/scene_fragment.glsl"
#include "include/surfaces/surface.glsl"
#ifdef SHAPES
#include "include/photons/beam.glsl"
#endif

layout(location = 0) out vec4 seenDepth;
layout(location = 1) out vec4 seenSurface;
#ifdef SHAPES
layout(location = 2) out vec4 seenShape;
#endif
#ifdef TRIANGLES
#ifdef SHAPES
layout(location = 3) out uvec4 seenTriangle;
#else
layout(location = 2) out uvec4 seenTriangle;
#endif
flat in uint objectSeen;
#endif
#ifndef ONCE
uniform int layer;
#endif

void main() {
    float depth = -positionVs.z;
    float extent = 0.5 * fwidth(depth);
    vec3 geometric = geometricNormal(positionVs, towardsViewer(positionVs));
    vec3 normal = fragmentNormal(geometric);
#ifdef SHAPES
    mat2x3 positions = mat2x3(dFdx(positionVs), dFdy(positionVs));
    seenShape = vec4(shapeFrom(normal, positions, mat2x3(dFdx(normal), dFdy(normal))), 0.0);
#endif
#ifndef ONCE
    bool isBack = !gl_FrontFacing && materialKind(material) == kMaterialDielectric &&
                  !isOpen(material);
#ifdef BACKS_FIRST
    if (layer == 1 && !isBack) discard;
#else
    if (isBack != (layer == 1)) discard;
#endif
#endif
#ifdef TRIANGLES
    seenTriangle = uvec4(objectSeen + 1u, uint(gl_PrimitiveID), 0u, 0u);
#endif
    seenDepth = vec4(depth, extent, 0.0, 0.0);
    seenSurface = vec4(normal, float(material + 1u));
}
