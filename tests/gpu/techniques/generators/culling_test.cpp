// SPDX-License-Identifier: MIT
// Which specular objects are no caustic generators (U08, section 4.1): those of which flat
// receivers keep all light from what the eye sees, and no others; and that the picture is the same
// without them. What light can reach is plain from how the scenes are built.
#include "techniques/generators/culling.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "framework/numerics/cases/scene_text.h"
#include "framework/scene/surface_rays.h"
#include "techniques/generators/light_reach.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using namespace numerics;

std::string ball(const std::string& name, const glm::dvec3& position, double radius = 0.3) {
    return object(name, "sphere", "glass", position,
                  fmt::format("radius = {}\nsegments = 48", number(radius)));
}

std::string boxOf(const std::string& name, const glm::dvec3& position, const glm::dvec3& size) {
    return object(name, "box", "white", position, fmt::format("size = {}", numbers(size)));
}

const std::string kFloor = floorPlane("floor", "grey", 12, {0, 0, 0});
const std::string kSun = sun({0, -1, 0});
// Across the floor, as wide, from x = -0.1 to 0.1 and so thin that one face is another's back.
const std::string kThickWall = boxOf("wall", {0, 2, 0}, {0.2, 4, 12});
const std::string kThinWall =
    object("wall", "plane", "white", {0, 2, 0}, "size = [4, 12]\nrotation_degrees = [0, 0, 90]");
// Looks at the floor on the left of the wall; a ball at (2, 1, 0) is not in the picture.
const CameraText kLeft{{-4.0, 3.0, 3.0}, {-3.0, 0.0, 0.0}};

// Whether the last object's light may reach the picture.
bool mayLast(const CameraText& camera, const std::string& parts) {
    const scene::Scene scene = makeScene(camera, kSun + parts);
    return mayReachPicture(scene, render::makeEyeView(scene.camera, 64, 64)).back();
}

TEST(LightReach, IsNotThroughAWallThatIsAsWideAsTheFloor) {
    for (const std::string& wall : {kThinWall, kThickWall}) {
        EXPECT_FALSE(mayLast(kLeft, kFloor + wall + ball("b", {2, 1, 0})));
        EXPECT_FALSE(mayLast(kLeft, kFloor + wall + ball("a", {-3, 1, 0}) + ball("b", {2, 1, 0})));
    }
}

TEST(LightReach, IsOpenWithoutAWallOrPastOne) {
    const std::string b = ball("b", {2, 1, 0});
    EXPECT_TRUE(mayLast(kLeft, kFloor + b));
    // Past its end, below it, over it.
    EXPECT_TRUE(mayLast(kLeft, kFloor + boxOf("wall", {0, 2, 4}, {0.2, 4, 4}) + b));
    EXPECT_TRUE(mayLast(kLeft, kFloor + boxOf("wall", {0, 2.5, 0}, {0.2, 4, 12}) + b));
    EXPECT_TRUE(mayLast(kLeft, kFloor + boxOf("wall", {0, 0.25, 0}, {0.2, 0.5, 12}) + b));
    // Along it: the ball is in it.
    EXPECT_TRUE(mayLast(kLeft, kFloor + kThinWall + ball("b", {0.2, 1, 0})));
}

TEST(LightReach, IsNotToTheOtherSideOfWhatIsSeen) {
    const std::string cellar = ball("b", {-3, -1, 0});
    EXPECT_FALSE(mayLast(kLeft, kFloor + cellar));
    // Half of it is above.
    EXPECT_TRUE(mayLast(kLeft, kFloor + ball("b", {3, 0, 0})));
    // The eye is there too, and sees the floor's underside.
    EXPECT_TRUE(mayLast({{-4, -3, 3}, {-3, 0, 0}}, kFloor + ball("b", {5, -1, 0})));
}

TEST(LightReach, IsToWhatIsSeenAlone) {
    // The floor is on the left alone, on the right is another that is not in the picture.
    const std::string floors = object("f", "plane", "grey", {-4, 0, 0}, "size = [4, 4]") +
                               object("g", "plane", "grey", {40, 0, 0}, "size = [4, 4]");
    const CameraText down{{-4, 3, 0.01}, {-4, 0, 0}};
    const std::string screen = boxOf("screen", {30, 2, 0}, {0.2, 10, 60});
    EXPECT_FALSE(mayLast(down, floors + screen + ball("b", {40, 1, 0})));
    EXPECT_TRUE(mayLast(down, floors + ball("b", {40, 1, 0})));
}

TEST(LightReach, IsByWayOfOtherSpecularObjects) {
    const std::string b = ball("b", {2, 1, 0});
    // A mirror above the wall is lit by the ball, and lights the left.
    const std::string mirror = object("mirror", "plane", "mirror", {0, 6, 0}, "size = [3, 3]");
    EXPECT_TRUE(mayLast(kLeft, kFloor + kThickWall + mirror + b));
    // One that is in the picture itself, on the left, is not lit from there.
    const std::string own = object("own", "plane", "mirror", {-3, 0.5, 0}, "size = [1, 1]");
    EXPECT_FALSE(mayLast(kLeft, kFloor + kThickWall + own + b));
    // But as high up as to look over the wall it shows what the ball lights.
    const std::string high = object("high", "plane", "mirror", {-3, 9, 0}, "size = [1, 1]");
    const CameraText up{{-4, 3, 3}, {-3, 9, 0}};
    EXPECT_TRUE(mayLast(up, kFloor + kThickWall + high + b));
}

TEST(LightReach, IsEverywhereInAMedium) {
    EXPECT_TRUE(mayLast(kLeft, kFloor + kThickWall + "[medium]\nscattering_per_meter = 0.1\n" +
                                   ball("b", {2, 1, 0})));
}

// A wall nearer than the near plane is not drawn.
TEST(LightReach, IsNotStoppedByAWallThatTheEyeDoesNotSee) {
    const auto camera = [](double near) { return CameraText{{-0.35, 1, 0}, {5, 0, 0}, 60, near}; };
    const std::string parts = kFloor + kThickWall + ball("b", {2, 1, 5});
    EXPECT_FALSE(mayLast(camera(0.01), parts));
    EXPECT_TRUE(mayLast(camera(1.0), parts));
}

// Every place that a ray from a ball's box first hits, seen by the eye and facing it, must make it
// one that may: by rays, which know nothing of walls. Seeded; 200 scenes of boxes at random.
TEST(LightReach, IsNeverLessThanWhatRaysFind) {
    std::uint32_t state = 12345;
    const auto random = [&](double low, double high) {
        state = state * 1664525u + 1013904223u;
        return low + (high - low) * static_cast<double>(state >> 8) / 16777216.0;
    };
    int culled = 0;
    for (int round = 0; round < 200; ++round) {
        std::string parts = kSun + kFloor;
        const int walls = 1 + round % 4;
        for (int i = 0; i < walls; ++i) {
            const bool isAlong = i % 2 == 0;
            parts += boxOf(fmt::format("wall {}", i), {random(-2, 2), random(1, 3), random(-1, 1)},
                           isAlong ? glm::dvec3(0.2, random(2, 6), random(2, 14))
                                   : glm::dvec3(random(2, 14), random(2, 6), 0.2));
        }
        parts += ball("b", {random(1, 5), random(0.4, 2), random(-5, 5)});
        const CameraText camera{{random(-5, -1), random(1, 3), random(-4, 4)},
                                {random(-5, 1), 0.0, random(-3, 3)}};
        const scene::Scene scene = makeScene(camera, parts);
        const render::RasterView view = render::makeEyeView(scene.camera, 64, 64);
        if (mayReachPicture(scene, view).back()) continue;
        ++culled;
        const scene::SurfaceRays rays(scene, scene::receiversOf(scene));
        const scene::Bounds box = objectBounds(scene, scene.objects.back());
        const glm::dvec3 eye = scene.camera.position;
        for (int i = 0; i < 400; ++i) {
            const glm::dvec2 at(random(-1, 1), random(-1, 1));
            const glm::dvec3 direction =
                glm::normalize(glm::transpose(glm::dmat3(view.worldToView)) *
                               glm::dvec3(at * view.halfExtent, -1.0));
            const auto seen = rays.first(eye, direction);
            if (!seen) continue;
            const glm::dvec3 from(random(box.minimum.x, box.maximum.x),
                                  random(box.minimum.y, box.maximum.y),
                                  random(box.minimum.z, box.maximum.z));
            const glm::dvec3 way = seen->position - from;
            const double distance = glm::length(way);
            const bool isSameSide =
                glm::dot(seen->normal, way) * glm::dot(seen->normal, direction) > 0.0;
            EXPECT_TRUE(rays.isBlocked(from, way / distance, (1.0 - 1e-6) * distance) ||
                        !isSameSide)
                << round << " " << i;
        }
    }
    // Or nothing was tested.
    EXPECT_GT(culled, 10);
}

const Registry& registry() {
    static const Registry instance = registerAll();
    return instance;
}

struct Rendered {
    std::vector<float> irradiance;
    std::vector<float> picture;
    EnergyLedger ledger;
    std::size_t generators = 0;
    std::vector<std::string> leftOut;
};

Rendered renderWith(const scene::Scene& scene, const std::string& cull, Settings settings = {}) {
    Settings all{{"emit.photons", "96x64"},
                 {"reconstruct.map_size", "256"},
                 {"around.cubes.size", "64"},
                 {"around.cull", cull}};
    all.insert(all.end(), settings.begin(), settings.end());
    FrameRequest request{64, 48, all};
    request.keepsAll = request.poison = true;
    const numerics::Frame frame(context(), registry(), scene,
                                registry().findTechnique("caustic_triangles"), request);
    Rendered result;
    result.irradiance = frame.causticIrradiance().values;
    result.picture = frame.read(frame.renderer().outputs().picture.radiance).values;
    result.ledger = frame.renderer().ledger();
    result.generators = frame.renderer().outputs().map.maps.size();
    for (const graph::PassRecord& pass : frame.renderer().compiled().records) {
        if (pass.name.starts_with("around.'")) result.leftOut.push_back(pass.name + pass.reason);
    }
    return result;
}

// The first few of the values that are not equal to the bit, and how many there are.
std::string differences(const std::vector<float>& a, const std::vector<float>& b) {
    std::string said;
    std::size_t count = a.size() == b.size() ? 0 : 1;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        if (a[i] == b[i]) continue;
        if (++count <= 5) said += fmt::format("{}: {} {}; ", i, a[i], b[i]);
    }
    return count == 0 ? "" : fmt::format("{}{} differ", said, count);
}

double offScreen(const Rendered& rendered) {
    return rendered.ledger.watts[transport::kAccountOffScreen];
}

TEST(CullingByTheEye, LeavesThePictureAsItIsAndFollowsFewerPhotons) {
    // So thick that no texel of a map sees the floor on both sides of it: through a thinner one a
    // little light leaks where light is looked up, which is away then too.
    const std::string wall = boxOf("wall", {0.5, 2, 0}, {1.2, 4, 12});
    const scene::Scene scene =
        makeScene(kLeft, kSun + kFloor + wall + ball("a", {-3, 1, 0}) + ball("b", {2, 1, 0}));
    std::vector<Settings> ways{Settings{}, Settings{{"emit.batch", "2048"}},
                               Settings{{"emit", "deferred"}},
                               Settings{{"driver", "hierarchical"}}};
    if (!lacksExactTracer()) ways.push_back(Settings{{"trace", "raytraced"}});
    for (const Settings& settings : ways) {
        const Rendered all = renderWith(scene, "light", settings);
        const Rendered seen = renderWith(scene, "eye", settings);
        EXPECT_EQ(all.generators, 2u);
        EXPECT_EQ(seen.generators, 1u);
        EXPECT_EQ(differences(seen.irradiance, all.irradiance), "");
        EXPECT_EQ(differences(seen.picture, all.picture), "");
        EXPECT_GT(*std::max_element(seen.irradiance.begin(), seen.irradiance.end()), 100.0f);
        // Both balls are lit alike: half of the light, and more than a third of the photons.
        EXPECT_LT(static_cast<double>(seen.ledger.traced),
                  0.67 * static_cast<double>(all.ledger.traced));
        const double emitted = seen.ledger.watts[transport::kAccountEmitted];
        EXPECT_NEAR(emitted, all.ledger.watts[transport::kAccountEmitted], 1e-6 * emitted);
        EXPECT_NEAR(offScreen(seen) / emitted, 0.5, 0.02);
        EXPECT_LT(std::abs(seen.ledger.balance()), 1e-5);
        ASSERT_EQ(seen.leftOut.size(), 1u);
        EXPECT_NE(seen.leftOut[0].find("'b'its light comes to nothing"), std::string::npos);
        EXPECT_TRUE(all.leftOut.empty());
    }
}

TEST(CullingByTheEye, KeepsABallNextToThePictureWhoseCausticIsInIt) {
    // The sun comes from the right, so that the light of the ball on the right falls to the left.
    const scene::Scene scene = makeScene({{-0.4, 3.0, 0.01}, {-0.4, 0.0, 0.0}, 40},
                                         sun({-1, -1, 0}) + kFloor + ball("b", {1.2, 1, 0}));
    const Rendered all = renderWith(scene, "none");
    const Rendered seen = renderWith(scene, "eye");
    EXPECT_EQ(seen.generators, 1u);
    EXPECT_EQ(differences(seen.irradiance, all.irradiance), "");
    EXPECT_TRUE(seen.leftOut.empty());
    // A fifth of the sunlight, far from where it converges.
    EXPECT_GT(*std::max_element(seen.irradiance.begin(), seen.irradiance.end()), 150.0f);
}

TEST(CullingByTheEye, MayLeaveNothing) {
    const scene::Scene scene = makeScene(kLeft, kSun + kFloor + kThickWall + ball("b", {2, 1, 0}));
    const Rendered seen = renderWith(scene, "eye");
    EXPECT_EQ(*std::max_element(seen.irradiance.begin(), seen.irradiance.end()), 0.0f);
    EXPECT_EQ(seen.ledger.traced, 0u);
    EXPECT_NEAR(offScreen(seen) / seen.ledger.watts[transport::kAccountEmitted], 1.0, 1e-5);
}

TEST(CullingByLight, IsSaidAndNoneTakesAll) {
    const std::string spot =
        "[[light]]\nname = \"spot\"\ntype = \"spot\"\nposition = [-2, 4, 0]\n"
        "direction = [0, -1, 0]\ninner_cone_degrees = 8\nouter_cone_degrees = 10\n"
        "intensity = 100\n";
    const scene::Scene scene =
        makeScene(kLeft, spot + kFloor + ball("a", {-2, 1, 0}) + ball("b", {2, 1, 0}));
    const Rendered lit = renderWith(scene, "light");
    EXPECT_EQ(lit.generators, 1u);
    ASSERT_EQ(lit.leftOut.size(), 1u);
    EXPECT_NE(lit.leftOut[0].find("'b'no light reaches it directly"), std::string::npos);
    EXPECT_EQ(renderWith(scene, "none").generators, 2u);
}

}  // namespace
}  // namespace kaustik::test
