// SPDX-License-Identifier: MIT
// The paper's variants (K06): other ways to the same layers, lines and counts give the same; both
// Fresnel branches carry what they must; shadow rays find a ball's shadow; all hits are all hits.
#include <algorithm>
#include <cmath>

#include "framework/numerics/cases/scene_text.h"
#include "framework/pipeline/ledger.h"
#include "framework/scene/files/scene_file.h"
#include "framework/transport/types.h"
#include "framework/transport/watts.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using transport::kAccountEmitted;
using transport::kAccountUntracedBranch;
using transport::kFateReceiver;

void expectSame(const Frame& a, const Frame& b, const std::string& name, int layer = 0) {
    const Texels left = a.read(name, layer);
    const Texels right = b.read(name, layer);
    ASSERT_EQ(left.values.size(), right.values.size()) << name;
    std::size_t different = 0;
    for (std::size_t i = 0; i < left.values.size(); ++i)
        different += left.values[i] == right.values[i] ? 0 : 1;
    EXPECT_EQ(different, 0u) << name << ", layer " << layer;
}

// Objects next to the picture, partly in it, around the eye and behind one another.
scene::Scene manyObjects() {
    std::string parts = numerics::sun({0.2, -1, -0.1}) +
                        numerics::floorPlane("floor", "grey", 12, {0, -1, 0}) +
                        numerics::object("around the eye", "sphere", "glass", {0, 0, 0},
                                         "radius = 2\nsegments = 24");
    for (int i = 0; i < 8; ++i) {
        parts += numerics::object(fmt::format("ball {}", i), "sphere", "white",
                                  {1.5 * (i % 4) - 2.5, 0.2 * (i % 3), -3.0 - 0.8 * i},
                                  "radius = 0.7\nsegments = 16");
    }
    parts += numerics::object("next to it", "box", "white", {20, 0, -3}, "size = [1, 1, 1]");
    return numerics::makeScene({}, parts);
}

void expectThoseOfPeeling(const scene::Scene& scene, int width, int height,
                          const std::string& count) {
    const std::vector<std::string> saved = {"layers.depth", "layers.surface"};
    const auto render = [&](const char* node) {
        return Frame(scene, width, height,
                     {{"emit.photons", "16x16"}, {"layers", node}, {"layers.count", count}}, saved,
                     true);
    };
    const Frame together = render("peel");
    const Frame apart = render("per_object");
    for (const std::string& texture : saved) {
        for (int layer = 0; layer < std::stoi(count); ++layer)
            expectSame(together, apart, texture, layer);
    }
    const transport::LayerStatistics a = together.renderer().layerStatistics();
    const transport::LayerStatistics b = apart.renderer().layerStatistics();
    EXPECT_GT(a.fragments, 0u);
    EXPECT_EQ(a.complexity, b.complexity);
    EXPECT_EQ(a.fragments, b.fragments);
    EXPECT_EQ(a.skipped, b.skipped);
    EXPECT_EQ(a.pixelsSkipped, b.pixelsSkipped);
}

TEST(PerObjectLayers, AreThoseOfAllObjectsTogether) {
    for (const char* name : {"glass-sphere", "ring", "pool-reflections", "water-from-below"}) {
        SCOPED_TRACE(name);
        expectThoseOfPeeling(scene::loadScene(name), 160, 120, "8");
    }
}

TEST(PerObjectLayers, AreSoAtAnySizeAndWithFewerLayersThanThereAre) {
    const scene::Scene scene = manyObjects();
    for (const auto& [width, height] : {std::pair(160, 120), std::pair(37, 23), std::pair(1, 1)}) {
        for (const char* count : {"1", "3", "32"}) {
            SCOPED_TRACE(testing::Message() << width << "x" << height << ", " << count);
            expectThoseOfPeeling(scene, width, height, count);
        }
    }
}

TEST(DepthComplexity, IsTheSameByReduceAndByAtomics) {
    const scene::Scene scene = scene::loadScene("glass-sphere");
    // Sizes that do not halve evenly, and fewer layers than there are.
    for (const auto& [width, height] : {std::pair(160, 120), std::pair(131, 77), std::pair(1, 1)}) {
        const Settings few = {{"layers", "peel"}, {"layers.count", "2"}, {"emit.photons", "8x8"}};
        Settings reduced = few;
        reduced.emplace_back("layers.peel.counting", "reduce");
        const auto a = Frame(scene, width, height, few).renderer().layerStatistics();
        const auto b = Frame(scene, width, height, reduced).renderer().layerStatistics();
        EXPECT_EQ(a.complexity, b.complexity);
        EXPECT_EQ(a.fragments, b.fragments);
        EXPECT_EQ(a.skipped, b.skipped);
        EXPECT_EQ(a.pixelsSkipped, b.pixelsSkipped);
        if (width > 1) {
            EXPECT_GT(a.skipped, 0u);
        }
    }
}

TEST(LineSource, OfTheGeometryShaderFindsTheSameHits) {
    const scene::Scene scene = scene::loadScene("glass-sphere");
    const std::vector<std::string> saved = {"hits.position_2", "hits.surface_2", "hits.flux_2"};
    const Settings settings = {{"trace", "lines"}, {"emit.photons", "64x64"}};
    Settings made = settings;
    made.emplace_back("trace.lines.source", "geometry");
    made.emplace_back("trace.lines.rows", "1000");
    const Frame placed(scene, 160, 120, settings, saved);
    const Frame generated(scene, 160, 120, made, saved);
    for (const std::string& name : saved)
        expectSame(placed, generated, name);
}

// A scene of grey receivers and more, under a sun of 100 W/m²; all vectors as TOML has them.
struct SunlitScene {
    std::string name;
    std::string cameraPosition;
    std::string cameraTarget;
    std::string sunDirection;
};
scene::Scene sunlit(const SunlitScene& scene, const std::string& rest) {
    return sceneFromText("name = '" + scene.name + "'\n[camera]\nposition = " +
                         scene.cameraPosition + "\ntarget = " + scene.cameraTarget + R"(
[[light]]
name = "sun"
type = "directional"
irradiance = 100
direction = )" + scene.sunDirection +
                         R"(
[[material]]
name = "grey"
type = "lambertian"
albedo = 0.5
)" + rest);
}

// Light at 60 degrees on flat water: a floor below it, and a screen where the reflected part
// arrives.
scene::Scene mirroringWater() {
    return sunlit(
        {"mirroring water", "[1, 2.5, 7]", "[0.8, 0.2, 0]", "[0.8660254037844386, -0.5, 0]"},
        R"(
[[material]]
name = "water"
type = "dielectric"
ior = 1.333
[[object]]
name = "water"
shape = "plane"
material = "water"
size = [1, 1]
[[object]]
name = "floor"
shape = "plane"
material = "grey"
size = [6, 6]
position = [0, -0.5, 0]
[[object]]
name = "screen"
shape = "plane"
material = "grey"
size = [3, 3]
position = [2.2, 1, 0]
)");
}

double reflectance(double cosine, double n) {
    const double sine = std::sqrt(1.0 - cosine * cosine) / n;
    const double transmitted = std::sqrt(1.0 - sine * sine);
    const double s = (cosine - n * transmitted) / (cosine + n * transmitted);
    const double p = (n * cosine - transmitted) / (n * cosine + transmitted);
    return 0.5 * (s * s + p * p);
}

// Watts that arrived at receivers above and below a height, m.
std::pair<double, double> arrivedAboveAndBelow(const Frame& frame, double height) {
    const Texels flux = frame.read("hits.flux_1");
    const Texels position = frame.read("hits.position_1");
    std::pair<double, double> sums{0.0, 0.0};
    for (int y = 0; y < flux.height; ++y) {
        for (int x = 0; x < flux.width; ++x) {
            if (static_cast<unsigned>(flux.at(x, y, 3)) != kFateReceiver) continue;
            const bool isAbove = frame.toWorld(position.rgb(x, y)).y > height;
            (isAbove ? sums.first : sums.second) += transport::wattsOf(flux.rgb(x, y));
        }
    }
    return sums;
}

TEST(SplitBranches, CarryTheFresnelSharesAndLoseNothing) {
    const scene::Scene scene = mirroringWater();
    const Frame frame(scene, 200, 150, {{"specular", "split"}, {"emit.photons", "64x64"}},
                      {"hits.flux_1", "hits.position_1"});
    const auto [reflected, refracted] = arrivedAboveAndBelow(frame, 0.5);
    const EnergyLedger ledger = frame.renderer().ledger();
    const double emitted = ledger.watts[kAccountEmitted];
    const double expected = reflectance(0.5, 1.333);
    EXPECT_NEAR(reflected / emitted, expected, 1e-5);
    EXPECT_NEAR(refracted / emitted, 1.0 - expected, 1e-5);
    EXPECT_EQ(ledger.watts[kAccountUntracedBranch], 0.0);
    EXPECT_LT(std::abs(ledger.balance()), 1e-6);
}

TEST(SplitBranches, AreTheStrongerOneWhereThereIsNoRoomForBoth) {
    const scene::Scene scene = mirroringWater();
    const Frame frame(
        scene, 200, 150,
        {{"specular", "split"}, {"specular.split.levels", "0"}, {"emit.photons", "64x64"}},
        {"hits.flux_1", "hits.position_1"});
    const auto [reflected, refracted] = arrivedAboveAndBelow(frame, 0.5);
    const EnergyLedger ledger = frame.renderer().ledger();
    const double emitted = ledger.watts[kAccountEmitted];
    const double expected = reflectance(0.5, 1.333);
    EXPECT_EQ(reflected, 0.0);
    EXPECT_NEAR(refracted / emitted, 1.0 - expected, 1e-5);
    EXPECT_NEAR(ledger.watts[kAccountUntracedBranch] / emitted, expected, 1e-5);
    EXPECT_LT(std::abs(ledger.balance()), 1e-6);
}

TEST(ShadowRays, FindTheShadowOfABall) {
    const scene::Scene scene = sunlit({"ball", "[0, 2.5, 3.5]", "[0, 0.3, 0]", "[0, -1, 0]"}, R"(
[[object]]
name = "floor"
shape = "plane"
material = "grey"
size = [4, 4]
[[object]]
name = "ball"
shape = "sphere"
material = "grey"
radius = 0.5
position = [0, 1, 0]
)");
    for (const char* tracer : {"lines", "hierarchical"}) {
        SCOPED_TRACE(tracer);
        const Frame frame(scene, 320, 240, {{"shadow", "rays"}, {"trace", tracer}},
                          {"shadow.visibility", "eye.receiver"});
        const Texels visibility = frame.read("shadow.visibility");
        const Texels receiver = frame.read("eye.receiver");
        int dark = 0;
        int lit = 0;
        int wrong = 0;
        for (int y = 0; y < receiver.height; ++y) {
            for (int x = 0; x < receiver.width; ++x) {
                const double depth = receiver.at(x, y, 0);
                if (depth <= 0.0) continue;
                const glm::dvec3 point = frame.worldAt(x, y, depth);
                if (point.y > 0.01) continue;  // the ball itself
                const double fromAxis = std::hypot(point.x, point.z);
                // Pixels across the edge may be either; two of them are 4 cm here.
                if (std::abs(fromAxis - 0.5) < 0.04) continue;
                const bool isDark = visibility.at(x, y, 0) < 0.5f;
                ++(fromAxis < 0.5 ? dark : lit);
                wrong += isDark != (fromAxis < 0.5) ? 1 : 0;
            }
        }
        EXPECT_GT(dark, 1000);
        EXPECT_GT(lit, 10000);
        EXPECT_EQ(wrong, 0);
    }
}

TEST(AllHits, LightWhatLiesBehindAReceiver) {
    // Light falls through a sheet that does not bend it on a plate, and on the floor beneath.
    const scene::Scene scene = sunlit({"plate", "[0, 1.5, 4]", "[0, 0, 0]", "[0, -1, 0]"}, R"(
[[material]]
name = "air"
type = "dielectric"
ior = 1
[[object]]
name = "sheet"
shape = "plane"
material = "air"
size = [1, 1]
position = [0, 0.5, 0]
[[object]]
name = "plate"
shape = "plane"
material = "grey"
size = [0.5, 0.5]
[[object]]
name = "floor"
shape = "plane"
material = "grey"
size = [3, 3]
position = [0, -0.5, 0]
)");
    const Settings settings = {{"emit.photons", "64x64"}};
    Settings all = settings;
    all.emplace_back("trace", "all_hits");
    const Frame first(scene, 200, 150, settings, {"hits.flux_1"});
    const Frame every(scene, 200, 150, all, {"hits.flux_1_all"});
    const auto count = [](const Texels& flux) {
        int hits = 0;
        for (int y = 0; y < flux.height; ++y) {
            for (int x = 0; x < flux.width; ++x)
                hits += static_cast<unsigned>(flux.at(x, y, 3)) == kFateReceiver ? 1 : 0;
        }
        return hits;
    };
    EXPECT_EQ(count(first.read("hits.flux_1")), 64 * 64);
    // A quarter of the photons would hit the floor under the plate too. Its edges are known to a
    // pixel, 2 cm, which is more than a photon.
    const int further = count(every.read("hits.flux_1_all")) - 64 * 64;
    EXPECT_GE(further, 30 * 30);
    EXPECT_LE(further, 36 * 36);
}

TEST(ScreenAlignedSprites, KeepTheFlux) {
    const scene::Scene scene = scene::loadScene("glass-sphere");
    const Frame frame(scene, 200, 150,
                      {{"reconstruct", "sprites"},
                       {"reconstruct.sprites.shape", "screen"},
                       {"emit.photons", "64x64"}});
    EXPECT_LT(std::abs(frame.renderer().ledger().balance()), 1e-6);
}

}  // namespace
}  // namespace kaustik::test
