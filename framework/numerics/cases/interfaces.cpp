// SPDX-License-Identifier: MIT
// C19 to C25 on include/surfaces/fresnel.glsl against Fresnel's equations and Snell's law in
// double.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "framework/numerics/cases/common_cases.h"
#include "framework/numerics/lab.h"
#include "framework/numerics/probe.h"

namespace kaustik::numerics {
namespace {

constexpr const char* kFile = "include/surfaces/fresnel.glsl";
const Tolerance kDirection{3e-7, "some roundings of 6e-8 in the components of a unit vector"};

struct Incidence {
    glm::vec3 direction;
    glm::vec3 normal;
    float from;
    float to;
};

struct Result {
    glm::dvec3 refracted;
    glm::dvec3 reflected;
    double reflectance;
};

std::vector<Result> interact(Lab& lab, const std::vector<Incidence>& incidences) {
    std::vector<glm::vec4> inputs;
    for (const Incidence& i : incidences) {
        inputs.emplace_back(i.direction, i.from);
        inputs.emplace_back(i.normal, i.to);
    }
    const std::vector<glm::vec4> outputs = probe(lab.context(), "numerics/fresnel.comp", inputs,
                                                 static_cast<int>(incidences.size()), 2);
    std::vector<Result> results;
    for (std::size_t i = 0; i < incidences.size(); ++i) {
        results.push_back({glm::dvec3(outputs[2 * i]), glm::dvec3(outputs[2 * i + 1]),
                           static_cast<double>(outputs[2 * i].w)});
    }
    return results;
}

// In the xy-plane, at an angle from the normal +y.
Incidence at(double radians, double from, double to) {
    return {glm::vec3(glm::dvec3(std::sin(radians), -std::cos(radians), 0.0)), glm::vec3(0, 1, 0),
            static_cast<float>(from), static_cast<float>(to)};
}

// Unpolarised reflectance for the inputs as the shader gets them: 32-bit.
double exactReflectance(const Incidence& i) {
    const glm::dvec3 d(i.direction);
    const double eta = static_cast<double>(i.from) / static_cast<double>(i.to);
    const double cosI = std::abs(d.y) / glm::length(d);
    const double sin2 = eta * eta * (d.x * d.x + d.z * d.z) / glm::dot(d, d);
    if (sin2 >= 1.0) return 1.0;
    const double cosT = std::sqrt(1.0 - sin2);
    const double s = (eta * cosI - cosT) / (eta * cosI + cosT);
    const double p = (cosI - eta * cosT) / (cosI + eta * cosT);
    return 0.5 * (s * s + p * p);
}

// How many numbers of the results are none.
int notFinite(const std::vector<Result>& results) {
    int count = 0;
    for (const Result& r : results) {
        const double sum = r.reflectance + glm::dot(r.refracted, glm::dvec3(1)) +
                           glm::dot(r.reflected, glm::dvec3(1));
        count += std::isfinite(sum) ? 0 : 1;
    }
    return count;
}

void equalMedia(Lab& lab) {
    const auto results = interact(lab, {at(0.0, 1.5, 1.5), at(0.7, 1.5, 1.5), at(1.57, 1.0, 1.0)});
    double worst = 0.0;
    for (const Result& r : results)
        worst = std::max(worst, r.reflectance);
    lab.expectDeviation(kFile, "reflectance at 0, 0.7 and 1.57 rad", worst,
                        {1e-12,
                         "numerator and denominator cancel exactly but for roundings, which "
                         "are squared: (6e-8)²"});
    const glm::dvec3 expected(std::sin(0.7), -std::cos(0.7), 0.0);
    lab.expectDeviation(kFile, "change of direction at 0.7 rad, rad",
                        glm::length(results[1].refracted - expected), kDirection);
}

void normalIncidence(Lab& lab) {
    const Tolerance fourUlp{1.5e-8, "four steps of a 32-bit float at 0.04"};
    lab.expect(kFile, "reflectance into glass of 1.5", 0.04,
               interact(lab, {at(0.0, 1.0, 1.5)}).front().reflectance, fourUlp);
    lab.expect(kFile, "reflectance out of glass of 1.5", 0.04,
               interact(lab, {at(0.0, 1.5, 1.0)}).front().reflectance, fourUlp);
}

void grazingIncidence(Lab& lab) {
    const double quarter = glm::half_pi<double>();
    const std::vector<Incidence> incidences = {at(quarter, 1.0, 1.5), at(quarter - 1e-6, 1.0, 1.5),
                                               at(quarter, 1.0, 1.0)};
    const auto results = interact(lab, incidences);
    lab.expect(kFile, "results that are not finite", 0, notFinite(results), kExactly);
    lab.expect(kFile, "reflectance 1e-6 rad from grazing", exactReflectance(incidences[1]),
               results[1].reflectance, {3e-7, "some steps of a 32-bit float at 1"});
    double worst = 0.0;
    for (const Result& r : results)
        worst = std::max(worst, std::abs(glm::length(r.reflected) - 1.0));
    lab.expectDeviation(kFile, "length of the reflected direction, less 1", worst, kDirection);
}

void aboveTheCriticalAngle(Lab& lab) {
    const double critical = std::asin(1.0 / 1.5);
    const auto results = interact(lab, {at(critical + 1e-6, 1.5, 1.0), at(1.2, 1.5, 1.0),
                                        at(glm::half_pi<double>(), 1.5, 1.0)});
    for (const Result& r : results)
        lab.expect(kFile, "reflectance", 1.0, r.reflectance, kExactly);
    lab.expect(kFile, "results that are not finite", 0, notFinite(results), kExactly);
    double refracted = 0.0;
    for (const Result& r : results)
        refracted = std::max(refracted, glm::length(r.refracted));
    lab.expectDeviation(kFile, "length of the refracted direction", refracted, kExactly);
}

void belowTheCriticalAngle(Lab& lab) {
    const double critical = std::asin(1.0 / 1.5);
    for (const double below : {1e-4, 1e-5, 1e-6, 1e-7}) {
        const Incidence incidence = at(critical - below, 1.5, 1.0);
        // The inputs are floats, which moves the angle itself by up to 6e-8 rad: the exact value is
        // that of the floats that the shader sees. At 1e-6 rad it is 0.00865 in the real numbers.
        const double exact = 1.0 - exactReflectance(incidence);
        lab.expect(kFile, fmt::format("1 - R at {:.0e} rad below the angle", below), exact,
                   1.0 - interact(lab, {incidence}).front().reflectance,
                   {2.4e-7, "four steps of a 32-bit R near 1"});
    }
}

void brewstersAngle(Lab& lab) {
    const double brewster = std::atan(1.5);
    const double inside = std::sqrt(2.25 - std::sin(brewster) * std::sin(brewster));
    const double rs = (std::cos(brewster) - inside) / (std::cos(brewster) + inside);
    lab.expect(kFile, "R, which is half of R_s where R_p is 0", 0.5 * rs * rs,
               interact(lab, {at(brewster, 1.0, 1.5)}).front().reflectance,
               {3e-8, "four steps of a 32-bit float at 0.074"});
    double worst = 0.0;
    double worstSnell = 0.0;
    std::vector<Incidence> incidences;
    for (const auto& [from, to] :
         {std::pair(1.0, 1.5), std::pair(1.5, 1.0), std::pair(1.0, 1.333), std::pair(2.4, 1.333)}) {
        for (int degrees = 0; degrees < 90; ++degrees)
            incidences.push_back(at(glm::radians(static_cast<double>(degrees)), from, to));
    }
    const std::vector<Result> results = interact(lab, incidences);
    for (std::size_t i = 0; i < incidences.size(); ++i) {
        const Incidence& in = incidences[i];
        const double exact = exactReflectance(in);
        worst = std::max(worst, std::abs(results[i].reflectance - exact));
        if (exact >= 1.0) continue;
        const double eta = static_cast<double>(in.from) / static_cast<double>(in.to);
        worstSnell = std::max(worstSnell, std::abs(results[i].refracted.x -
                                                   eta * static_cast<double>(in.direction.x)));
    }
    lab.expectDeviation(kFile, "R at every degree between four pairs of media", worst,
                        {2e-6,
                         "cosines of 6e-8 in a difference that R amplifies up to thirtyfold "
                         "where it climbs to 1"});
    lab.expectDeviation(kFile, "Snell's law at every degree, as a sine", worstSnell, kDirection);
}

void planeParallelSlab(Lab& lab) {
    const double angle = 0.8;
    const Result in = interact(lab, {at(angle, 1.0, 1.5)}).front();
    const Result out =
        interact(lab, {{glm::vec3(in.refracted), glm::vec3(0, 1, 0), 1.5f, 1.0f}}).front();
    const glm::dvec3 entry(std::sin(angle), -std::cos(angle), 0.0);
    lab.expectDeviation(kFile, "exit direction, less the entry's",
                        glm::length(out.refracted - entry), kDirection);
    // Sideways from the straight line, for a thickness of 1.
    const double exact = std::asin(std::sin(angle) / 1.5);
    const double shift = std::sin(angle - exact) / std::cos(exact);
    const glm::dvec3 exit = in.refracted / -in.refracted.y;
    const double measured = glm::length(exit - glm::dot(exit, entry) * entry);
    lab.expect(kFile, "shift of a slab of 1 m, m", shift, measured, kDirection);
}

}  // namespace

void addInterfaceCases(Suite& suite) {
    suite.add("C19", "An interface between equal media changes nothing.", equalMedia);
    suite.add("C20", "At normal incidence glass reflects four percent.", normalIncidence);
    suite.add("C21", "At grazing incidence all is reflected, and all stays finite.",
              grazingIncidence);
    suite.add("C22", "From the critical angle on all is reflected.", aboveTheCriticalAngle);
    suite.add("C23", "Just below the critical angle the transmittance is right.",
              belowTheCriticalAngle);
    suite.add("C24", "At Brewster's angle the parallel part is not reflected.", brewstersAngle);
    suite.add("C25", "A plane-parallel slab shifts a ray and keeps its direction.",
              planeParallelSlab);
}

}  // namespace kaustik::numerics
