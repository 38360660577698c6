// SPDX-License-Identifier: MIT
// The rays of view.around (U08, section 6): into how many they part, by Fresnel's equations at a
// slab, and what they see where the layers around the generator show nothing. What surrounds all is
// equally bright, and so are the receivers, by their fill light.
#include <fmt/format.h>

#include <numbers>
#include <string>

#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/exact.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using namespace numerics;

constexpr double kBackground = 2.0;  // W/m²/sr, of makeScene
constexpr int kSize = 64;

Texels radianceAround(const scene::Scene& scene, const Settings& more) {
    Settings settings{{"emit.photons", "8x8"},
                      {"reconstruct.map_size", "64"},
                      {"around.cubes.size", "128"},
                      {"view", "around"}};
    settings.insert(settings.end(), more.begin(), more.end());
    const Registry registry = registerAll();
    const FrameRequest request{kSize, kSize, settings, {"view.radiance"}};
    const numerics::Frame frame(context(), registry, scene,
                                registry.findTechnique("caustic_triangles"), request);
    return frame.read("view.radiance");
}

// What a slab of glass takes out of an even background is the branches that are not followed.
TEST(RaysAround, AreAsManyBranchesAsThereIsRoomFor) {
    const scene::Scene scene =
        makeScene({{0.0, 0.0, 3.0}, {0.0, 0.0, 0.0}},
                  sun({0.1, -1, -0.2}, 1e-6) + floorPlane("floor", "grey", 2, {0, -4, 0}) +
                      object("slab", "box", "glass", {0, 0, 0}, "size = [4, 4, 0.5]"));
    const double r = 0.04;
    const double t = 1.0 - r;
    double share = t * t;
    double inside = t * t;  // through what has been reflected ever oftener within
    for (int branches = 1; branches <= 5; ++branches) {
        const Texels radiance =
            radianceAround(scene, {{"view.around.branches", std::to_string(branches)}});
        EXPECT_NEAR(radiance.rgb(kSize / 2, kSize / 2).g, kBackground * share, 1e-5)
            << branches << " branches";
        if (branches == 1) {
            share += r;
        } else {
            inside *= r;
            share += inside;
        }
    }
    EXPECT_GT(share, 0.9999999 - inside);
}

// With one layer the floor below the table is hidden from all reference points, which are at the
// water; the eye looks under the table. Floor and table are equally bright.
TEST(RaysAround, SeeTheReceiverStraightBehindWhereTheLayersShowNothing) {
    scene::Scene scene =
        makeScene({{0.0, 3.0, 2.75}, {0.0, 1.0, 0.75}, 10.0},
                  sun({0, -1, 0}, 1e-6) + floorPlane("floor", "grey", 30, {0, 0, 0}) +
                      floorPlane("water", "water", 4, {0, 1, 0}) +
                      object("table", "box", "grey", {0, 0.6, 0}, "size = [0.8, 0.1, 0.8]"));
    const double irradiance = 20.0;
    scene.ambientIrradiance = glm::vec3(static_cast<float>(irradiance));
    double lit = 0.0;
    double index = 0.0;
    for (const scene::Material& material : scene.materials) {
        if (material.name == "grey") lit = material.albedo.g * irradiance / std::numbers::pi;
        if (material.name == "water") index = material.ior;
    }
    const Texels radiance = radianceAround(scene, {{"around.cubes.layers", "1"}});
    // At 45 degrees, of which five more or less change the reflectance by 0.01.
    const double reflectance =
        exactInterface(glm::normalize(glm::dvec3(0, -1, -1)), {0, 1, 0}, 1.0, index).reflectance;
    const double seen = (1.0 - reflectance) * lit / (index * index) + reflectance * kBackground;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            EXPECT_NEAR(radiance.rgb(x, y).g, seen, 0.01 * seen) << x << " " << y;
        }
    }
}

}  // namespace
}  // namespace kaustik::test
