// SPDX-License-Identifier: MIT
// God rays against the ray-traced single scattering of the same paths of light: through one
// interface on the flooded cave, which the eye is in, and through a block of glass, where a
// photon's path has several parts and those in the glass, which absorbs besides, scatter too.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/measure/image_errors.h"
#include "framework/scene/files/scene_file.h"
#include "tests/audit/modelled_reference.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 72;

void expectReference(const scene::Scene& scene, const Settings& settings, double energyTolerance,
                     double errorTolerance) {
    const Frame frame(scene, kWidth, kHeight, settings);
    const FrameOutputs& outputs = frame.renderer().outputs();
    const reference::EmbreeScene embree(scene);
    const reference::Reference reference =
        modelledReference(embree, outputs.hits.incoming.paths, kWidth, kHeight, 6'000'000);
    const Texels texels = frame.read(outputs.inScattered.radiance);
    Image image(texels.width, texels.height, 3);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = texels.at(x, image.height - 1 - y, c);
        }
    }
    const measure::ImageErrors errors =
        measureErrors(measure::ImagePair({.image = image,
                                          .reference = reference.inScattered,
                                          .standardError = &reference.inScatteredError}));
    ASSERT_TRUE(errors.energyRatio && errors.referenceNoise);
    EXPECT_NEAR(*errors.energyRatio, 1.0, energyTolerance);
    double square = 0.0;
    for (const float value : reference.inScattered.values)
        square += std::pow(static_cast<double>(value), 2);
    const double scale =
        std::sqrt(square / static_cast<double>(reference.inScattered.values.size()));
    // What the reference's own noise does not explain.
    const double own = std::sqrt(std::max(
        errors.rmse * errors.rmse - errors.referenceNoise->rmse * errors.referenceNoise->rmse,
        0.0));
    testing::Test::RecordProperty("energy_ratio_ppm", static_cast<int>(1e6 * *errors.energyRatio));
    testing::Test::RecordProperty("error_ppm", static_cast<int>(1e6 * own / scale));
    EXPECT_LT(own / scale, errorTolerance);
}

TEST(GodRays, AreTheReferencesOnTheFloodedCave) {
    // A pixel's middle says for all of it what hides the shafts behind: at outlines that is wrong,
    // and all that is left of the error.
    expectReference(scene::loadScene("god-rays"),
                    {{"blur", "none"}, {"trace", "hierarchical_compute"}}, 0.01, 0.05);
}

TEST(GodRays, AreTheReferencesThroughABlockOfGlass) {
    const scene::Scene scene = sceneFromText(R"(
name = "block"
[camera]
position = [2.6, 2.1, 4.6]
target = [0, 0.1, 0]
vertical_fov_degrees = 34
[medium]
scattering_per_meter = [0.3, 0.2, 0.1]
absorption_per_meter = [0, 0.1, 0.2]
anisotropy = 0.3
[[light]]
name = "sun"
type = "directional"
direction = [0.5, -1, 0.3]
irradiance = 1000
[[material]]
name = "grey"
type = "lambertian"
albedo = 0.5
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
absorption_per_meter = [0.2, 0.5, 1]
[[object]]
name = "floor"
shape = "plane"
material = "grey"
size = [8, 8]
position = [0, -1, 0]
[[object]]
name = "block"
shape = "box"
material = "glass"
size = [2, 0.6, 2]
position = [0, 0.6, 0]
)");
    expectReference(scene, {{"blur", "none"}, {"trace", "hierarchical_compute"}}, 0.01, 0.03);
}

}  // namespace
}  // namespace kaustik::test
