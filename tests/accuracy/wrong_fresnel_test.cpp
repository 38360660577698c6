// SPDX-License-Identifier: MIT
// What wrong laws at dielectrics make of a picture: against the two closed forms of Fresnel's
// equations, and by what the laws have in common.
#include "framework/reference/wrong_fresnel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/reference/eye.h"
#include "framework/reference/light_tracing.h"
#include "framework/scene/files/scene_file.h"

namespace kaustik::reference {
namespace {

// By the angles of incidence and refraction, radians; the code under test knows only cosines.
double fresnel(double incident, double refracted) {
    const double s = std::sin(incident - refracted) / std::sin(incident + refracted);
    const double p = std::tan(incident - refracted) / std::tan(incident + refracted);
    return 0.5 * (s * s + p * p);
}

TEST(WrongFresnel, ChangesWhatPassesAFlatSurfaceByItsClosedForm) {
    constexpr double kIndex = 1.333;
    for (const double degrees : {20.0, 40.0, 50.0}) {
        scene::Scene scene = scene::loadScene("flat-water");
        const double angle = degrees * std::numbers::pi / 180.0;
        scene.lights.front().direction = {std::sin(angle), -std::cos(angle), 0.0};
        const EmbreeScene embree(scene);
        WrongFresnelRequest request;
        request.width = 32;
        request.height = 24;
        request.photons = 1u << 19;
        const auto changes = changesByWrongFresnel(embree, request);
        LightTraceSettings settings;
        settings.width = request.width;
        settings.height = request.height;
        settings.filter.splitInteractions = 0;  // the same photons
        PixelSums sums = makeLightTraceSums(embree, settings);
        RunOptions options;
        options.stop.photons = request.photons;
        lightTrace(embree, settings, options, sums);
        const Image right = sums.meanImage(0);

        const double refracted = std::asin(std::sin(angle) / kIndex);
        const double exact = fresnel(angle, refracted);
        const double straight = std::pow((kIndex - 1.0) / (kIndex + 1.0), 2.0);
        const double schlick = straight + (1.0 - straight) * std::pow(1.0 - std::cos(angle), 5.0);
        // From within, light is totally reflected beyond 48.6 degrees.
        const double inside = std::sin(angle) * kIndex;
        const double swapped = inside >= 1.0 ? 1.0 : fresnel(angle, std::asin(inside));
        const std::array<double, 3> expected = {
            1.0 / (1.0 - exact), (1.0 - schlick) / (1.0 - exact), (1.0 - swapped) / (1.0 - exact)};
        std::size_t lit = 0;
        const Eye eye(embree, request.width, request.height);
        for (std::size_t i = 0; i < right.values.size(); ++i) {
            const auto light = static_cast<double>(right.values[i]);
            // The floor ends at |x| = 2 and |z| = 1.5; walls have what the water reflects, too.
            const auto pixel = static_cast<int>(i / 3);
            const glm::dvec3 ray =
                eye.ray(pixel % request.width + 0.5, pixel / request.width + 0.5);
            const glm::dvec3 origin = eye.position() + embree.center();
            const glm::dvec3 floor = origin + ray * ((-1.2 - origin.y) / ray.y);
            if (!(light > 100.0) || std::abs(floor.x) > 1.8 || std::abs(floor.z) > 1.3) continue;
            ++lit;
            // The scene's index is a float, and so are the values of both images.
            for (std::size_t k = 0; k < expected.size(); ++k) {
                EXPECT_NEAR(static_cast<double>(changes[k].values[i]) / light, expected[k] - 1.0,
                            1e-5)
                    << degrees << " degrees, law " << k;
            }
        }
        EXPECT_GT(lit, 100u) << degrees;
    }
}

TEST(WrongFresnel, HasLawsThatAgreeWhereTheyMust) {
    for (const double index : {1.1, 1.5, 2.4}) {
        const double straight = std::pow((index - 1.0) / (index + 1.0), 2.0);
        for (const WrongFresnel law : kWrongFresnels) {
            EXPECT_NEAR(reflectanceOf(law, 1.0, 1.0, index), straight, 1e-12);
            EXPECT_NEAR(reflectanceOf(law, 1.0, index, 1.0), straight, 1e-12);
        }
        // One path there and back has one reflectance.
        const double cosine = 0.6;
        const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (index * index));
        for (const WrongFresnel law : {WrongFresnel::lossless, WrongFresnel::schlick}) {
            EXPECT_NEAR(reflectanceOf(law, cosine, 1.0, index),
                        reflectanceOf(law, inside, index, 1.0), 1e-12);
        }
        // At grazing light everything is reflected.
        EXPECT_NEAR(reflectanceOf(WrongFresnel::schlick, 0.0, 1.0, index), 1.0, 1e-12);
        EXPECT_EQ(reflectanceOf(WrongFresnel::swapped, 0.01, 1.0, index), 1.0);
    }
}

TEST(WrongFresnel, EndsWhereItIsToldTo) {
    const scene::Scene scene = scene::loadScene("flat-water");
    const EmbreeScene embree(scene);
    WrongFresnelRequest request;
    request.width = 32;
    request.height = 24;
    request.photons = 1'000'000'000'000;
    request.shouldContinue = [] { return false; };
    for (const Image& image : changesByWrongFresnel(embree, request))
        EXPECT_TRUE(image.values.empty());
}

}  // namespace
}  // namespace kaustik::reference
