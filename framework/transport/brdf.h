// SPDX-License-Identifier: MIT
// How a receiver reflects: a Lambertian part and one glossy lobe, the modified Phong model of
// Lafortune and Willems 1994 ("Using the Modified Phong Reflectance Model for Physically Based
// Rendering", report CW 197, section 2):
//
//     f = albedo/pi + specular (n + 2)/(2 pi) max(cos a, 0)^n,   1/sr
//
// with a the angle between the mirror direction of the light and the eye. It is reciprocal. The
// lobe reflects exactly `specular` of what comes along the normal and less of all else, since the
// part of the lobe below the surface counts for nothing: with albedo + specular <= 1 no energy is
// gained. C++ (in double) and GLSL both read this file.
#pragma once

#ifdef __cplusplus
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
namespace kaustik::transport {
using Real = double;
using Real3 = glm::dvec3;
using glm::dot;
using std::max;
using std::pow;
#define KAUSTIK_INLINE [[nodiscard]] inline
#else
#define Real float
#define Real3 vec3
#define KAUSTIK_INLINE
#endif

// `normal`: shading normal on the side of the eye; `toLight`, `toEye`: all unit. Whether light and
// eye are on the same side of the surface is for the caller to say, by the geometric normal; where
// the shading normal has one of them on the other side there is no lobe.
KAUSTIK_INLINE Real3 receiverBrdf(Real3 albedo, Real3 specular, Real exponent, Real3 normal,
                                  Real3 toLight, Real3 toEye) {
    Real3 diffuse = albedo * Real(0.31830988618379067);
    Real cosLight = dot(normal, toLight);
    if (!(cosLight > Real(0.0) && dot(normal, toEye) > Real(0.0))) return diffuse;
    Real3 mirrored = Real(2.0) * cosLight * normal - toLight;
    Real cosine = max(dot(mirrored, toEye), Real(0.0));
    Real lobe = (exponent + Real(2.0)) * Real(0.15915494309189534) * pow(cosine, exponent);
    return diffuse + specular * lobe;
}

#undef KAUSTIK_INLINE
#ifdef __cplusplus
}  // namespace kaustik::transport
#endif
