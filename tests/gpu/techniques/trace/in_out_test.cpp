// SPDX-License-Identifier: MIT
// trace.test=in_out (K06, section 5) against where rays in double enter and leave boxes: what the
// epsilon test steps across is found to a step, and what lies between two solids, or between two
// sheets, is not inside of anything.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/stage_harness.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using namespace transport;
using glm::dvec3;

// 128 x 128 pixels of 60 degrees.
constexpr double kPixelsPerTangent = 64.0 / 0.57735026918962576;
constexpr double kEpsilon = 0.01;
// 32-bit view depths of some 10 m, and ray parameters that are interpolated between them.
constexpr double kRounding = 2e-5;

class InOutTest : public testing::TestWithParam<const char*> {
  protected:
    Traced trace(const scene::Scene& scene, const std::vector<StagePhoton>& photons,
                 const char* test = "in_out") {
        return tracePhotons(lab_, lab_.choose(TraceStage::name, GetParam()), scene, photons,
                            {{"trace.test", test}, {"trace.epsilon", number(kEpsilon)}});
    }

  private:
    Registry registry_ = registerAll();
    Suite suite_;
    Lab lab_{context(), registry_, suite_};
};

// Faces the eye, from `front` to `front` + `thickness` in depth.
std::string slab(const std::string& name, const std::string& material, double side, double front,
                 double thickness, double x = 0.0) {
    return object(name, "box", material, {x, 0, -front - 0.5 * thickness},
                  fmt::format("size = [{0}, {0}, {1}]", number(side), number(thickness)));
}
// What is next to the eye, off the screen, has rays begin where they start, and not only where the
// surfaces begin that they are to hit.
scene::Scene sceneOf(const std::string& parts) {
    return makeScene({}, sun({0.0, -1.0, 0.0}) + slab("wall", "grey", 40, 10.0, 2.0) +
                             slab("aside", "grey", 0.1, 0.1, 0.1, 3.0) + parts);
}

// They go some 0.4 m deeper with every pixel that they pass at a depth of 4.5 m. Their steps count
// from where they start to where they leave the scene: each starts at another depth, from
// `startDepth` on over `spread`, and in another place, evenly and independently (a sequence of
// three irrational steps).
std::vector<StagePhoton> steepPhotons(double startDepth = 1.0, double spread = 1.0) {
    const auto fraction = [](double x) { return x - std::floor(x); };
    std::vector<StagePhoton> photons;
    for (int i = 0; i < 1024; ++i) {
        StagePhoton photon;
        photon.direction = glm::normalize(dvec3(0.3, 0.05, -1.0));
        const dvec3 passed(0.22 * fraction(0.7548776662 * i) - 0.2,
                           0.12 * fraction(0.5698402910 * i) - 0.06, -1.5);
        const double depth = startDepth + spread * fraction(0.8191725134 * i);
        photon.position = passed + photon.direction * ((depth - 1.5) / -photon.direction.z);
        photons.push_back(photon);
    }
    return photons;
}

double distanceToDepth(const StagePhoton& photon, double depth) {
    return (-depth - photon.position.z) / photon.direction.z;
}

// How much farther a ray is a pixel on, along the axis on which it moves faster: no step is longer.
double stepMeters(const StagePhoton& photon, double from) {
    const auto pixel = [&](double t) {
        const dvec3 p = photon.position + t * photon.direction;
        return kPixelsPerTangent * glm::dvec2(p.x, p.y) / -p.z;
    };
    double low = 0.0;
    double high = 100.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        const glm::dvec2 moved = glm::abs(pixel(from + middle) - pixel(from));
        (std::max(moved.x, moved.y) < 1.0 ? low : high) = middle;
    }
    return high;
}

TEST_P(InOutTest, FindsASolidToAStepWhereTheEpsilonTestStepsAcrossIt) {
    const double thickness = 1.0;
    const scene::Scene scene = sceneOf(slab("box", "white", 4, 4.5, thickness));
    const std::vector<StagePhoton> photons = steepPhotons();
    const Traced inOut = trace(scene, photons);
    const Traced epsilon = trace(scene, photons, "epsilon");
    double expectedByEpsilon = 0.0;
    int foundByEpsilon = 0;
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const double front = distanceToDepth(photons[i], 4.5);
        const double step = stepMeters(photons[i], front);
        const StageHit& hit = inOut.hits[i];
        ASSERT_EQ(hit.fate, kFateReceiver) << i;
        ASSERT_EQ(hit.material, kWhite) << i;
        // The middle of the first step that is inside, or within epsilon of it.
        EXPECT_GT(hit.distanceMeters, front - 1.1 * kEpsilon - kRounding) << i;
        EXPECT_LT(hit.distanceMeters, front + step + kRounding) << i;
        // Nothing but its front can be hit from in front of it.
        EXPECT_GT(hit.normal.z, 0.999) << i;
        // Of a step the epsilon test sees 2 epsilon of depth, at the front and at the back.
        const double cosine = -photons[i].direction.z;
        const double back = distanceToDepth(photons[i], 4.5 + thickness);
        expectedByEpsilon += 2.0 * kEpsilon / (step * cosine) +
                             2.0 * kEpsilon / (stepMeters(photons[i], back) * cosine);
        foundByEpsilon += epsilon.hits[i].isHit() && epsilon.hits[i].material == kWhite ? 1 : 0;
    }
    // Of 1024, whose steps end anywhere: four standard deviations of a count.
    EXPECT_GT(expectedByEpsilon, 50.0);
    EXPECT_LT(expectedByEpsilon, 150.0);
    EXPECT_NEAR(foundByEpsilon, expectedByEpsilon, 4.0 * std::sqrt(expectedByEpsilon));
}

// Hardly thicker than a step is long: of many rays the first step's middle that is inside lies
// beyond the middle of the solid, and it is its front all the same that they have come in by.
TEST_P(InOutTest, HitsTheFrontOfAThinSolidWhereverInItAStepEnds) {
    constexpr double kThickness = 0.5;
    const std::vector<StagePhoton> photons = steepPhotons();
    for (const char* material : {"white", "glass"}) {
        SCOPED_TRACE(material);
        const Traced traced = trace(sceneOf(slab("plate", material, 4, 4.5, kThickness)), photons);
        int behindTheMiddle = 0;
        for (std::size_t i = 0; i < photons.size(); ++i) {
            const double front = distanceToDepth(photons[i], 4.5);
            const double back = distanceToDepth(photons[i], 4.5 + kThickness);
            const double step = stepMeters(photons[i], front);
            ASSERT_LT(step, back - front);
            const StageHit& hit = traced.hits[i];
            ASSERT_EQ(hit.material, material == std::string("white") ? kWhite : kGlass) << i;
            EXPECT_GT(hit.distanceMeters, front - 1.1 * kEpsilon - kRounding) << i;
            EXPECT_LT(hit.distanceMeters, front + step + kRounding) << i;
            EXPECT_GT(hit.normal.z, 0.999) << i;
            behindTheMiddle += hit.distanceMeters > 0.5 * (front + back) ? 1 : 0;
        }
        EXPECT_GT(behindTheMiddle, 200);
    }
}

TEST_P(InOutTest, LeavesASolidThatARayIsInsideOfAtItsBack) {
    const scene::Scene scene = sceneOf(slab("box", "glass", 4, 4.5, 1.5));
    std::vector<StagePhoton> photons = steepPhotons(4.6, 0.2);
    for (StagePhoton& photon : photons) {
        photon.media = {kGlass};
        photon.startNormal = {0, 0, 1};
        photon.startMaterial = kGlass;
    }
    const Traced traced = trace(scene, photons);
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const double back = distanceToDepth(photons[i], 6.0);
        const StageHit& hit = traced.hits[i];
        ASSERT_EQ(hit.fate, kFateSpecular) << i;
        ASSERT_EQ(hit.material, kGlass) << i;
        EXPECT_LT(hit.normal.z, -0.999) << i;
        EXPECT_GT(hit.distanceMeters, back - 1.1 * kEpsilon - kRounding) << i;
        // It is out at the first step that begins more than a pixel, 5 cm, beyond the back.
        EXPECT_LT(hit.distanceMeters, back + 0.1 + stepMeters(photons[i], back)) << i;
    }
}

// Across a ball: beyond its middle both the front and the back of every pixel face the way the ray
// goes, and it is in front of neither until it leaves.
TEST_P(InOutTest, LeavesABallWhereARayComesOutOfIt) {
    const dvec3 center(0.0, 0.0, -5.0);
    const scene::Scene scene =
        sceneOf(object("ball", "sphere", "glass", center, "radius = 1\nsegments = 256"));
    std::vector<StagePhoton> photons;
    for (int i = 0; i < 144; ++i) {
        StagePhoton photon;
        photon.position = {-0.5, 0.08 * (i / 12) - 0.43, -5.2 + 0.03 * (i % 12)};
        photon.direction = glm::normalize(dvec3(1.0, 0.02, 0.06 - 0.01 * (i % 12)));
        photon.media = {kGlass};
        photon.startNormal = {-1, 0, 0};
        photon.startMaterial = kGlass;
        photons.push_back(photon);
    }
    const Traced traced = trace(scene, photons);
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const dvec3 from = photons[i].position - center;
        const double along = glm::dot(from, photons[i].direction);
        const double exact = -along + std::sqrt(1.0 - glm::dot(from, from) + along * along);
        const StageHit& hit = traced.hits[i];
        ASSERT_EQ(hit.material, kGlass) << i;
        // It is out at the first step that is not between front and back, and that is known to a
        // pixel on both sides.
        EXPECT_NEAR(hit.distanceMeters, exact, 2.0 * stepMeters(photons[i], exact)) << i;
    }
}

// Past one box, through the gap behind it, and past another one: away from the eye and towards it.
std::vector<StagePhoton> photonsInTheGap() {
    std::vector<StagePhoton> photons;
    for (int i = 0; i < 512; ++i) {
        const bool away = i % 2 == 0;
        StagePhoton photon;
        photon.position = {-3.5, 0.025 * (i / 16) - 0.4, (away ? -5.2 : -6.3) - 0.01 * (i % 16)};
        photon.direction = glm::normalize(dvec3(1.0, 0.03, away ? -0.12 : 0.12));
        photons.push_back(photon);
    }
    return photons;
}

// They hit a block of which they see the side, at x = 3 m, between 5 and 8 m deep.
void expectTheBlock(const Traced& traced, const std::vector<StagePhoton>& photons) {
    int hits = 0;
    int right = 0;
    double worst = 0.0;
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const StageHit& hit = traced.hits[i];
        hits += hit.isHit() ? 1 : 0;
        if (!hit.isHit() || hit.material != kGrey) continue;
        ++right;
        const double exact = (3.0 - photons[i].position.x) / photons[i].direction.x;
        worst =
            std::max(worst, std::abs(hit.distanceMeters - exact) / stepMeters(photons[i], exact));
    }
    EXPECT_EQ(hits, static_cast<int>(photons.size()));
    EXPECT_EQ(right, static_cast<int>(photons.size()));
    // The silhouette of the block is known to the pixel under the middle of a step.
    EXPECT_LT(worst, 1.5);
}

const std::string kBlock = object("block", "box", "grey", {4.0, 0, -6.5}, "size = [2, 4, 3]");

TEST_P(InOutTest, TakesTheGapBetweenTwoSolidsForOpen) {
    const scene::Scene scene =
        sceneOf(slab("near", "white", 2, 4.0, 1.0) + slab("far", "white", 2.4, 6.5, 1.0) + kBlock);
    const std::vector<StagePhoton> photons = photonsInTheGap();
    expectTheBlock(trace(scene, photons), photons);
}

// One shows its front and the other its back, as the faces of a solid would.
TEST_P(InOutTest, TakesTheGapBetweenTwoSheetsForOpen) {
    const scene::Scene scene = sceneOf(facingPlane("near", "white", 2, {0, 0, -4.5}) +
                                       object("far", "plane", "white", {0, 0, -7},
                                              "size = [2.4, 2.4]\nrotation_degrees = [-90, 0, 0]") +
                                       kBlock);
    const std::vector<StagePhoton> photons = photonsInTheGap();
    expectTheBlock(trace(scene, photons), photons);
}

INSTANTIATE_TEST_SUITE_P(By, InOutTest, testing::Values("lines", "march", "hierarchical_compute"),
                         [](const testing::TestParamInfo<const char*>& tested) {
                             return std::string(tested.param);
                         });

}  // namespace
}  // namespace kaustik::test
