// SPDX-License-Identifier: MIT
// common/fresnel.glsl against Fresnel's equations in double (HARD_CASES.md, C: 19 to 25).
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "tests/gpu/compute_probe.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

struct Case {
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

std::vector<Result> interact(const std::vector<Case>& cases) {
    std::vector<glm::vec4> inputs;
    for (const Case& c : cases) {
        inputs.emplace_back(c.direction, c.from);
        inputs.emplace_back(c.normal, c.to);
    }
    const std::vector<glm::vec4> outputs =
        probe("tests/gpu/shaders/fresnel.comp", inputs, static_cast<int>(cases.size()), 2);
    std::vector<Result> results;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        results.push_back({glm::dvec3(outputs[2 * i]), glm::dvec3(outputs[2 * i + 1]),
                           static_cast<double>(outputs[2 * i].w)});
    }
    return results;
}

// A case in the xy-plane, at an angle from the normal +y.
Case at(double radians, double from, double to) {
    return {glm::vec3(glm::dvec3(std::sin(radians), -std::cos(radians), 0.0)), glm::vec3(0, 1, 0),
            static_cast<float>(from), static_cast<float>(to)};
}

// Unpolarised reflectance in double, for the inputs as the shader gets them: 32-bit.
double exactReflectance(const Case& c) {
    const glm::dvec3 d(c.direction);
    const double eta = static_cast<double>(c.from) / static_cast<double>(c.to);
    const double cosI = std::abs(d.y) / glm::length(d);
    const double sin2 = eta * eta * (d.x * d.x + d.z * d.z) / glm::dot(d, d);
    if (sin2 >= 1.0) return 1.0;
    const double cosT = std::sqrt(1.0 - sin2);
    const double s = (eta * cosI - cosT) / (eta * cosI + cosT);
    const double p = (cosI - eta * cosT) / (cosI + eta * cosT);
    return 0.5 * (s * s + p * p);
}

TEST(Fresnel, AnInterfaceBetweenEqualMediaChangesNothing) {
    for (const Result& r : interact({at(0.0, 1.5, 1.5), at(0.7, 1.5, 1.5), at(1.57, 1.0, 1.0)})) {
        EXPECT_NEAR(r.reflectance, 0.0, 1e-12);
    }
    const Result r = interact({at(0.7, 1.5, 1.5)}).front();
    // One rounding of each component.
    EXPECT_NEAR(r.refracted.x, std::sin(0.7), 1.2e-7);
    EXPECT_NEAR(r.refracted.y, -std::cos(0.7), 1.2e-7);
}

TEST(Fresnel, NormalIncidenceOnGlassReflectsFourPercent) {
    const auto results = interact({at(0.0, 1.0, 1.5), at(0.0, 1.5, 1.0)});
    const double fourUlp = 4.0 * 3.7e-9;  // of 0.04 in 32 bits
    EXPECT_NEAR(results[0].reflectance, 0.04, fourUlp);
    EXPECT_NEAR(results[1].reflectance, 0.04, fourUlp);
}

TEST(Fresnel, GrazingIncidenceReflectsAllAndStaysFinite) {
    const double quarter = glm::half_pi<double>();
    for (const Result& r :
         interact({at(quarter, 1.0, 1.5), at(quarter - 1e-6, 1.0, 1.5), at(quarter, 1.0, 1.0)})) {
        EXPECT_TRUE(std::isfinite(r.reflectance));
        EXPECT_TRUE(std::isfinite(glm::length(r.refracted)));
        EXPECT_NEAR(glm::length(r.reflected), 1.0, 1e-6);
    }
    EXPECT_NEAR(interact({at(quarter - 1e-6, 1.0, 1.5)}).front().reflectance, 1.0, 1e-4);
}

TEST(Fresnel, AboveTheCriticalAngleAllIsReflected) {
    const double critical = std::asin(1.0 / 1.5);
    for (const Result& r : interact({at(critical + 1e-5, 1.5, 1.0), at(1.2, 1.5, 1.0)})) {
        EXPECT_EQ(r.reflectance, 1.0);
        EXPECT_EQ(r.refracted, glm::dvec3(0.0));
        EXPECT_NEAR(glm::length(r.reflected), 1.0, 1e-6);
    }
}

TEST(Fresnel, JustBelowTheCriticalAngleTheTransmittanceIsRight) {
    // 1e-6 rad below: 1 - R = 0.00865. The inputs are floats, which moves the angle itself; the
    // exact value is therefore taken for the floats that the shader sees. 1e-3 is where 32 bits of
    // R near 1 end (2^-24 / 0.00865 is 7e-6) with room for the driver's square root.
    const double critical = std::asin(1.0 / 1.5);
    for (const double below : {1e-3, 1e-4, 1e-5, 1e-6}) {
        const Case c = at(critical - below, 1.5, 1.0);
        const double exact = 1.0 - exactReflectance(c);
        const double measured = 1.0 - interact({c}).front().reflectance;
        EXPECT_NEAR(measured, exact, 1e-3 * exact) << below;
    }
    EXPECT_NEAR(1.0 - exactReflectance(at(critical - 1e-6, 1.5, 1.0)), 0.00865, 0.0006);
}

TEST(Fresnel, AtBrewstersAngleOnlyTheSPolarisedHalfIsReflected) {
    const double brewster = std::atan(1.5);
    const double inside = std::sqrt(2.25 - std::sin(brewster) * std::sin(brewster));
    const double rs = (std::cos(brewster) - inside) / (std::cos(brewster) + inside);
    // R_p is 0, so the unpolarised reflectance is half of R_s.
    EXPECT_NEAR(interact({at(brewster, 1.0, 1.5)}).front().reflectance, 0.5 * rs * rs, 1e-7);
}

TEST(Fresnel, FollowsSnellsLawAndTheExactReflectanceAtAllAngles) {
    std::vector<Case> cases;
    for (const auto& [from, to] :
         {std::pair(1.0, 1.5), std::pair(1.5, 1.0), std::pair(1.0, 1.333), std::pair(2.4, 1.333)}) {
        for (int degrees = 0; degrees < 90; ++degrees) {
            cases.push_back(at(glm::radians(static_cast<double>(degrees)), from, to));
        }
    }
    const std::vector<Result> results = interact(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double exact = exactReflectance(cases[i]);
        EXPECT_NEAR(results[i].reflectance, exact, 2e-6) << i;
        if (exact >= 1.0) continue;
        const double eta = static_cast<double>(cases[i].from) / static_cast<double>(cases[i].to);
        EXPECT_NEAR(results[i].refracted.x, eta * static_cast<double>(cases[i].direction.x), 1e-6);
        EXPECT_NEAR(glm::length(results[i].refracted), 1.0, 1e-6);
    }
}

TEST(Fresnel, APlaneParallelSlabLetsARayLeaveParallel) {
    const double angle = 0.8;
    const Result in = interact({at(angle, 1.0, 1.5)}).front();
    const Result out =
        interact({{glm::vec3(in.refracted), glm::vec3(0, 1, 0), 1.5f, 1.0f}}).front();
    EXPECT_NEAR(out.refracted.x, std::sin(angle), 3e-7);
    EXPECT_NEAR(out.refracted.y, -std::cos(angle), 3e-7);
    // The shift across a slab of thickness t is t sin(a - b)/cos b.
    const double inside = std::atan2(in.refracted.x, -in.refracted.y);
    EXPECT_NEAR(std::sin(angle - inside) / std::cos(inside),
                std::sin(angle) - std::cos(angle) * std::tan(std::asin(std::sin(angle) / 1.5)),
                1e-6);
}

}  // namespace
}  // namespace kaustik::test
