// SPDX-License-Identifier: MIT
// The back faces of the transmitting objects, the farthest of each pixel (W05).
#include "include/surfaces/fragment_normal.glsl"
#include "include/surfaces/scene_fragment.glsl"
#include "include/surfaces/surface.glsl"
#ifdef SHAPES
#include "include/photons/beam.glsl"
#endif

layout(location = 0) out vec4 backDepth;
layout(location = 1) out vec4 backSurface;
#ifdef SHAPES
layout(location = 2) out vec4 backShape;  // shapeOf the normal, in the view's space
#endif

void main() {
    float depth = -positionVs.z;
    float extent = 0.5 * fwidth(depth);
    vec3 geometric = geometricNormal(positionVs, towardsViewer(positionVs));
    vec3 normal = fragmentNormal(geometric);
#ifdef SHAPES
    mat2x3 positions = mat2x3(dFdx(positionVs), dFdy(positionVs));
    backShape = vec4(shapeFrom(normal, positions, mat2x3(dFdx(normal), dFdy(normal))), 0.0);
#endif
    if (gl_FrontFacing) discard;
    backDepth = vec4(depth, extent, 0.0, 0.0);
    backSurface = vec4(normal, float(material + 1u));
}
