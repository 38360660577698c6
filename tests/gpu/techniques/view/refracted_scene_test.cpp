// SPDX-License-Identifier: MIT
// The refracted scene of view.refraction (K06, section 4 and Fig. 10): the radiance that the eye
// sees through flat water, a ball and a block of glass, where each exact ray ends, by Snell's law
// and Fresnel's equations in double. All light is the fill light, so that the radiance of every
// receiver is known. And which surfaces are found: what the picture shows, or all of the layers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>

#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/exact.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using glm::dvec2;
using glm::dvec3;

constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr double kBackground = 2.0;       // W/m²/sr, of makeScene
constexpr double kFillIrradiance = 20.0;  // W/m²
constexpr double kDark = 0.25;            // both are exact in the 16 bits that albedos have
constexpr double kBright = 0.75;

// Squares of which every other one is bright.
std::string checker(double squareMeters) {
    return fmt::format(
        "[[material]]\nname = \"checker\"\ntype = \"lambertian\"\nalbedo = {}\n"
        "pattern = \"checker\"\npattern_albedo = {}\nuv_scale = {}\n",
        kDark, kBright, number(1.0 / squareMeters));
}
// Of a point on a square sheet, by its coordinates from the sheet's middle.
double checkerAlbedo(const dvec2& fromMiddle, double side, double squareMeters) {
    const dvec2 square = glm::floor((fromMiddle + 0.5 * side) / squareMeters);
    return std::fmod(square.x + square.y, 2.0) == 0.0 ? kDark : kBright;
}

scene::Scene filled(scene::Scene scene) {
    scene.ambientIrradiance = glm::vec3(static_cast<float>(kFillIrradiance));
    return scene;
}
double radianceOf(double albedo) {
    return albedo * kFillIrradiance / std::numbers::pi;
}

class RefractedScene : public testing::TestWithParam<const char*> {
  protected:
    static Frame render(const scene::Scene& scene, const Settings& more = {}) {
        Settings settings = {{"emit.photons", "8x8"}, {"view.refraction.surfaces", GetParam()}};
        settings.insert(settings.end(), more.begin(), more.end());
        return {scene, kWidth, kHeight, settings, {"view.radiance"}};
    }
    static dvec3 eyeOf(const Frame& frame) { return frame.toWorld(dvec3(0.0)); }
    static dvec3 rayOf(const Frame& frame, int x, int y) {
        return glm::normalize(frame.worldAt(x, y, 1.0) - eyeOf(frame));
    }
    // Where a point of the world is seen, px.
    static dvec2 pixelOf(const Frame& frame, const dvec3& point) {
        const dvec3 seen(frame.view().worldToView * glm::dvec4(point, 1.0));
        return 0.5 * dvec2(kWidth, kHeight) +
               dvec2(seen) / (-seen.z * frame.view().footprintPerMeter());
    }
    // The albedo around a pixel position by `albedoAt` of the direction there, unit, where it is
    // the same two pixels around: radiance is looked up between pixels, each of which has the
    // mean of what it covers. None at the border of the picture.
    static std::optional<double> evenAlbedo(const Frame& frame, const dvec2& pixel,
                                            const std::function<double(const dvec3&)>& albedoAt) {
        if (pixel.x < 3.0 || pixel.y < 3.0 || pixel.x > kWidth - 3.0 || pixel.y > kHeight - 3.0)
            return std::nullopt;
        const double albedo = albedoAt(direction(frame, pixel));
        for (int i = 0; i < 9; ++i) {
            const dvec2 offset = 2.0 * dvec2(i % 3 - 1, i / 3 - 1);
            if (albedoAt(direction(frame, pixel + offset)) != albedo) return std::nullopt;
        }
        return albedo;
    }

  private:
    static dvec3 direction(const Frame& frame, const dvec2& pixel) {
        const double footprint = frame.view().footprintPerMeter();
        const dvec3 inView((pixel - 0.5 * dvec2(kWidth, kHeight)) * footprint, -1.0);
        return glm::normalize(frame.toWorld(inView) - eyeOf(frame));
    }
};

// 32-bit radiance of a few terms, and reflectance by 32-bit cosines.
constexpr double kRelative = 2e-5;
// Albedos are kept as 16-bit floats, of which a step is 2^-10 of the number at most; that of a
// square's middle may come out just below the square's own.
constexpr double kAlbedoStep = 1.0 / 1024.0;

TEST_P(RefractedScene, IsTheFloorUnderFlatWaterWhereSnellsLawSays) {
    constexpr double kFloorDepth = 0.8;
    constexpr double kSquare = 0.3;
    constexpr double kSide = 30.0;
    const scene::Scene scene = filled(
        makeScene({{0.2, 1.6, 1.4}, {0.0, -0.6, -0.6}, 50.0, 0.01},
                  checker(kSquare) + floorPlane("floor", "checker", kSide, {0, -kFloorDepth, 0}) +
                      floorPlane("water", "water", 20, {0, 0, 0})));
    const Frame frame = render(scene);
    const Texels radiance = frame.read("view.radiance");
    const dvec3 eye = eyeOf(frame);
    const auto floorAlong = [&](const dvec3& from, const dvec3& ray) {
        return from + ray * ((-kFloorDepth - from.y) / ray.y);
    };
    const auto albedoAt = [&](const dvec3& point) {
        return checkerAlbedo({point.x, point.z}, kSide, kSquare);
    };
    int pixels = 0;
    int moved = 0;  // whose straight ray would see another square
    double worst = 0.0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const dvec3 ray = rayOf(frame, x, y);
            const dvec3 entry = eye + ray * (-eye.y / ray.y);
            const ExactInterface water = exactInterface(ray, {0, 1, 0}, 1.0, kWaterIndex);
            const dvec3 seen = floorAlong(entry, water.refracted);
            const auto albedo = evenAlbedo(frame, pixelOf(frame, seen), [&](const dvec3& other) {
                return albedoAt(floorAlong(eye, other));
            });
            if (!albedo) continue;
            ++pixels;
            moved += albedoAt(floorAlong(eye, ray)) != *albedo ? 1 : 0;
            // What comes out of a medium of index n has 1/n² of the radiance inside (C28a).
            const double expected =
                water.reflectance * kBackground +
                (1.0 - water.reflectance) * radianceOf(*albedo) / (kWaterIndex * kWaterIndex);
            worst = std::max(worst, std::abs(radiance.rgb(x, y).g / expected - 1.0));
        }
    }
    EXPECT_GT(pixels, 4000);
    EXPECT_GT(moved, 1500);
    EXPECT_LT(worst, kAlbedoStep + kRelative);
}

TEST_P(RefractedScene, IsTheWallBehindABallTurnedUpsideDown) {
    constexpr double kWall = 9.0;
    constexpr double kSquare = 1.6;
    constexpr double kSide = 32.0;
    const dvec3 center(0.0, 0.0, -3.0);
    const scene::Scene scene = filled(
        makeScene({{}, {0.0, 0.0, -1.0}, 50.0, 0.01},
                  checker(kSquare) + facingPlane("wall", "checker", kSide, {0, 0, -kWall}) +
                      object("ball", "sphere", "glass", center, "radius = 1\nsegments = 512")));
    const Frame frame = render(scene);
    const Texels radiance = frame.read("view.radiance");
    // Rotated by 90 degrees about x, the sheet's z goes down.
    const auto albedoAt = [&](const dvec3& from, const dvec3& ray) {
        const dvec3 point = from + ray * ((-kWall - from.z) / ray.z);
        return checkerAlbedo({point.x, -point.y}, kSide, kSquare);
    };
    int pixels = 0;
    int moved = 0;
    double worst = 0.0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const dvec3 ray = rayOf(frame, x, y);
            const double along = glm::dot(center, ray);
            const double square = glm::dot(center, center) - along * along;
            // Farther out a pixel sees more than a pixel of the wall.
            if (square > 0.6 * 0.6) continue;
            const dvec3 entry = (along - std::sqrt(1.0 - square)) * ray;
            const ExactInterface in = exactInterface(ray, entry - center, 1.0, kGlassIndex);
            const dvec3 exit = entry - 2.0 * glm::dot(in.refracted, entry - center) * in.refracted;
            const ExactInterface out =
                exactInterface(in.refracted, center - exit, kGlassIndex, 1.0);
            const dvec3 seen = exit + out.refracted * ((-kWall - exit.z) / out.refracted.z);
            const auto albedo = evenAlbedo(frame, pixelOf(frame, seen), [&](const dvec3& other) {
                return albedoAt(dvec3(0.0), other);
            });
            if (!albedo) continue;
            ++pixels;
            moved += albedoAt(dvec3(0.0), ray) != *albedo ? 1 : 0;
            const double expected = in.reflectance * kBackground + (1.0 - in.reflectance) *
                                                                       (1.0 - out.reflectance) *
                                                                       radianceOf(*albedo);
            worst = std::max(worst, std::abs(radiance.rgb(x, y).g / expected - 1.0));
        }
    }
    EXPECT_GT(pixels, 500);
    EXPECT_GT(moved, 100);
    // Reflectance by normals that facets of 1/512 of the circumference interpolate: they are off by
    // 2e-3 where the ray leaves (F.ball), the wall's place by 1 cm, a seventh of a pixel.
    EXPECT_LT(worst, kAlbedoStep + 1e-3);
}

// A block of glass before the eye, a wall far behind it, and a plate between them. Bent rays pass
// the plate and see of the wall what the plate hides from the eye.
class HiddenScene : public RefractedScene {
  protected:
    static constexpr double kFront = 2.0;
    static constexpr double kBack = 8.0;
    static constexpr double kPlate = 8.5;
    static constexpr double kWall = 30.0;
    static constexpr double kPlateLeft = -6.5;
    static constexpr double kPlateRight = -4.4;

    static scene::Scene scene(const std::string& parts = "") {
        return filled(makeScene(
            {{}, {0.0, 0.0, -1.0}, glm::degrees(2.0 * std::atan(0.75)), 0.01},
            facingPlane("wall", "grey", 100, {0, 0, -kWall}) +
                object("plate", "plane", "white", {0.5 * (kPlateLeft + kPlateRight), 0, -kPlate},
                       fmt::format("size = [{}, 30]\nrotation_degrees = [90, 0, 0]",
                                   number(kPlateRight - kPlateLeft))) +
                object("block", "box", "glass", {0, 0, -0.5 * (kFront + kBack)},
                       "size = [40, 40, 6]") +
                parts));
    }
    static dvec3 atDepth(const dvec3& from, const dvec3& direction, double depth) {
        return from + direction * ((-depth - from.z) / direction.z);
    }
    // Whether a ray, or one a few pixels next to it, may be on either side of the plate's edges.
    static bool isNearEdge(const dvec3& onPlate) {
        constexpr double kMargin = 3.0 * kPlate / 80.0;
        return std::abs(onPlate.x - kPlateLeft) < kMargin ||
               std::abs(onPlate.x - kPlateRight) < kMargin;
    }
    static bool isOnPlate(const dvec3& point) {
        return point.x > kPlateLeft && point.x < kPlateRight;
    }

    struct Counts {
        int plate = 0;
        int shown = 0;
        int hidden = 0;
    };
    // Where the exact ray of each pixel ends: `radianceAt` a point of the plate or the wall, which
    // hides from the eye what it says; nothing where that is not asked.
    enum class Place { plate, shown, hidden };
    static Counts expectRadiance(
        const scene::Scene& scene, double relative,
        const std::function<std::optional<double>(Place, const dvec3&)>& radianceAt) {
        const Frame frame = render(scene);
        const Texels radiance = frame.read("view.radiance");
        Counts counts;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const dvec3 ray = rayOf(frame, x, y);
                const dvec3 entry = atDepth(dvec3(0.0), ray, kFront);
                const ExactInterface in = exactInterface(ray, {0, 0, 1}, 1.0, kGlassIndex);
                const dvec3 exit = atDepth(entry, in.refracted, kBack);
                const dvec3 onPlate = atDepth(exit, ray, kPlate);
                const dvec3 onWall = atDepth(exit, ray, kWall);
                const dvec3 before = onWall * (kPlate / kWall);  // where the eye would see it
                if (isNearEdge(onPlate) || isNearEdge(before)) continue;
                const Place place = isOnPlate(onPlate)  ? Place::plate
                                    : isOnPlate(before) ? Place::hidden
                                                        : Place::shown;
                const std::optional<double> behind =
                    radianceAt(place, place == Place::plate ? onPlate : onWall);
                if (!behind) continue;
                ++(place == Place::plate    ? counts.plate
                   : place == Place::hidden ? counts.hidden
                                            : counts.shown);
                const double transmitted = (1.0 - in.reflectance) * (1.0 - in.reflectance);
                const double expected = in.reflectance * kBackground + transmitted * *behind;
                EXPECT_NEAR(radiance.rgb(x, y).g / expected, 1.0, relative) << x << " " << y;
            }
        }
        return counts;
    }
};

TEST_P(HiddenScene, IsSeenPastWhatHidesItWhereTheLayersAreAsked) {
    const bool asksLayers = std::string(GetParam()) == "layers";
    const Counts counts =
        expectRadiance(scene(), kRelative, [&](Place place, const dvec3&) -> std::optional<double> {
            if (place == Place::plate) return radianceOf(1.0);
            // Among receivers it is what no pixel shows: the ray is taken to see the environment.
            return place == Place::shown || asksLayers ? radianceOf(0.5) : kBackground;
        });
    EXPECT_GT(counts.plate, 1000);
    EXPECT_GT(counts.shown, 5000);
    EXPECT_GT(counts.hidden, 200);
}

// Of the layers alone.
class LitHiddenScene : public HiddenScene {};

// A sun from above right, and a roof that comes out of the wall: it shades the wall below it.
TEST_P(LitHiddenScene, IsShadedByWhatTheLayersShow) {
    constexpr double kSun = 100.0;
    constexpr double kRoof = 10.0;  // its height
    constexpr double kRoofDepth = 4.0;
    const dvec3 light = glm::normalize(dvec3(-0.3, -0.9, -0.3));
    const scene::Scene lit = scene(
        sun(light, kSun) + object("roof", "plane", "grey", {0, kRoof, 0.5 * kRoofDepth - kWall},
                                  fmt::format("size = [60, {}]", kRoofDepth)));
    int shaded = 0;
    const Counts counts = expectRadiance(
        lit, kRelative, [&](Place place, const dvec3& point) -> std::optional<double> {
            // What the picture shows has the block's caustic, too.
            if (place != Place::hidden) return std::nullopt;
            const double edge = kRoof + kRoofDepth * light.y / -light.z;
            // The roof's edge is known to a pixel, and to half a step more: seen from so far below
            // that is 0.85 m of the roof, and thrice as much of its shadow.
            const double pixel = (kWall - kRoofDepth) * (kWall - kRoofDepth) / (80.0 * kRoof);
            if (std::abs(point.y - edge) < 1.5 * pixel * light.y / light.z) return std::nullopt;
            // Nor where the roof itself is in the way of what the eye sees.
            if (point.y > kRoof - 1.0 && point.y < kRoof + 3.0) return std::nullopt;
            const bool isShaded = point.y > edge && point.y < kRoof;
            shaded += isShaded ? 1 : 0;
            return radianceOf(0.5) * (1.0 + (isShaded ? 0.0 : -light.z * kSun / kFillIrradiance));
        });
    EXPECT_GT(counts.hidden, 200);
    EXPECT_GT(shaded, 30);
}

INSTANTIATE_TEST_SUITE_P(Of, RefractedScene, testing::Values("receivers", "layers"),
                         [](const testing::TestParamInfo<const char*>& tested) {
                             return std::string(tested.param);
                         });
INSTANTIATE_TEST_SUITE_P(Of, LitHiddenScene, testing::Values("layers"));
INSTANTIATE_TEST_SUITE_P(Of, HiddenScene, testing::Values("receivers", "layers"),
                         [](const testing::TestParamInfo<const char*>& tested) {
                             return std::string(tested.param);
                         });

}  // namespace
}  // namespace kaustik::test
