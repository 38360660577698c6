// SPDX-License-Identifier: MIT
#include "framework/scene/dispersion.h"

#include <array>
#include <cmath>

#include "framework/scene/spectrum.h"

namespace kaustik::scene {
namespace {

constexpr double kHydrogenF = 486.1327;  // nm
constexpr double kHydrogenC = 656.2725;

double heliumInverseSquare() {
    return 1e6 / (kHeliumNanometers * kHeliumNanometers);
}

// Of four equations.
glm::dvec4 solve(std::array<std::array<double, 5>, 4> m) {
    for (std::size_t i = 0; i < 4; ++i) {
        std::size_t pivot = i;
        for (std::size_t r = i + 1; r < 4; ++r) {
            if (std::abs(m[r][i]) > std::abs(m[pivot][i])) pivot = r;
        }
        std::swap(m[i], m[pivot]);
        for (std::size_t r = 0; r < 4; ++r) {
            if (r == i) continue;
            const double factor = m[r][i] / m[i][i];
            for (std::size_t c = i; c < 5; ++c)
                m[r][c] -= factor * m[i][c];
        }
    }
    return {m[0][4] / m[0][0], m[1][4] / m[1][1], m[2][4] / m[2][2], m[3][4] / m[3][3]};
}

}  // namespace

Dispersion byAbbeNumber(double ior, double abbeNumber) {
    const double apart = dispersionPlace(kHydrogenF) - dispersionPlace(kHydrogenC);
    return {ior, {(ior - 1.0) / (abbeNumber * apart), 0.0, 0.0, 0.0}};
}

Dispersion byCauchy(const glm::dvec3& terms) {
    const double d = heliumInverseSquare();
    return {terms.x + d * (terms.y + d * terms.z),
            {terms.y + 2.0 * d * terms.z, terms.z, 0.0, 0.0}};
}

double sellmeierIndex(std::span<const glm::dvec2> terms, double nanometers) {
    const double square = 1e-6 * nanometers * nanometers;
    double index2 = 1.0;
    for (const glm::dvec2& term : terms)
        index2 += term.x * square / (square - term.y);
    return std::sqrt(index2);
}

// Least squares of the formula's index, even over the wavelengths, that keeps the d line.
Dispersion bySellmeier(std::span<const glm::dvec2> terms) {
    const double ior = sellmeierIndex(terms, kHeliumNanometers);
    // In units of the place at the short end, so that no power is small.
    const double unit = dispersionPlace(kShortestNanometers);
    std::array<std::array<double, 5>, 4> normal{};
    for (double nm = kShortestNanometers; nm <= kLongestNanometers; nm += 1.0) {
        const double x = dispersionPlace(nm) / unit;
        const std::array powers{x, x * x, x * x * x, x * x * x * x,
                                sellmeierIndex(terms, nm) - ior};
        for (std::size_t r = 0; r < 4; ++r) {
            for (std::size_t c = 0; c < 5; ++c)
                normal[r][c] += powers[r] * powers[c];
        }
    }
    const glm::dvec4 scaled = solve(normal);
    return {ior,
            {scaled.x / unit, scaled.y / std::pow(unit, 2), scaled.z / std::pow(unit, 3),
             scaled.w / std::pow(unit, 4)}};
}

const std::vector<NamedGlass>& namedGlasses() {
    const char* const schott = "Schott, optical glass data sheets, 2017";
    static const std::vector<NamedGlass> glasses{
        {"N-BK7",
         {{1.03961212, 0.00600069867}, {0.231792344, 0.0200179144}, {1.01046945, 103.560653}},
         1.5168,
         64.17,
         schott},
        {"N-LAK8",
         {{1.33183167, 0.00620023871}, {0.546623206, 0.0216465439}, {1.19084015, 82.5827736}},
         1.713,
         53.83,
         schott},
        {"N-F2",
         {{1.39757037, 0.00995906143}, {0.159201403, 0.0546931752}, {1.2686543, 119.248346}},
         1.62005,
         36.43,
         schott},
        {"N-SF11",
         {{1.73759695, 0.013188707}, {0.313747346, 0.0623068142}, {1.89878101, 155.23629}},
         1.78472,
         25.68,
         schott},
        {"N-SF6",
         {{1.77931763, 0.0133714182}, {0.338149866, 0.0617533621}, {2.08734474, 174.01759}},
         1.80518,
         25.36,
         schott},
        {"fused-silica",
         {{0.6961663, 0.0684043 * 0.0684043},
          {0.4079426, 0.1162414 * 0.1162414},
          {0.8974794, 9.896161 * 9.896161}},
         1.4585,
         67.82,
         "Malitson 1965, at 20 °C"},
        {"sapphire",
         {{1.4313493, 0.0726631 * 0.0726631},
          {0.65054713, 0.1193242 * 0.1193242},
          {5.3414021, 18.028251 * 18.028251}},
         1.7682,
         72.3,
         "Malitson and Dodge 1972, the ordinary ray"},
        {"diamond", {{0.3306, 0.175 * 0.175}, {4.3356, 0.106 * 0.106}}, 2.4175, 55.3, "Peter 1923"},
        {"acrylic", {{1.1819, 0.011313}}, 1.4906, 53.2, "Sultanova, Kasarova and Nikolov 2009"},
        {"water",
         {{0.5684027565, 0.005101829712},
          {0.1726177391, 0.01821153936},
          {0.02086189578, 0.02620722293},
          {0.1130748688, 10.69792721}},
         1.3334,
         55.8,
         "Daimon and Masumura 2007, at 20 °C"}};
    return glasses;
}

bool isPossible(const Dispersion& dispersion) {
    Material material;
    material.ior = static_cast<float>(dispersion.ior);
    material.dispersion = glm::vec4(dispersion.polynomial);
    for (double nm = kShortestNanometers; nm <= kLongestNanometers; nm += 5.0) {
        const double index = indexAt(material, dispersionPlace(nm));
        if (!(index >= 1.0 && index <= 10.0)) return false;
    }
    return true;
}

}  // namespace kaustik::scene
