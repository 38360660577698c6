// SPDX-License-Identifier: MIT
// Where directions fall in a picture of the environment, and the pictures that need no file.
#include "framework/scene/environment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/core/error.h"
#include "framework/scene/texture.h"
#include "tests/unit/scene/files/scene_file_fixture.h"

namespace kaustik::scene {
namespace {

using EnvironmentInASceneFile = test::SceneFile;

TEST(EnvironmentPosition, HasTheMiddleTowardsMinusZTheTopUpwardsAndXToItsRight) {
    const Scene scene;
    const auto expectAt = [&](const glm::dvec3& direction, double x, double y) {
        const glm::dvec2 at = environmentPosition(scene, direction);
        EXPECT_NEAR(at.x, x, 1e-12);
        EXPECT_NEAR(at.y, y, 1e-12);
    };
    expectAt({0, 0, -1}, 0.5, 0.5);
    expectAt({1, 0, 0}, 0.75, 0.5);
    expectAt({-1, 0, 0}, 0.25, 0.5);
    expectAt({0, std::sqrt(0.5), -std::sqrt(0.5)}, 0.5, 0.75);
    expectAt({0, 1, 0}, 0.5, 1.0);
    expectAt({0, -1, 0}, 0.5, 0.0);
    EXPECT_LT(environmentPosition(scene, {0, 0, 1}).x, 1.0);
}

TEST(EnvironmentPosition, TurnsCounterClockwiseAsSeenFromAbove) {
    Scene scene;
    scene.environmentTurnDegrees = 90.0;
    // The picture's middle, towards -Z before, is now to the left of that.
    EXPECT_NEAR(environmentPosition(scene, {-1, 0, 0}).x, 0.5, 1e-12);
    scene.environmentTurnDegrees = -450.0;
    EXPECT_NEAR(environmentPosition(scene, {1, 0, 0}).x, 0.5, 1e-12);
}

TEST(EnvironmentPatterns, AreFiniteAndGoOnAcrossTheirSeam) {
    for (const EnvironmentPattern pattern : {EnvironmentPattern::sky, EnvironmentPattern::grid}) {
        const Image image = makeEnvironment(pattern);
        for (const float value : image.values) {
            ASSERT_TRUE(std::isfinite(value));
            ASSERT_GE(value, 0.0f);
        }
    }
    // Above the horizon the sky has no edges: neighbours differ little, also across the seam.
    const Image sky = makeEnvironment(EnvironmentPattern::sky);
    for (int row = 0; row < sky.height / 2; ++row) {
        EXPECT_NEAR(sky.at(0, row, 2), sky.at(sky.width - 1, row, 2), 0.1f) << row;
    }
    // Squares of 10 degrees: 36 around the equator, in turn bright and dark.
    const Image grid = makeEnvironment(EnvironmentPattern::grid);
    int changes = 0;
    for (int column = 0; column < grid.width; ++column) {
        const bool isBright = grid.at(column, grid.height / 2 - 5, 2) > 0.5f;
        const bool isNextBright = grid.at((column + 1) % grid.width, grid.height / 2 - 5, 2) > 0.5f;
        changes += isBright != isNextBright;
    }
    EXPECT_EQ(changes, 36);
}

TEST_F(EnvironmentInASceneFile, IsAPatternOrAnImageWithATurn) {
    const Scene patterned =
        load("background_radiance = 2\n[environment]\npattern = 'grid'\nturn_degrees = 30\n");
    ASSERT_EQ(patterned.environmentImage, 0);
    EXPECT_EQ(patterned.environmentTurnDegrees, 30.0);
    const Image image = decodeTexture(patterned.images.at(0));
    EXPECT_EQ(image.values, makeEnvironment(EnvironmentPattern::grid).values);

    write("sky.pfm", "PF\n2 1\n-1\n" + std::string(24, '\0'));
    const Scene pictured = load("background_radiance = 1\n[environment]\nimage = 'sky.pfm'\n");
    ASSERT_EQ(pictured.environmentImage, 0);
    EXPECT_FALSE(pictured.images.at(0).srgb);
    EXPECT_EQ(pictured.environmentTurnDegrees, 0.0);
}

TEST_F(EnvironmentInASceneFile, SaysWhereItMakesNoSense) {
    const std::string lit = "background_radiance = 1\n[environment]\n";
    const auto expectError = [&](const std::string& text, const std::string& place,
                                 const std::string& part) {
        const std::string message = messageOf<ConfigError>(text);
        EXPECT_NE(message.find("scene.toml:" + place + ": environment"), std::string::npos)
            << message;
        EXPECT_NE(message.find(part), std::string::npos) << message;
    };
    expectError(lit + "pattern = 'skye'", "3", "did you mean 'sky'?");
    expectError(lit + "patern = 'sky'", "3", "did you mean 'pattern'?");
    expectError(lit + "turn_degrees = 'x'", "3", "must be a number");
    EXPECT_EQ(load(lit).environmentImage, -1);  // even
    expectError(lit + "pattern = 'sky'\nimage = 'a.exr'", "4", "either an image or a pattern");
    expectError("[environment]\npattern = 'sky'", "1", "background_radiance");
    const std::string missing = messageOf<IoError>(lit + "image = 'absent.exr'");
    EXPECT_NE(missing.find("scene.toml:3"), std::string::npos) << missing;
    EXPECT_NE(missing.find("absent.exr was not found"), std::string::npos) << missing;
}

}  // namespace
}  // namespace kaustik::scene
