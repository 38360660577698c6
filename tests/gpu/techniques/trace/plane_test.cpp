// SPDX-License-Identifier: MIT
// trace.plane against where rays in double hit planes: tilted ones, the nearest of several, the
// inside of a room, on and off the screen; and what becomes of what it does not see.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>

#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/stage_harness.h"
#include "framework/scene/files/scene_file.h"
#include "framework/transport/watts.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using namespace transport;

const std::string kSun = sun({0.0, -1.0, 0.0});
constexpr double kRelative = 1e-5;  // 32-bit positions of 10 m and normals, and their products

class TracePlane : public testing::Test {
  protected:
    Traced trace(const scene::Scene& scene, const std::vector<StagePhoton>& photons) {
        return tracePhotons(lab_, lab_.choose(TraceStage::name, "plane"), scene, photons);
    }

  private:
    Registry registry_ = registerAll();
    Suite suite_;
    Lab lab_{context(), registry_, suite_};
};

StagePhoton photon(const glm::dvec3& position, const glm::dvec3& direction) {
    StagePhoton result;
    result.position = position;
    result.direction = glm::normalize(direction);
    return result;
}

// From a point into every direction, the same on every machine.
std::vector<StagePhoton> photonsFrom(const glm::dvec3& position, int count) {
    std::vector<StagePhoton> photons;
    for (int i = 0; i < count; ++i) {  // a spiral over the sphere
        const double y = 1.0 - (2.0 * i + 1.0) / count;
        const double turn = 2.399963229728653 * i;
        const double across = std::sqrt(1.0 - y * y);
        photons.push_back(photon(position, {across * std::cos(turn), y, across * std::sin(turn)}));
    }
    return photons;
}

TEST_F(TracePlane, HitsATiltedPlaneWhereTheRayMeetsIt) {
    const scene::Scene scene =
        makeScene({}, kSun + object("slope", "plane", "white", {0.3, -0.2, -8},
                                    "size = [6, 4]\nrotation_degrees = [35, 20, 10]"));
    const glm::dmat4& place = scene.objects[0].toWorld;
    const glm::dvec3 normal = glm::normalize(glm::dvec3(place * glm::dvec4(0, 1, 0, 0)));
    const glm::dvec3 middle(place[3]);
    const glm::dmat4 toPlane = glm::inverse(place);
    std::vector<StagePhoton> photons = photonsFrom({0.5, 1.0, -5.0}, 4000);
    const std::vector<StagePhoton> behind = photonsFrom({-0.4, -2.5, -10.0}, 4000);
    photons.insert(photons.end(), behind.begin(), behind.end());
    const Traced traced = trace(scene, photons);
    int hits = 0;
    int passed = 0;
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const StagePhoton& p = photons[i];
        const double t = glm::dot(middle - p.position, normal) / glm::dot(p.direction, normal);
        const glm::dvec3 on(toPlane * glm::dvec4(p.position + t * p.direction, 1.0));
        const double neighbour = std::max(std::abs(on.x) - 3.0, std::abs(on.z) - 2.0);
        if (std::abs(neighbour) < 1e-4) continue;  // which side of the edge is known to rounding
        const bool isHit = t > 0.0 && neighbour < 0.0;
        ASSERT_EQ(traced.hits[i].isHit(), isHit) << i;
        ++(isHit ? hits : passed);
        if (!isHit) continue;
        EXPECT_EQ(traced.hits[i].material, kWhite);
        EXPECT_NEAR(traced.hits[i].distanceMeters, t, kRelative * t);
        EXPECT_LT(glm::length(traced.hits[i].position - p.position - t * p.direction),
                  kRelative * (t + 10.0));
        EXPECT_LT(glm::length(traced.hits[i].normal - normal), 1e-6);
        EXPECT_EQ(traced.hits[i].fate, kFateReceiver);
    }
    EXPECT_GT(hits, 500);
    EXPECT_GT(passed, 3000);
    // All flux of 1 W each is either arrived or has hit nothing there was.
    EXPECT_NEAR(traced.ledger.watts[kAccountArrived] + traced.ledger.watts[kAccountLeftScene],
                static_cast<double>(photons.size()), 1e-5 * static_cast<double>(photons.size()));
}

TEST_F(TracePlane, HitsTheNearestOfSeveralFromEitherSide) {
    const scene::Scene scene =
        makeScene({}, kSun + facingPlane("far", "white", 40, {0, 0, -7}) +
                          facingPlane("near", "grey", 40, {0, 0, -6.998}) +
                          facingPlane("nearest, beside", "white", 1, {20, 0, -4}));
    std::vector<StagePhoton> forth;
    std::vector<StagePhoton> back;
    for (int i = 0; i < 100; ++i) {
        forth.push_back(photon({0.1 * i - 5.0, 0.3, -2.0}, {0.002 * i, 0.1, -1.0}));
        back.push_back(photon({0.1 * i - 5.0, 0.3, -9.0}, {0.002 * i, 0.1, 1.0}));
    }
    const Traced there = trace(scene, forth);
    const Traced returned = trace(scene, back);
    for (std::size_t i = 0; i < forth.size(); ++i) {
        EXPECT_EQ(there.hits[i].material, kGrey);
        EXPECT_NEAR(there.hits[i].position.z, -6.998, 1e-5);
        EXPECT_EQ(returned.hits[i].material, kWhite);
        EXPECT_NEAR(returned.hits[i].position.z, -7.0, 1e-5);
    }
}

// A room without a ceiling, 4 x 1.5 x 3 m, turned about two axes, around the eye.
struct Room {
    glm::dvec3 half{2.0, 0.75, 1.5};
    scene::Scene scene =
        makeScene({}, kSun + object("room", "box", "grey", {0.2, -0.3, -0.5},
                                    "size = [4, 1.5, 3]\ninward = true\nopen = [\"+y\"]\n"
                                    "rotation_degrees = [0, 31, 12]"));
    glm::dmat4 place = scene.objects[0].toWorld;
};

TEST_F(TracePlane, HitsTheFiveFacesOfARoomFromInside) {
    const Room room;
    const glm::dvec3 inRoom(0.7, 0.1, -0.4);
    const std::vector<StagePhoton> photons =
        photonsFrom(glm::dvec3(room.place * glm::dvec4(inRoom, 1.0)), 6000);
    const glm::dmat3 back(glm::inverse(room.place));
    const Traced traced = trace(room.scene, photons);
    std::array<int, 6> hits{};
    int left = 0;
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const glm::dvec3 direction = back * photons[i].direction;
        int axis = 0;
        glm::dvec3 ways;
        for (int a = 0; a < 3; ++a) {
            ways[a] =
                ((direction[a] > 0.0 ? room.half[a] : -room.half[a]) - inRoom[a]) / direction[a];
            if (ways[a] < ways[axis]) axis = a;
        }
        glm::dvec3 sorted = ways;
        std::sort(&sorted.x, &sorted.x + 3);
        if (sorted.y - sorted.x < 1e-4) continue;  // at an edge either face will do
        const bool isPositive = direction[axis] > 0.0;
        const bool isOpen = axis == 1 && isPositive;
        ASSERT_EQ(traced.hits[i].isHit(), !isOpen) << i;
        if (isOpen) {
            ++left;
            continue;
        }
        ++hits[static_cast<std::size_t>(2 * axis + (isPositive ? 1 : 0))];
        EXPECT_NEAR(traced.hits[i].distanceMeters, ways[axis], kRelative * 4.0);
        glm::dvec3 inward(0.0);
        inward[axis] = isPositive ? -1.0 : 1.0;
        EXPECT_LT(glm::length(back * traced.hits[i].normal - inward), 1e-6);
    }
    for (const int face : {0, 1, 2, 4, 5})
        EXPECT_GT(hits[static_cast<std::size_t>(face)], 200) << face;
    EXPECT_EQ(hits[3], 0);
    EXPECT_GT(left, 1000);
}

TEST_F(TracePlane, LetsNothingThroughWhereFacesMeet) {
    const Room room;
    const glm::dvec3 inRoom(0.7, 0.1, -0.4);
    const glm::dvec3 from(room.place * glm::dvec4(inRoom, 1.0));
    std::vector<StagePhoton> photons;
    for (int i = 0; i <= 1000; ++i) {
        const double s = 0.002 * i - 1.0;
        const glm::dvec3& h = room.half;
        for (const glm::dvec3& edge :
             {glm::dvec3(s * h.x, -h.y, h.z), glm::dvec3(s * h.x, -h.y, -h.z),
              glm::dvec3(h.x, -h.y, s * h.z), glm::dvec3(-h.x, -h.y, s * h.z),
              glm::dvec3(h.x, 0.98 * s * h.y, h.z), glm::dvec3(-h.x, 0.98 * s * h.y, -h.z)}) {
            photons.push_back(photon(from, glm::dvec3(room.place * glm::dvec4(edge, 1.0)) - from));
        }
    }
    EXPECT_EQ(trace(room.scene, photons).hitCount(), photons.size());
}

TEST_F(TracePlane, HitsWhatTheEyeDoesNotSee) {
    const scene::Scene scene = makeScene({}, kSun + floorPlane("floor", "grey", 60, {0, -1, 0}) +
                                                 facingPlane("behind", "white", 60, {0, 0, 10}));
    std::vector<StagePhoton> photons;
    for (int i = 0; i < 50; ++i) {
        photons.push_back(photon({-20.0, 0.02 * i, 3.0}, {0.1, -1.0, 0.2}));
        photons.push_back(photon({0.1, 0.02 * i, 2.0}, {0.0, 0.5, 1.0}));
    }
    const Traced traced = trace(scene, photons);
    for (std::size_t i = 0; i < photons.size(); ++i) {
        EXPECT_EQ(traced.hits[i].material, i % 2 == 0 ? kGrey : kWhite);
        const double t = i % 2 == 0 ? (-1.0 - photons[i].position.y) / photons[i].direction.y
                                    : (10.0 - 2.0) / photons[i].direction.z;
        EXPECT_NEAR(traced.hits[i].distanceMeters, t, kRelative * 25.0);
    }
}

// Water over a floor, and a ball of glass next to it.
TEST_F(TracePlane, CountsPhotonsInsideOfABodyAndNotThoseInWater) {
    const scene::Scene scene = makeScene(
        {}, kSun + floorPlane("floor", "grey", 20, {0, -2, -5}) +
                floorPlane("water", "water", 2, {0, 0, -5}) +
                object("ball", "sphere", "glass", {3, 0, -5}, "radius = 0.5\nsegments = 24"));
    std::vector<StagePhoton> photons(4, photon({0, 0, -5}, {0.1, -1, 0.1}));
    photons[1].media = {kWater};
    photons[2].media = {kGlass};
    photons[3].media = {kWater, kGlass};  // glass around the water
    for (std::size_t i = 0; i < photons.size(); ++i)
        photons[i].fluxWatts = glm::dvec3(std::exp2(static_cast<double>(i)));
    const Traced traced = trace(scene, photons);
    EXPECT_TRUE(traced.hits[0].isHit());
    EXPECT_TRUE(traced.hits[1].isHit());
    EXPECT_FALSE(traced.hits[2].isHit());
    EXPECT_FALSE(traced.hits[3].isHit());
    EXPECT_NEAR(traced.ledger.watts[kAccountMissedByTracer], 4.0 + 8.0, 1e-5);
    EXPECT_NEAR(traced.ledger.watts[kAccountArrived], 1.0 + 2.0, 1e-5);
}

TEST_F(TracePlane, IsNotMetWhereAPhotonStartsInItAndLeavesItsFront) {
    const scene::Scene scene = makeScene({}, kSun + floorPlane("floor", "grey", 6, {0, -1, -5}) +
                                                 floorPlane("ceiling", "white", 6, {0, 1, -5}));
    std::vector<StagePhoton> photons;
    for (int i = 0; i < 64; ++i) {
        const glm::dvec3 on(0.05 * i - 1.6, -1.0, -5.0 + 0.013 * i);
        photons.push_back(photon(on, {0.2, 1.0, 0.1}));   // a mirror that lies on the floor
        photons.push_back(photon(on, {0.2, -1.0, 0.1}));  // glass that stands on it
        photons.push_back(photon(on, {1.0, 0.0, 0.0}));   // along it
    }
    const Traced traced = trace(scene, photons);
    for (std::size_t i = 0; i < photons.size(); i += 3) {
        EXPECT_EQ(traced.hits[i].material, kWhite);
        EXPECT_EQ(traced.hits[i + 1].material, kGrey);
        EXPECT_LT(traced.hits[i + 1].distanceMeters, 1e-5);
        EXPECT_FALSE(traced.hits[i + 2].isHit());
    }
}

TEST_F(TracePlane, GivesADefinedResultForRaysThatAreNone) {
    const scene::Scene scene = makeScene({}, kSun + facingPlane("wall", "grey", 6, {0, 0, -5}));
    const double noNumber = std::numeric_limits<double>::quiet_NaN();
    std::vector<StagePhoton> photons(5, photon({0, 0, -1}, {0, 0, -1}));
    photons[0].position.x = noNumber;
    photons[1].direction.y = noNumber;
    photons[2].direction = glm::dvec3(0.0);
    photons[3].direction = {1.0, 0.0, 0.0};  // along the wall
    const Traced traced = trace(scene, photons);
    EXPECT_EQ(traced.hitCount(), 1u);
    EXPECT_TRUE(traced.hits[4].isHit());
    EXPECT_EQ(traced.ledger.events[kAccountNotANumber], 2u);
    EXPECT_NEAR(traced.ledger.watts[kAccountLeftScene], 2.0, 1e-5);
}

TEST_F(TracePlane, GivesEqualBitsAgain) {
    const Room room;
    const std::vector<StagePhoton> photons = photonsFrom({0.3, -0.2, -0.6}, 500);
    const Traced a = trace(room.scene, photons);
    const Traced b = trace(room.scene, photons);
    for (std::size_t i = 0; i < photons.size(); ++i) {
        EXPECT_EQ(a.hits[i].position, b.hits[i].position);
        EXPECT_EQ(a.hits[i].distanceMeters, b.hits[i].distanceMeters);
    }
}

TEST(Planar, KeepsEveryWattAndSaysWhatItDoesNotSee) {
    for (const char* name : {"flat-water", "pool"}) {
        SCOPED_TRACE(name);
        const scene::Scene scene = scene::loadScene(name);
        // What water reflects may go to where nothing is flat.
        const Frame frame(scene, 200, 150, {{"emit.photons", "64x64"}, {"specular", "interface"}},
                          {}, false, "planar");
        const EnergyLedger ledger = frame.renderer().ledger();
        const double emitted = ledger.watts[kAccountEmitted];
        EXPECT_LT(std::abs(ledger.balance()), 1e-6);
        EXPECT_EQ(ledger.watts[kAccountUnresolved], 0.0);
        std::string said;
        for (const std::string& warning : frame.renderer().warnings())
            said += warning;
        if (std::string(name) == "flat-water") {
            EXPECT_EQ(said, "");
            const double below = (1.333 - 1.0) / (1.333 + 1.0);
            EXPECT_NEAR(ledger.watts[kAccountArrived], (1.0 - below * below) * emitted,
                        1e-5 * emitted);
        } else {
            EXPECT_NE(said.find("light passes 'bunny'"), std::string::npos) << said;
            EXPECT_EQ(ledger.watts[kAccountMissedByTracer], 0.0);
        }
    }
}

// Where photons go on behind a body nothing is lost in it, and nothing of the kind is said.
TEST(Planar, SaysNothingOfLightInBodiesThatPhotonsHaveLeft) {
    const scene::Scene scene = scene::loadScene("glass-sphere");
    const Frame frame(scene, 200, 150, {{"emit.photons", "64x64"}, {"specular", "two_interfaces"}},
                      {}, false, "planar");
    const EnergyLedger ledger = frame.renderer().ledger();
    EXPECT_EQ(ledger.watts[kAccountMissedByTracer], 0.0);
    EXPECT_GT(ledger.watts[kAccountDeposited], 0.5 * ledger.watts[kAccountEmitted]);
    for (const std::string& warning : frame.renderer().warnings())
        EXPECT_EQ(warning.find("is lost"), std::string::npos) << warning;
}

// The closed form of flat_water_test.cpp, which needs no layers.
TEST(Planar, FloorIrradianceUnderStillWaterIsTheClosedForm) {
    const scene::Scene scene = scene::loadScene("flat-water");
    const Frame frame(scene, 400, 300, {}, {}, false, "planar");
    const double below = (1.333 - 1.0) / (1.333 + 1.0);
    const double expected = 1000.0 * (1.0 - below * below);
    const Texels receiver = frame.read("eye.receiver");
    const Texels irradiance = frame.causticIrradiance();
    int floorPixels = 0;
    for (int y = 0; y < receiver.height; ++y) {
        for (int x = 0; x < receiver.width; ++x) {
            const auto depth = static_cast<double>(receiver.at(x, y, 0));
            if (depth <= 0.0) continue;
            const glm::dvec3 world = frame.worldAt(x, y, depth);
            const bool isInside = std::abs(world.x) < 1.85 && std::abs(world.z) < 1.35;
            if (!isInside || std::abs(world.y + 1.2) > 1e-3) continue;
            ++floorPixels;
            // 1 %, as for the tracers of layers: what even splats of a regular grid differ by.
            EXPECT_NEAR(irradiance.rgb(x, y).g, expected, 1e-2 * expected) << x << ", " << y;
        }
    }
    EXPECT_GT(floorPixels, 20000);
}

}  // namespace
}  // namespace kaustik::test
