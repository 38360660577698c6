// SPDX-License-Identifier: MIT
// view.refraction.stop (K06, section 4) against closed forms. In bodies of which the eye sees a
// front and a back, both rules find where a ray leaves: a slab, a ball, and a prism that sends the
// ray back through the layer that it has come in by. Where a ray passes behind a part that lies
// nearer to the eye, the paper's rule ends it there, as it says, and the crossing test does not.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/exact.h"
#include "framework/transport/types.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using glm::dvec3;

constexpr int kWidth = 160;
constexpr int kHeight = 120;

// The eye is at the origin and looks down -Z.
struct Exit {
    dvec3 position{0.0};
    dvec3 direction{0.0};
    int interfaces = 0;
};
using Exact = std::function<std::optional<Exit>(const dvec3& ray)>;

struct Found {
    int pixels = 0;
    int wrong = 0;           // lost, or of other interfaces
    double position = 0.0;   // largest deviation, m
    double direction = 0.0;  // largest deviation
};

class RefractionStop : public testing::TestWithParam<const char*> {
  protected:
    static Settings settings(const char* stop = GetParam()) {
        return {{"emit.photons", "8x8"},
                {"view.refraction.search", "monotonic"},
                {"view.refraction.stop", stop},
                {"view.refraction.scene", "false"}};
    }
    static Frame render(const scene::Scene& scene, const Settings& settings) {
        return {scene, kWidth, kHeight, settings, {"view.exit_position", "view.exit_direction"}};
    }
    static dvec3 rayOf(const Frame& frame, int x, int y) {
        return glm::normalize(frame.worldAt(x, y, 1.0));
    }
    static Found compare(const scene::Scene& scene, const Exact& exact,
                         const Settings& set = settings()) {
        const Frame frame = render(scene, set);
        const Texels positions = frame.read("view.exit_position");
        const Texels directions = frame.read("view.exit_direction");
        Found found;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const std::optional<Exit> expected = exact(rayOf(frame, x, y));
                if (!expected) continue;
                ++found.pixels;
                if (directions.at(x, y, 3) != transport::kPathExited ||
                    positions.at(x, y, 3) != static_cast<float>(expected->interfaces)) {
                    ++found.wrong;
                    continue;
                }
                found.position = std::max(found.position,
                                          glm::distance(positions.rgb(x, y), expected->position));
                found.direction = std::max(
                    found.direction, glm::distance(directions.rgb(x, y), expected->direction));
            }
        }
        return found;
    }
};

// A ray to the plane z = -`depth`.
dvec3 atDepth(const dvec3& from, const dvec3& direction, double depth) {
    return from + direction * ((-depth - from.z) / direction.z);
}
const dvec3 kTowardsEye(0.0, 0.0, 1.0);

TEST_P(RefractionStop, FindsTheExitOfASlab) {
    const double turn = glm::radians(25.0);
    const dvec3 normal(std::sin(turn), 0.0, std::cos(turn));
    const dvec3 side(std::cos(turn), 0.0, -std::sin(turn));
    const dvec3 center(0.0, 0.0, -4.0);
    const Found found =
        compare(makeScene({{}, {0.0, 0.0, -1.0}, 40.0, 0.01},
                          object("slab", "box", "glass", center,
                                 "size = [8, 8, 1]\nrotation_degrees = [0, 25, 0]")),
                [&](const dvec3& ray) -> std::optional<Exit> {
                    const dvec3 entry =
                        ray * (glm::dot(center + 0.5 * normal, normal) / glm::dot(ray, normal));
                    const dvec3 inside = exactInterface(ray, normal, 1.0, kGlassIndex).refracted;
                    const dvec3 exit = entry - inside / glm::dot(inside, normal);
                    for (const dvec3& point : {entry, exit}) {
                        const dvec3 local = point - center;
                        if (std::abs(glm::dot(local, side)) > 3.8 || std::abs(local.y) > 3.8)
                            return std::nullopt;
                    }
                    return Exit{exit, ray, 2};
                });
    EXPECT_EQ(found.pixels, kWidth * kHeight);
    EXPECT_EQ(found.wrong, 0);
    // 32-bit view depths and normals at 5 m, divided by cosines.
    EXPECT_LT(found.position, 2e-5);
    // Roundings of 6e-8 in two refractions, and in the eye's ray.
    EXPECT_LT(found.direction, 2e-6);
}

TEST_P(RefractionStop, FindsTheExitOfABall) {
    const dvec3 center(0.0, 0.0, -4.0);
    const Found found = compare(
        makeScene({{}, {0.0, 0.0, -1.0}, 36.0, 0.01},
                  object("ball", "sphere", "glass", center, "radius = 1\nsegments = 512")),
        [&](const dvec3& ray) -> std::optional<Exit> {
            const double along = glm::dot(center, ray);
            const double square = glm::dot(center, center) - along * along;
            if (square > 0.81) return std::nullopt;
            const dvec3 entry = (along - std::sqrt(1.0 - square)) * ray;
            const dvec3 inside = exactInterface(ray, entry - center, 1.0, kGlassIndex).refracted;
            const dvec3 exit = entry - 2.0 * glm::dot(inside, entry - center) * inside;
            return Exit{exit, exactInterface(inside, center - exit, kGlassIndex, 1.0).refracted, 2};
        });
    EXPECT_GT(found.pixels, 5000);
    EXPECT_EQ(found.wrong, 0);
    // Facets of 1/512 of the circumference lie 2e-5 of the radius below the ball, their normals are
    // interpolated, and both refractions at 64 degrees multiply what is missing.
    EXPECT_LT(found.position, 1e-3);
    EXPECT_LT(found.direction, 2e-3);
}

// Of a prism of 90 degrees whose base faces the eye both sides reflect all of what is within 3
// degrees of the base's normal: it comes back along its own direction, and leaves by the base. That
// is "nearer than the current layer".
constexpr double kBase = 19.5;  // its depth; the edge behind it is 1 m deeper
constexpr double kFovDegrees = 4.6;
scene::Scene prism(const std::string& parts = "") {
    return makeScene({{}, {0.0, 0.0, -1.0}, kFovDegrees, 0.01},
                     object("prism", "prism", "glass", {0, 0, -20},
                            "apex_degrees = 90\nheight = 1\nlength = 3\n"
                            "rotation_degrees = [-90, 0, 0]") +
                         parts);
}
// A ray that meets the base at `point`: where it leaves it. Nothing within a few pixels of the
// prism's edges, or where it leaves above or below the picture.
std::optional<Exit> backOutOfPrism(dvec3 point, const dvec3& ray) {
    if (std::abs(point.x) > 0.92 || std::abs(point.x) < 0.06) return std::nullopt;
    dvec3 direction = exactInterface(ray, kTowardsEye, 1.0, kGlassIndex).refracted;
    double side = point.x < 0.0 ? -1.0 : 1.0;
    for (int reflection = 0; reflection < 2; ++reflection) {
        const dvec3 outward = glm::normalize(dvec3(side, 0.0, -1.0));
        const dvec3 edge(0.0, 0.0, -kBase - 1.0);
        point += direction * (glm::dot(edge - point, outward) / glm::dot(direction, outward));
        const ExactInterface at = exactInterface(direction, -outward, kGlassIndex, 1.0);
        EXPECT_EQ(at.reflectance, 1.0);
        direction = at.reflected;
        side = -side;
    }
    point = atDepth(point, direction, kBase);
    if (std::abs(point.y) > 0.98 * kBase * std::tan(glm::radians(0.5 * kFovDegrees)))
        return std::nullopt;
    return Exit{point, exactInterface(direction, -kTowardsEye, kGlassIndex, 1.0).refracted, 4};
}

TEST_P(RefractionStop, FindsTheWayOutThroughTheLayerThatTheRayHasComeInBy) {
    const Found found = compare(prism(), [](const dvec3& ray) {
        return backOutOfPrism(atDepth(dvec3(0.0), ray, kBase), ray);
    });
    EXPECT_GT(found.pixels, 10000);
    EXPECT_EQ(found.wrong, 0);
    // Three planes' 32-bit view depths, of 2e-6 m at 20 m, along rays that close in at 45 degrees.
    EXPECT_LT(found.position, 5e-5);
    EXPECT_LT(found.direction, 4e-6);
}

// A ray that has left the prism by the layer that it had come in by is before that layer: the next
// one is the back of a plate that it has passed before.
TEST_P(RefractionStop, FindsTheWayBackThroughAPlateInFrontOfIt) {
    constexpr double kNear = 16.0;
    constexpr double kFar = 16.5;
    Settings enough = settings();
    enough.emplace_back("view.refraction.interfaces", "6");
    const Found found = compare(
        prism(object("plate", "box", "glass", {0, 0, -0.5 * (kNear + kFar)}, "size = [9, 9, 0.5]")),
        [](const dvec3& ray) -> std::optional<Exit> {
            const auto inPlate = [](const dvec3& outside) {
                const dvec3 normal = outside.z < 0.0 ? kTowardsEye : -kTowardsEye;
                return exactInterface(outside, normal, 1.0, kGlassIndex).refracted;
            };
            const dvec3 behind = atDepth(atDepth(dvec3(0.0), ray, kNear), inPlate(ray), kFar);
            std::optional<Exit> exit = backOutOfPrism(atDepth(behind, ray, kBase), ray);
            if (!exit) return exit;
            const dvec3 back = atDepth(exit->position, exit->direction, kFar);
            exit->position = atDepth(back, inPlate(exit->direction), kNear);
            exit->interfaces = 8;
            // It goes on to be farther from the middle of the picture.
            if (std::abs(exit->position.y) >
                    0.98 * kNear * std::tan(glm::radians(0.5 * kFovDegrees)) ||
                std::abs(exit->position.x) >
                    0.98 * kNear * std::tan(glm::radians(0.5 * kFovDegrees)) * kWidth / kHeight)
                return std::nullopt;
            return exit;
        },
        enough);
    EXPECT_GT(found.pixels, 5000);
    EXPECT_EQ(found.wrong, 0);
    // Seven planes as above.
    EXPECT_LT(found.position, 1e-4);
    EXPECT_LT(found.direction, 8e-6);
}

// A block of glass whose back is 8 m deep, and nearer to the eye a strip of it that is three pixels
// wide. Rays that enter the block left of the strip are bent to the right and pass behind it.
constexpr double kFront = 2.0;
constexpr double kBack = 8.0;
constexpr double kPixelsPerTangent = 80.0;
constexpr int kStripColumn = 24;  // its first
scene::Scene blockBehindAStrip() {
    return makeScene(
        {{}, {0.0, 0.0, -1.0}, glm::degrees(2.0 * std::atan(0.75)), 0.01},
        object("block", "box", "glass", {0, 0, -0.5 * (kFront + kBack)}, "size = [40, 40, 6]") +
            object("strip", "box", "glass", {-1.02, 0, -1.5025}, "size = [0.06, 10, 0.005]"));
}
double columnOf(const dvec3& point) {
    return kPixelsPerTangent * (1.0 - point.x / point.z);
}
// What enters the block left of the strip and leaves it right of it, each by some pixels.
std::optional<Exit> throughBlock(const dvec3& ray) {
    const dvec3 entry = atDepth(dvec3(0.0), ray, kFront);
    const dvec3 inside = exactInterface(ray, kTowardsEye, 1.0, kGlassIndex).refracted;
    const dvec3 exit = atDepth(entry, inside, kBack);
    if (columnOf(entry) > kStripColumn - 3.0 || columnOf(exit) < kStripColumn + 6.0)
        return std::nullopt;
    return Exit{exit, ray, 2};
}

class PartInFront : public RefractionStop {};

TEST_F(PartInFront, IsPassedByTheCrossingTest) {
    Settings two = settings("crossing");
    two.emplace_back("view.refraction.interfaces", "2");
    const Frame frame = render(blockBehindAStrip(), two);
    const Texels positions = frame.read("view.exit_position");
    int pixels = 0;
    double worst = 0.0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const std::optional<Exit> exact = throughBlock(rayOf(frame, x, y));
            if (!exact) continue;
            ++pixels;
            EXPECT_EQ(positions.at(x, y, 3), 2.0f) << x << " " << y;
            worst = std::max(worst, glm::distance(positions.rgb(x, y), exact->position));
        }
    }
    EXPECT_GT(pixels, 800);
    // 32-bit view depths and normals at 8 m, along rays at up to 40 degrees.
    EXPECT_LT(worst, 5e-5);
}

TEST_F(PartInFront, EndsTheRayByThePapersRuleWhereItComesToLieBehindIt) {
    Settings two = settings("depth");
    two.emplace_back("view.refraction.interfaces", "2");
    const Frame frame = render(blockBehindAStrip(), two);
    const Texels positions = frame.read("view.exit_position");
    const Texels directions = frame.read("view.exit_direction");
    int pixels = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const dvec3 ray = rayOf(frame, x, y);
            if (!throughBlock(ray)) continue;
            ++pixels;
            ASSERT_EQ(positions.at(x, y, 3), 2.0f) << x << " " << y;
            const dvec3 exit = positions.rgb(x, y);
            // "Greater than the depth in the next layer", which is the strip's back from its first
            // column on. What is not crossed nearby is taken to be hit up to two steps of a pixel
            // before the middle of the one that says so.
            EXPECT_NEAR(columnOf(exit), kStripColumn, 2.0) << x << " " << y;
            EXPECT_GT(-exit.z, kFront);
            EXPECT_LT(-exit.z, kBack);
            // On the refracted ray: positions of some metres, of 32 bits.
            const dvec3 entry = atDepth(dvec3(0.0), ray, kFront);
            const dvec3 inside = exactInterface(ray, kTowardsEye, 1.0, kGlassIndex).refracted;
            EXPECT_LT(glm::length(glm::cross(exit - entry, inside)), 1e-5);
            // The strip's back is parallel to the front that the ray has come in by.
            EXPECT_LT(glm::distance(directions.rgb(x, y), ray), 2e-6);
        }
    }
    EXPECT_GT(pixels, 800);
}

INSTANTIATE_TEST_SUITE_P(By, RefractionStop, testing::Values("crossing", "depth"),
                         [](const testing::TestParamInfo<const char*>& tested) {
                             return std::string(tested.param);
                         });

}  // namespace
}  // namespace kaustik::test
