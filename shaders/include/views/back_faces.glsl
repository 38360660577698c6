// SPDX-License-Identifier: MIT
// The farthest back faces of all bodies in one view (techniques/raster_views/back_faces.h), as the faces
// that include/views/faces.glsl asks for.
#include "include/views/faces.glsl"

uniform sampler2D backDepth;    // 0 none
uniform sampler2D backSurface;  // outward normals; w: material + 1

float faceDepth(ivec2 texel, int face) { return texelFetch(backDepth, texel, 0).x; }
vec3 faceNormal(ivec2 texel, int face) { return texelFetch(backSurface, texel, 0).xyz; }

#ifdef PHOTON_BEAMS
uniform sampler2D backShape;

vec3 faceShape(ivec2 texel, int face) { return texelFetch(backShape, texel, 0).xyz; }
#endif
