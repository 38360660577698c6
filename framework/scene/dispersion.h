// SPDX-License-Identifier: MIT
// How the index of refraction changes with the wavelength: what data sheets and scene files say, as
// Material::ior and Material::dispersion.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace kaustik::scene {

struct Dispersion {
    double ior = 1.5;            // on the d line
    glm::dvec4 polynomial{0.0};  // Material::dispersion
};

// Cauchy's formula with two terms. `abbeNumber`: (n_d - 1) / (n_F - n_C), above 0.
[[nodiscard]] Dispersion byAbbeNumber(double ior, double abbeNumber);
// n = A + B/λ² + C/λ⁴, λ in µm.
[[nodiscard]] Dispersion byCauchy(const glm::dvec3& terms);
// n² = 1 + Σ b λ²/(λ² - c), λ in µm: a term is (b, c), c in µm². Within 2e-5 of it in the visible.
[[nodiscard]] Dispersion bySellmeier(std::span<const glm::dvec2> terms);
// The formula itself; not a number where n² would be negative.
[[nodiscard]] double sellmeierIndex(std::span<const glm::dvec2> terms, double nanometers);

struct NamedGlass {
    std::string name;
    std::vector<glm::dvec2> sellmeier;
    double ior = 0.0;  // as its source has them, for who checks
    double abbeNumber = 0.0;
    std::string source;
};
[[nodiscard]] const std::vector<NamedGlass>& namedGlasses();

// Whether the index is a number and at least 1 from 380 to 700 nm.
[[nodiscard]] bool isPossible(const Dispersion& dispersion);

}  // namespace kaustik::scene
