// SPDX-License-Identifier: MIT
// The homogeneous medium that fills the scene, next to and inside of its dielectrics: what light
// loses on a path, and what is scattered. For photons it ends at the scene's bounding box; the
// straight ray to the eye loses light to it all the way (the reference's light_tracing.h does the
// same).
#include "include/surfaces/dielectrics.glsl"
#include "include/photons/transfer_map.glsl"
#include "include/views/view.glsl"

// Of the scene's medium and of the innermost dielectric around a photon, 1/m.
vec3 extinctionAround(uint media) {
    return tinted(view.mediumExtinction.rgb) + mediumAbsorption(innerMedium(media));
}

// Where a ray enters and leaves the scene's bounding box, in lengths of `direction`; the first is
// larger for a ray that misses it. A ray along a face counts as inside: surfaces lie in faces.
vec2 boundsInterval(vec3 positionVs, vec3 direction) {
    mat3 toWorld = mat3(view.viewToWorld);
    vec3 o = toWorld * (positionVs - view.boundsCenterVs.xyz);
    vec3 d = toWorld * direction;
    vec3 extent = view.boundsHalfExtent.xyz - view.boundsHalfExtent.w;
    vec2 interval = vec2(-3.0e38, 3.0e38);
    for (int axis = 0; axis < 3; ++axis) {
        if (d[axis] == 0.0) continue;
        float middle = -o[axis] / d[axis];
        float reach = extent[axis] / abs(d[axis]);
        interval = vec2(max(interval.x, middle - reach), min(interval.y, middle + reach));
    }
    return interval;
}

// The phase function of Henyey and Greenstein, 1/sr; `cosine`: of the angle of deflection.
float phaseFunction(float cosine) {
    float g = view.mediumScattering.w;
    float denominator = max(1.0 + g * g - 2.0 * g * cosine, 1e-12);
    return (1.0 - g * g) * inversesqrt(denominator) / (4.0 * 3.14159265 * denominator);
}
