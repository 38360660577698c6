// SPDX-License-Identifier: MIT
// The glossy receivers' BRDF (transport/brdf.h) as a BRDF has to be: reciprocal, never a gain, and
// of the reflectance that its parameters say.
#include "framework/transport/brdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/reference/random.h"

namespace kaustik::transport {
namespace {

constexpr double kPi = std::numbers::pi;
const glm::dvec3 kNormal(0.0, 0.0, 1.0);

glm::dvec3 direction(double angle, double turn) {
    return {std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), std::cos(angle)};
}

// The share of light from `angle` that is reflected, by the midpoint rule over the hemisphere.
// Along the normal it is off by h²(n + 2)/24 with steps of h = pi/1024: 4e-4 for the exponent n =
// 1000.
constexpr double kRuleError = 4e-4;

double reflectedShare(double albedo, double specular, double exponent, double angle) {
    constexpr int kAngles = 512;
    constexpr int kTurns = 1024;
    const glm::dvec3 toLight = direction(angle, kPi);
    double sum = 0.0;
    for (int i = 0; i < kAngles; ++i) {
        const double out = (i + 0.5) * 0.5 * kPi / kAngles;
        double ring = 0.0;
        for (int j = 0; j < kTurns; ++j) {
            const double turn = (j + 0.5) * 2.0 * kPi / kTurns;
            ring += receiverBrdf(glm::dvec3(albedo), glm::dvec3(specular), exponent, kNormal,
                                 toLight, direction(out, turn))
                        .x;
        }
        sum += ring * std::cos(out) * std::sin(out);
    }
    return sum * (0.5 * kPi / kAngles) * (2.0 * kPi / kTurns);
}

TEST(Brdf, ReflectsExactlyAlbedoAndSpecularOfLightAlongTheNormal) {
    for (const double exponent : {1.0, 5.0, 50.0, 1000.0})
        EXPECT_NEAR(reflectedShare(0.4, 0.6, exponent, 0.0), 1.0, kRuleError) << exponent;
}

TEST(Brdf, NeverReflectsMoreThanItReceives) {
    for (const double exponent : {1.0, 5.0, 50.0, 1000.0}) {
        double before = 1.0;
        for (double angle = 0.0; angle < 0.5 * kPi; angle += 0.12) {
            const double share = reflectedShare(0.0, 1.0, exponent, angle);
            // Towards grazing light ever more of the lobe is below the surface.
            EXPECT_LE(share, before + kRuleError) << exponent << " at " << angle;
            before = share;
        }
        // At grazing light half of the lobe's turns are left, and the cosine weighs those less.
        EXPECT_LT(before, 0.5);
    }
}

TEST(Brdf, IsTheSameWithLightAndEyeExchanged) {
    reference::Random random(1, 0, 0);
    for (int i = 0; i < 1000; ++i) {
        const auto any = [&] {
            return direction(std::acos(random.uniform()), 2.0 * kPi * random.uniform());
        };
        const glm::dvec3 a = any();
        const glm::dvec3 b = any();
        const double exponent = std::pow(1e4, random.uniform());
        const glm::dvec3 albedo(0.1, 0.2, 0.3);
        const glm::dvec3 specular(0.3, 0.2, 0.1);
        const glm::dvec3 there = receiverBrdf(albedo, specular, exponent, kNormal, a, b);
        const glm::dvec3 back = receiverBrdf(albedo, specular, exponent, kNormal, b, a);
        // Rounding of the cosine, 2e-16, times the exponent, up to 1e4.
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(there[c], back[c], 1e-11 * there[c]);
    }
}

TEST(Brdf, HasNoLobeWhereTheShadingNormalTurnsAwayAndIsNeverNegative) {
    const glm::dvec3 albedo(0.5);
    const glm::dvec3 specular(0.5);
    const glm::dvec3 below = direction(1.7, 0.3);
    EXPECT_EQ(receiverBrdf(albedo, specular, 1.0, kNormal, below, kNormal).x, 0.5 / kPi);
    EXPECT_EQ(receiverBrdf(albedo, specular, 1.0, kNormal, kNormal, below).x, 0.5 / kPi);
    // Light and eye on one side, the mirror direction more than a right angle from the eye.
    const glm::dvec3 low = direction(1.5, 0.0);
    EXPECT_EQ(receiverBrdf(albedo, specular, 3.0, kNormal, low, low).x, 0.5 / kPi);
}

}  // namespace
}  // namespace kaustik::transport
