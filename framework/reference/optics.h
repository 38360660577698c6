// SPDX-License-Identifier: MIT
// A smooth dielectric interface in double precision: the laws of
// shaders/include/surfaces/fresnel.glsl.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace kaustik::reference {

struct Interface {
    double reflectance = 1.0;   // 1 for total internal reflection
    glm::dvec3 reflected{0.0};  // unit
    glm::dvec3 refracted{0.0};  // unit; zero for total internal reflection
};

// `direction`: unit, towards the surface; `normal`: unit, against it (their dot product < 0). Light
// comes from a medium of index `from` and goes on in one of index `to`. Unpolarised Fresnel.
[[nodiscard]] inline Interface interactAt(const glm::dvec3& direction, const glm::dvec3& normal,
                                          double from, double to) {
    const double eta = from / to;
    const double cosI = std::min(-glm::dot(direction, normal), 1.0);
    Interface result;
    result.reflected = direction + 2.0 * cosI * normal;
    const double transmitted2 = 1.0 - eta * eta * (1.0 - cosI * cosI);
    if (transmitted2 <= 0.0) return result;
    const double cosT = std::sqrt(transmitted2);
    result.refracted = eta * direction + (eta * cosI - cosT) * normal;
    const double s = (eta * cosI - cosT) / (eta * cosI + cosT);
    const double p = (cosI - eta * cosT) / (cosI + eta * cosT);
    result.reflectance = std::min(0.5 * (s * s + p * p), 1.0);
    return result;
}

}  // namespace kaustik::reference
