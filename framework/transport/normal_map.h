// SPDX-License-Identifier: MIT
// What a tangent-space normal map makes of a surface's normal (Blinn 1978, "Simulation of wrinkled
// surfaces"; the map's conventions are glTF 2.0's, section 3.9.3): x along growing u, y along
// growing v, which is upwards in the picture, z out of the surface. The directions of u and v are
// each triangle's own, brought to right angles with its interpolated normal. C++ (in double) and
// GLSL both read this file.
#pragma once

#ifdef __cplusplus
#include <cmath>
#include <glm/glm.hpp>
namespace kaustik::transport {
using Real = double;
using Real2 = glm::dvec2;
using Real3 = glm::dvec3;
using glm::cross;
using glm::dot;
using std::sqrt;
#define KAUSTIK_INLINE [[nodiscard]] inline
#else
#define Real float
#define Real2 vec2
#define Real3 vec3
#define KAUSTIK_INLINE
#endif

// `first`, `second`: steps along the triangle, m; `uvFirst`, `uvSecond`: what uv grows by over
// them; `normal`: unit, to the outside; `mapped`: of the map, of any length. Unit; `normal` where
// uv does not tell where it grows, or the map has no direction.
KAUSTIK_INLINE Real3 mappedNormal(Real3 normal, Real3 first, Real3 second, Real2 uvFirst,
                                  Real2 uvSecond, Real3 mapped) {
    Real turn = uvFirst.x * uvSecond.y - uvFirst.y * uvSecond.x;
    Real side = turn < Real(0.0) ? Real(-1.0) : Real(1.0);
    Real3 alongU = side * (uvSecond.y * first - uvFirst.y * second);
    Real3 alongV = side * (uvFirst.x * second - uvSecond.x * first);
    Real3 across = alongU - dot(alongU, normal) * normal;
    Real across2 = dot(across, across);
    if (!(turn != Real(0.0) && across2 > Real(1e-12) * dot(alongU, alongU))) return normal;
    Real3 tangent = across * (Real(1.0) / sqrt(across2));
    Real3 bitangent = cross(normal, tangent);
    if (dot(bitangent, alongV) < Real(0.0)) bitangent = -bitangent;
    Real3 turned = mapped.x * tangent + mapped.y * bitangent + mapped.z * normal;
    Real turned2 = dot(turned, turned);
    if (!(turned2 > Real(1e-12))) return normal;
    return turned * (Real(1.0) / sqrt(turned2));
}

#undef KAUSTIK_INLINE
#ifdef __cplusplus
}  // namespace kaustik::transport
#endif
