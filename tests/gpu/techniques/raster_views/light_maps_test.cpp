// SPDX-License-Identifier: MIT
// Further maps of a light of what the eye sees nearer by (reconstruct.map_cascades): the picture's
// light is the same, but finer where the eye looks closely, and the ledger knows nothing of them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "framework/numerics/cases/scene_text.h"
#include "techniques/raster_views/magnified_parts.h"
#include "tests/gpu/techniques/caustic_map_frame.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using namespace transport;
using glm::dvec3;

constexpr double kIrradiance = 1000.0;
// Along a floor one metre below, from close by to far away.
const CameraText kAlong{{0.0, -0.7, 3.4}, {0.0, -1.0, 2.4}, 60.0, 0.01};

// Light that comes as it was through a sheet of index 1 of 6 x 7 m.
scene::Scene uniform(const std::string& lights) {
    return makeScene(kAlong, lights +
                                 "[[material]]\nname = \"air\"\ntype = \"dielectric\"\nior = 1\n" +
                                 object("sheet", "plane", "air", {0, 0, 0}, "size = [6, 7]") +
                                 floorPlane("floor", "grey", 40, {0, -1, 0}));
}
std::string lampAt(const dvec3& position) {
    return fmt::format(
        "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = {}\nintensity = 5000\n",
        numbers(position));
}
std::string severalLights() {
    return sun({0, -1, 0}, kIrradiance) + lampAt({0, 3, 0});
}

MapFrame cascades(const scene::Scene& scene, int count, const Settings& more = {}) {
    Settings settings{{"emit.photons", "256x256"},
                      {"specular", "interface"},
                      {"reconstruct.space", "light"},
                      {"reconstruct.map_size", "128"},
                      {"reconstruct.map_cascades", std::to_string(count)}};
    settings.insert(settings.end(), more.begin(), more.end());
    return {scene, "caustic_map", settings};
}

// The worst and the mean deviation of the irradiance of pixels that see places of the floor.
struct Off {
    int pixels = 0;
    double worst = 0.0;
    double mean = 0.0;
};
Off offFrom(const MapFrame& frame, const std::function<double(const dvec3&)>& expected,
            const std::function<bool(const dvec3&)>& isJudged) {
    const Texels receiver = frame.read("eye.receiver");
    const Texels irradiance = frame.causticIrradiance();
    Off off;
    for (int y = 0; y < receiver.height; ++y) {
        for (int x = 0; x < receiver.width; ++x) {
            const auto depth = double{receiver.at(x, y, 0)};
            if (depth <= 0.0) continue;
            const dvec3 place = frame.worldAt(x, y, depth);
            if (!isJudged(place)) continue;
            const double one = std::abs(irradiance.rgb(x, y).g / expected(place) - 1.0);
            ++off.pixels;
            off.worst = std::max(off.worst, one);
            off.mean += one;
        }
    }
    off.mean /= std::max(off.pixels, 1);
    return off;
}

TEST(MapCascades, HaveNoSeamsInUniformLight) {
    if (lacksExactTracer()) GTEST_SKIP() << "built without Embree";
    const scene::Scene scene = uniform(sun({0, -1, 0}, kIrradiance));
    for (const auto& [way, by] : {std::pair("triangles", "depth"), std::pair("beams", "depth"),
                                  std::pair("triangles", "magnification")}) {
        SCOPED_TRACE(way);
        SCOPED_TRACE(by);
        const MapFrame frame = cascades(
            scene, 4,
            {{"trace", "raytraced"}, {"reconstruct", way}, {"reconstruct.map_cascades_by", by}});
        ASSERT_EQ(frame.renderer().outputs().map.maps.size(), 4u);
        // The sheet ends before the map's widest texels, of 0.3 m, tell.
        const Off off = offFrom(
            frame, [](const dvec3&) { return kIrradiance; },
            [](const dvec3& p) { return std::abs(p.x) < 2.3 && std::abs(p.z) < 2.8; });
        EXPECT_GT(off.pixels, 1000);
        // Sums in 32 bits; beams are Gaussians, whose sum has ripples.
        EXPECT_LT(off.worst, std::string(way) == "triangles" ? 1e-3 : 0.02);
    }
}

TEST(MapCascades, AreThoseOfEachLight) {
    if (lacksExactTracer()) GTEST_SKIP() << "built without Embree";
    const scene::Scene scene = uniform(severalLights());
    const MapFrame frame =
        cascades(scene, 3, {{"trace", "raytraced"}, {"reconstruct", "triangles"}});
    const auto expected = [](const dvec3& p) {
        const dvec3 to = dvec3(0, 3, 0) - p;
        return kIrradiance + 5000.0 * to.y / std::pow(glm::length(to), 3.0);
    };
    const Off off = offFrom(
        frame, expected, [](const dvec3& p) { return std::abs(p.x) < 2.3 && std::abs(p.z) < 2.8; });
    EXPECT_GT(off.pixels, 1000);
    // The lamp's light changes within a cell.
    EXPECT_LT(off.worst, 5e-3);
}

TEST(MapCascades, LeaveTheLedgerAsItIs) {
    const scene::Scene scene =
        makeScene(kAlong, severalLights() +
                              object("ball", "sphere", "glass", {0, -0.5, 1.6}, "radius = 0.3") +
                              floorPlane("floor", "grey", 8, {0, -1, 0}));
    const std::vector<std::pair<const char*, const char*>> ways{{"fixed", "none"},
                                                                {"lens", "none"},
                                                                {"four_radii", "blend"},
                                                                {"levels", "levels"},
                                                                {"multi_level", "level_sum"},
                                                                {"triangles", "none"},
                                                                {"beams", "none"},
                                                                {"sprites", "none"}};
    for (const auto& [way, filter] : ways) {
        SCOPED_TRACE(way);
        const Settings chosen{{"emit.photons", "64x64"},
                              {"specular", "two_interfaces"},
                              {"trace", "background"},
                              {"reconstruct", way},
                              {"filter", filter}};
        const MapFrame one = cascades(scene, 1, chosen);
        const MapFrame three = cascades(scene, 3, chosen);
        Settings measured = chosen;
        measured.emplace_back("reconstruct.map_cascades_by", "magnification");
        const MapFrame parts = cascades(scene, 3, measured);
        EXPECT_GT(one.watts(kAccountDeposited), 0.0);
        for (std::uint32_t account = 0; account < kAccountCount; ++account) {
            EXPECT_EQ(one.watts(account), three.watts(account)) << account;
            EXPECT_EQ(one.watts(account), parts.watts(account)) << account;
        }
        three.expectBalance();
    }
}

// The border of the light, which the eye has close before it, is as sharp as the map's texels.
TEST(MapCascades, AreFinerWhereTheEyeLooksClosely) {
    if (lacksExactTracer()) GTEST_SKIP() << "built without Embree";
    const scene::Scene scene = uniform(sun({0, -1, 0}, kIrradiance));
    std::vector<double> texels;
    std::vector<double> blurred;
    for (const int count : {1, 4}) {
        const MapFrame frame =
            cascades(scene, count, {{"trace", "raytraced"}, {"reconstruct", "triangles"}});
        const auto& maps = frame.renderer().outputs().map.maps;
        texels.push_back(2.0 * maps.back().on.views->view(0).halfExtent.x /
                         maps.back().on.views->width());
        // Pixels that are neither lit nor dark.
        int pixels = 0;
        const Texels receiver = frame.read("eye.receiver");
        const Texels irradiance = frame.causticIrradiance();
        for (int y = 0; y < receiver.height; ++y) {
            for (int x = 0; x < receiver.width; ++x) {
                const auto share = double{irradiance.at(x, y, 1)} / kIrradiance;
                pixels += receiver.at(x, y, 0) > 0.0f && share > 0.1 && share < 0.9 ? 1 : 0;
            }
        }
        blurred.push_back(pixels);
    }
    EXPECT_LT(texels[1], 0.25 * texels[0]);
    EXPECT_GT(blurred[0], 20.0);
    EXPECT_LT(blurred[1], 0.6 * blurred[0]);
}

// A lamp next to what is near shines on a wall far off: there its texels are the largest.
scene::Scene farWall() {
    return makeScene({{0.0, 1.1, 3.0}, {0.0, 0.9, 0.0}, 40.0, 0.01},
                     lampAt({0, 0.75, 1.2}) +
                         object("ball", "sphere", "glass", {0, 0.8, 0.3}, "radius = 0.2") +
                         object("table", "plane", "grey", {0, 0, 1.5}, "size = [2.5, 3]") +
                         object("wall", "plane", "grey", {0, 1.2, -4},
                                "size = [5, 4]\nrotation_degrees = [90, 0, 0]"));
}

// Texels along a side of a pixel in the finest map that looks it up, at each pixel whose neighbours
// see the same surface: from where the corners of the pixel are, not from any formula.
std::vector<double> texelsPerPixel(const MapFrame& frame) {
    const auto& maps = frame.renderer().outputs().map.maps;
    const Texels receiver = frame.read("eye.receiver");
    std::vector<double> found;
    for (int y = 0; y + 1 < receiver.height; ++y) {
        for (int x = 0; x + 1 < receiver.width; ++x) {
            const auto depth = double{receiver.at(x, y, 0)};
            const auto right = double{receiver.at(x + 1, y, 0)};
            const auto above = double{receiver.at(x, y + 1, 0)};
            if (depth <= 0.0 || std::abs(right / depth - 1.0) > 0.05 || above <= 0.0 ||
                std::abs(above / depth - 1.0) > 0.05)
                continue;
            double finest = 0.0;
            for (const FluxMap& map : maps) {
                const render::RasterViews& views = *map.on.views;
                const double border = map.cascade > 0 ? 0.0625 * views.width() : 0.0;
                for (int view = 0; view < views.count(); ++view) {
                    const render::RasterView& seen = views.view(view);
                    const glm::dvec2 at = texelOn(seen, frame.worldAt(x, y, depth));
                    const glm::dvec3 p(seen.worldToView *
                                       glm::dvec4(frame.worldAt(x, y, depth), 1.0));
                    if (p.z >= 0.0 || std::min(at.x, at.y) < border ||
                        std::max(at.x, at.y) > views.width() - border)
                        continue;
                    const glm::dvec2 u = texelOn(seen, frame.worldAt(x + 1, y, right)) - at;
                    const glm::dvec2 v = texelOn(seen, frame.worldAt(x, y + 1, above)) - at;
                    // The last that has it is looked up.
                    finest = std::sqrt(std::abs(u.x * v.y - u.y * v.x));
                }
            }
            if (finest > 0.0) found.push_back(finest);
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

TEST(MapCascades, ByMagnificationLieWhereTexelsAreLargestOnTheScreen) {
    const Settings chosen{
        {"trace", "background"}, {"specular", "two_interfaces"}, {"reconstruct.map_size", "32"}};
    const auto with = [&](const char* by, int count) {
        Settings settings = chosen;
        settings.emplace_back("reconstruct.map_cascades_by", by);
        return cascades(farWall(), count, settings);
    };
    const std::vector<double> one = texelsPerPixel(with("depth", 1));
    const std::vector<double> byDepth = texelsPerPixel(with("depth", 4));
    const MapFrame parts = with("magnification", 4);
    const std::vector<double> byMagnification = texelsPerPixel(parts);
    ASSERT_EQ(one.size(), byMagnification.size());
    ASSERT_GT(one.size(), 1000u);
    EXPECT_EQ(parts.renderer().outputs().map.maps.size(), 4u);
    // What is near has no larger texels than the rest, and most of the picture is the wall.
    const std::size_t middle = one.size() / 2;
    EXPECT_LT(byDepth[middle], 1.1 * one[middle]);
    EXPECT_GT(byMagnification[middle], 1.8 * one[middle]);
    // Nowhere are they larger than without.
    for (std::size_t i = 0; i < one.size(); i += 50)
        EXPECT_GE(byMagnification[i], 0.999 * one[i]);
    parts.expectBalance();
}

const std::string kSlantedSun =
    "[[light]]\nname = \"slanted\"\ntype = \"directional\"\ndirection = [0.8, -0.6, 0]\n"
    "irradiance = 100\n";

// A pixel and a texel straight above one another: both are squares of known sides.
TEST(MapCascades, MeasureHowManyPixelsATexelCovers) {
    const scene::Scene scene =
        makeScene({{0, 3, 0.0005}, {0, -1, 0}, 60.0, 0.01},
                  sun({0, -1, 0}) + lampAt({0, 1, 0}) + kSlantedSun +
                      floorPlane("floor", "grey", 8, {0, -1, 0}) +
                      object("ball", "sphere", "glass", {0, 0, 0}, "radius = 0.3"));
    const render::RasterView eye = render::makeEyeView(scene.camera, 80, 60);
    const std::vector<SeenPlace> places = seenPlaces(scene, eye);
    ASSERT_EQ(places.size(), 80u * 60u);
    const scene::Bounds bounds = scene::sceneBounds(scene);
    const double pixel = 2.0 * std::tan(glm::radians(30.0)) * 4.0 / 60.0;
    for (std::size_t light = 0; light < 3; ++light) {
        const render::RasterView map =
            render::inPixels(render::makeLightView(scene.lights[light], bounds, bounds), 100, 100);
        // The lamp is 2 m above the floor; of the slanted sun's texels only one side is longer.
        const std::array<double, 3> longer{1.0, 2.0, 1.0 / std::sqrt(0.6)};
        const double texel = map.footprintPerMeter() * longer[light];
        int seen = 0;
        for (const SeenPlace& place : places) {
            ASSERT_NEAR(place.place.y, -1.0, 1e-6);
            // Each pixel and each texel of a view that looks straight down covers as much of a
            // floor as the one in the middle.
            const double pixels = pixelsPerTexel(place, map);
            if (!(pixels > 0.0)) continue;
            ++seen;
            EXPECT_NEAR(pixels, texel / pixel, 1e-3 * texel / pixel);
        }
        EXPECT_GT(seen, 1000) << light;
    }
}

TEST(MapCascades, ThatWouldBeNoFinerAreLeftOutAndSaid) {
    // From straight above, all of the floor is as far away.
    const scene::Scene scene =
        makeScene({{0, 3, 0.01}, {0, -1, 0}},
                  sun({0, -1, 0}) + object("ball", "sphere", "glass", {0, 0, 0}, "radius = 0.3") +
                      floorPlane("floor", "grey", 2, {0, -1, 0}));
    const MapFrame frame =
        cascades(scene, 4, {{"trace", "background"}, {"specular", "two_interfaces"}});
    EXPECT_EQ(frame.renderer().outputs().map.maps.size(), 1u);
    const auto& said = frame.renderer().warnings();
    EXPECT_TRUE(std::any_of(said.begin(), said.end(), [](const std::string& warning) {
        return warning.find("reconstruct.map_cascades = 4") != std::string::npos;
    }));
}

}  // namespace
}  // namespace kaustik::test
