// SPDX-License-Identifier: MIT
// Surfaces as fragments see them: materials, patterns, and normals on the side they belong to.
#include "include/surfaces/albedo.glsl"

// Reflectance at `uv`, patterns box-filtered over the pixel. Needs derivatives: fragments only.
vec3 surfaceAlbedo(uint material, vec2 uv) {
    // Derivatives of what was interpolated only: where a triangle covers a part of a 2x2 block, the
    // other pixels' reads from buffers may give nothing.
    return albedoOver(material, uv, dFdx(uv), dFdy(uv));
}

// From a surface towards whoever sees it; of any length.
vec3 towardsViewer(vec3 positionVs) {
#ifdef ORTHOGRAPHIC_VIEW
    return vec3(0.0, 0.0, 1.0);
#else
    return -positionVs;
#endif
}

// The unit normal of the triangle, towards the side that its winding calls the outside.
vec3 geometricNormal(vec3 positionVs, vec3 towardsViewer) {
    vec3 n = cross(dFdx(positionVs), dFdy(positionVs));
    float size = length(n);
    n = size > 0.0 ? n / size : towardsViewer;
    bool facesViewer = dot(n, towardsViewer) > 0.0;
    return facesViewer == gl_FrontFacing ? n : -n;
}
