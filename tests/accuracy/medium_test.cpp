// SPDX-License-Identifier: MIT
// Light that a medium scatters once towards the eye, against an integral along the eye's ray: a
// beam of sunlight falls through an interface of index 1, which bends nothing and reflects nothing.
#include <cmath>
#include <numbers>

#include "framework/reference/eye.h"
#include "framework/reference/light_tracing.h"
#include "tests/accuracy/path_fixture.h"

namespace kaustik::reference {
namespace {

constexpr double kScattering = 0.3;
constexpr double kExtinction = 0.5;
constexpr double kAnisotropy = 0.6;
constexpr double kSun = 1000.0;

double phase(double cosine) {
    return (1.0 - kAnisotropy * kAnisotropy) /
           (4.0 * std::numbers::pi *
            std::pow(1.0 + kAnisotropy * kAnisotropy - 2.0 * kAnisotropy * cosine, 1.5));
}

// The beam fills |x| < 1, |z| < 1 below y = 0; the ray looks along -z from z > 1.
double radianceAlong(const glm::dvec3& origin, const glm::dvec3& ray) {
    const glm::dvec3 direction = glm::normalize(ray);
    const double begin = (1.0 - origin.z) / direction.z;
    const double end = (-1.0 - origin.z) / direction.z;
    constexpr int kSteps = 200;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double along = begin + (end - begin) * (i + 0.5) / kSteps;
        const double depth = -(origin.y + along * direction.y);
        sum += std::exp(-kExtinction * (depth + along));
    }
    // Light goes down (0, -1, 0) and on to the eye along -direction.
    return kSun * kScattering * phase(direction.y) * sum * (end - begin) / kSteps;
}

TEST(Medium, BeamThroughAMediumIsTheIntegralAlongTheEyesRay) {
    scene::Scene scene;
    addObject(scene, scene::makePlane({{2.0, 2.0}, {1, 1}}), glass(1.0));
    addObject(scene, scene::makePlane({{30.0, 30.0}, {1, 1}}), scene::Material{}, {0.0, -3.0, 0.0});
    scene::Light sun;
    sun.power = glm::vec3(static_cast<float>(kSun));
    scene.lights.push_back(sun);
    scene.medium = scene::Medium{glm::vec3(static_cast<float>(kScattering)),
                                 glm::vec3(static_cast<float>(kExtinction - kScattering)),
                                 static_cast<float>(kAnisotropy)};
    scene.camera.position = {0.0, -1.0, 4.0};
    scene.camera.target = {0.0, -1.1, 0.0};
    scene.camera.verticalFovDegrees = 15.0;
    const EmbreeScene embree(scene);
    LightTraceSettings settings;
    settings.width = 12;
    settings.height = 12;
    settings.photonsPerBatch = 20000;
    PixelSums sums = makeLightTraceSums(embree, settings);
    ASSERT_EQ(sums.layers(), 2);
    RunOptions options;
    options.stop.batches = 64;
    lightTrace(embree, settings, options, sums);
    const Eye eye(embree, settings.width, settings.height);
    const std::size_t first = std::size_t{144} * 3;
    for (int row = 0; row < 12; ++row) {
        for (int column = 0; column < 12; ++column) {
            const double expected =
                radianceAlong(eye.position() + embree.center(), eye.ray(column + 0.5, row + 0.5));
            const std::size_t value = first + static_cast<std::size_t>(3 * (12 * row + column));
            const double error = sums.standardError(value);
            // 144 pixels, once in 1e4 runs: 5 errors, which 64 batches know to 9 %. The middle of
            // a pixel is its mean to 1e-4.
            EXPECT_LT(std::abs(sums.mean(value) - expected), 5.5 * error + 2e-4 * expected);
            EXPECT_LT(error, 0.04 * expected);
        }
    }
    // On the floor the beam has lost what 3 m of the medium take, and the ledger knows.
    const Energy energy = sums.energy();
    EXPECT_NEAR(
        energy.watts[transport::kAccountDeposited] / energy.watts[transport::kAccountEmitted],
        std::exp(-3.0 * kExtinction), 1e-6);
    EXPECT_LT(std::abs(energy.balance()), 1e-10);
}

}  // namespace
}  // namespace kaustik::reference
