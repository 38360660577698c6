// SPDX-License-Identifier: MIT
// reconstruct.sprites (K06, section 3.1 and Fig. 6): what one photon's splat of a known radius
// covers of a plane at a known slant, and with which irradiance, in closed form: a disc in the
// plane, what a circle on the screen covers of it, and what a round beam cuts out of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/stage_harness.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using glm::dvec2;
using glm::dvec3;
using std::numbers::pi;

constexpr double kWatts = 2.0;  // of the photon
constexpr double kRadius = 0.3;
constexpr double kDepth = 2.0;
constexpr StageSize kSize{160, 160};
// What a pixel is wide at a depth of 1 m, of 30 degrees.
const double kFootprint = 2.0 * std::tan(glm::radians(15.0)) / kSize.width;

// A wall that is turned by so much that its right side is nearer to the eye; the view's axis goes
// through its middle.
struct Wall {
    double slantDegrees = 0.0;
    [[nodiscard]] double slant() const { return glm::radians(slantDegrees); }
    [[nodiscard]] dvec3 normal() const { return {-std::sin(slant()), 0.0, std::cos(slant())}; }
    [[nodiscard]] dvec3 across() const { return {std::cos(slant()), 0.0, std::sin(slant())}; }
    [[nodiscard]] scene::Scene scene(const std::string& parts = "") const {
        return makeScene({{}, {0.0, 0.0, -1.0}, 30.0, 0.01},
                         sun({0.0, 0.0, -1.0}) +
                             object("wall", "plane", "white", {0, 0, -kDepth},
                                    fmt::format("size = [20, 20]\nrotation_degrees = [90, {}, 0]",
                                                number(-slantDegrees))) +
                             parts);
    }
    // Where the ray through a point of the picture at a depth of 1 m meets it.
    [[nodiscard]] dvec3 seenAlong(const dvec2& tangents) const {
        const dvec3 ray(tangents, -1.0);
        return ray * (glm::dot(normal(), dvec3(0, 0, -kDepth)) / glm::dot(normal(), ray));
    }
};

// Where a photon is seen: on the axis, but for a part of a pixel.
const dvec2 kOnAxis(0.3 * kFootprint, -0.2 * kFootprint);

// A point's distance from the photon in radii, by the shape's own measure.
using Measure = std::function<double(const dvec3& point, const dvec3& center)>;

double ofDisc(const dvec3& point, const dvec3& center) {
    return glm::distance(point, center) / kRadius;
}
// At the photon's depth, whatever the wall does.
double onScreen(const dvec3& point, const dvec3& center) {
    return glm::distance(point * (center.z / point.z), center) / kRadius;
}
Measure fromPath(const dvec3& direction) {
    return [direction](const dvec3& point, const dvec3& center) {
        return glm::length(glm::cross(point - center, direction)) / kRadius;
    };
}

double kernel(const std::string& name, double share) {
    if (share >= 1.0) return 0.0;
    if (name == "linear") return 1.0 - share;
    if (name == "epanechnikov") return 1.0 - share * share;
    return std::exp(-4.5 * share * share);
}

struct Shape {
    std::string name;
    Measure measure;
    double areaSquareMeters = 0.0;  // of the wall, in closed form
};

struct Splat {
    double watts = 0.0;
    double areaSquareMeters = 0.0;  // of the wall, of pixels that it lights
    double worst = 0.0;             // largest error of the irradiance, of that in the middle
    int pixels = 0;
};

class Sprites : public testing::TestWithParam<double> {
  protected:
    // The integral of the kernel over the wall, by an even grid in the wall's plane; `isCounted`:
    // over the points that it is true of.
    static double integral(
        const Wall& wall, const Shape& shape, const std::string& kernelName, const dvec3& center,
        const std::function<bool(const dvec3&)>& isCounted = [](const dvec3&) { return true; }) {
        constexpr int kAlong = 4000;  // 0.6 mm, across the edges that some are counted to
        constexpr int kUp = 160;
        constexpr double kAlongReach = 4.0 * kRadius;
        constexpr double kUpReach = 1.2 * kRadius;
        double sum = 0.0;
        for (int i = 0; i < kAlong * kUp; ++i) {
            const double along = kAlongReach * (2.0 * (i % kAlong + 0.5) / kAlong - 1.0);
            const double up = kUpReach * (2.0 * (i / kAlong + 0.5) / kUp - 1.0);
            const dvec3 point = center + along * wall.across() + dvec3(0.0, up, 0.0);
            if (point.z > -0.01 || !isCounted(point)) continue;
            sum += kernel(kernelName, shape.measure(point, center));
        }
        return sum * (2.0 * kAlongReach / kAlong) * (2.0 * kUpReach / kUp);
    }

    static StagePhoton photonOn(const Wall& wall, const dvec2& tangents, const dvec3& direction) {
        StagePhoton photon;
        photon.position = wall.seenAlong(tangents);
        photon.direction = direction;
        photon.fluxWatts = dvec3(kWatts);
        photon.startNormal = wall.normal();
        photon.startMaterial = kWhite;
        return photon;
    }
    numerics::Frame reconstruct(const scene::Scene& scene, const StagePhoton& photon,
                                const std::string& shape, const std::string& kernelName) {
        return reconstructHits(lab_, lab_.choose(ReconstructStage::name, "sprites"), scene,
                               {photon},
                               {{"reconstruct.sprites.shape", shape},
                                {"reconstruct.sprites.kernel", kernelName},
                                {"reconstruct.sprites.radius", number(kRadius)},
                                {"reconstruct.sprites.maximum", "100"},
                                {"reconstruct.sprites.reach", "127"}},
                               kSize);
    }

    Splat splat(const Wall& wall, const Shape& shape, const std::string& kernelName,
                const dvec3& direction) {
        const StagePhoton photon = photonOn(wall, kOnAxis, direction);
        const numerics::Frame frame = reconstruct(wall.scene(), photon, shape.name, kernelName);
        const Texels irradiance = frame.causticIrradiance();
        const Texels receiver = frame.read("eye.receiver");
        const double whole = integral(wall, shape, kernelName, photon.position);
        Splat result;
        for (int y = 0; y < kSize.height; ++y) {
            for (int x = 0; x < kSize.width; ++x) {
                const dvec2 tangents = kFootprint * (dvec2(x, y) + 0.5 - 0.5 * kSize.width);
                const double share = shape.measure(wall.seenAlong(tangents), photon.position);
                const double expected = kWatts * kernel(kernelName, share) / whole;
                const double found = irradiance.at(x, y, 1);
                const double area = receiver.at(x, y, 1);
                result.watts += found * area;
                result.areaSquareMeters += found > 0.0 ? area : 0.0;
                result.pixels += found > 0.0 ? 1 : 0;
                result.worst = std::max(result.worst, std::abs(found - expected) * whole / kWatts);
            }
        }
        return result;
    }

    // That a splat lights what it is to light, and as it is to.
    void expectSplat(const Shape& shape, const dvec3& direction) {
        const Wall wall{GetParam()};
        // A border of 20 to 40 pixels' diameter goes through one pixel in 20 of all that it
        // encloses; which are lit is decided by their middles.
        for (const char* kernelName : {"linear", "epanechnikov", "gaussian"}) {
            SCOPED_TRACE(fmt::format("{} {}", shape.name, kernelName));
            const Splat found = splat(wall, shape, kernelName, direction);
            EXPECT_GT(found.pixels, 300);
            // The sum of 32-bit values of up to 4,000 pixels.
            EXPECT_NEAR(found.watts, kWatts, 1e-4 * kWatts);
            EXPECT_NEAR(found.areaSquareMeters / shape.areaSquareMeters, 1.0, 0.02);
            // What is deposited is divided by the sum over pixels instead of the integral. That a
            // linear kernel's tip, and a cut-off Gaussian's border of 1 %, lie between middles of
            // pixels, of 10 in a radius where the slant is 60 degrees, is what the sum is off by.
            EXPECT_LT(found.worst, 0.01);
        }
    }

  private:
    Registry registry_ = registerAll();
    Suite suite_;
    Lab lab_{context(), registry_, suite_};
};

TEST_P(Sprites, OfAnOrientedDiscCoverTheSameOfThePlaneAtEverySlant) {
    expectSplat({"disc", ofDisc, pi * kRadius * kRadius}, {0, 0, -1});
}

// The cone around a circle cuts an ellipse out of the plane, whose one axis is 1/cos of the slant
// longer, and more where perspective counts: k is what the depth changes by over a radius.
TEST_P(Sprites, AlignedWithTheScreenCoverMoreAsThePlaneTurnsAway) {
    const Wall wall{GetParam()};
    const double k = kRadius / kDepth * std::tan(wall.slant());
    const double area =
        pi * kRadius * kRadius / (std::cos(wall.slant()) * std::pow(1.0 - k * k, 1.5));
    expectSplat({"screen", onScreen, area}, {0, 0, -1});
}

// Light comes from the left at 20 degrees to the axis of the view, or straight to the wall.
TEST_P(Sprites, OfABeamCoverWhatItCutsOutOfThePlane) {
    const Wall wall{GetParam()};
    for (const dvec3& direction :
         {glm::normalize(dvec3(std::tan(glm::radians(20.0)), 0.0, -1.0)), -wall.normal()}) {
        const double cosine = std::abs(glm::dot(direction, wall.normal()));
        expectSplat({"beam", fromPath(direction), pi * kRadius * kRadius / cosine}, direction);
    }
}

// Half of a splat, or nearly: behind a sheet next to the eye whose edge is seen between two
// columns, or beyond the right border of the picture. Its light is not shared out, and is in its
// account.
TEST_P(Sprites, LoseTheShareThatTheEyeDoesNotSee) {
    const Wall wall{GetParam()};
    constexpr double kSheetDepth = 0.4;
    const std::string sheet =
        facingPlane("sheet", "grey", 4, {-2.0, 0.0, -kSheetDepth});  // left of the axis
    const double border = 0.5 * kSize.width * kFootprint;
    struct Unseen {
        std::string parts;
        dvec2 tangents;
        double from;  // tangents along x, to `to`
        double to;
        unsigned account;
    };
    const Unseen cases[]{
        {sheet, kOnAxis, -1.0, 0.0, transport::kAccountOccludedSplat},
        {"", {border - 2.3 * kFootprint, 0.0}, border, 1.0, transport::kAccountOffScreen}};
    for (const Unseen& unseen : cases) {
        for (const Shape& shape : {Shape{"disc", ofDisc}, Shape{"screen", onScreen}}) {
            SCOPED_TRACE(fmt::format("{}, account {}", shape.name, unseen.account));
            const StagePhoton photon = photonOn(wall, unseen.tangents, {0, 0, -1});
            const double lost = integral(wall, shape, "epanechnikov", photon.position,
                                         [&](const dvec3& point) {
                                             const double tangent = point.x / -point.z;
                                             return tangent > unseen.from && tangent < unseen.to;
                                         }) /
                                integral(wall, shape, "epanechnikov", photon.position);
            EXPECT_GT(lost, 0.3);
            EXPECT_LT(lost, 0.7);
            const EnergyLedger ledger =
                reconstruct(wall.scene(unseen.parts), photon, shape.name, "epanechnikov")
                    .renderer()
                    .ledger();
            // The sum over pixels in place of the integral, of 10 in a radius at 60 degrees.
            EXPECT_NEAR(ledger.watts[unseen.account] / kWatts, lost, 0.005);
            EXPECT_NEAR(ledger.watts[transport::kAccountDeposited] / kWatts, 1.0 - lost, 0.005);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(At, Sprites, testing::Values(0.0, 30.0, 60.0),
                         [](const testing::TestParamInfo<double>& tested) {
                             return std::to_string(static_cast<int>(tested.param)) + "_degrees";
                         });

}  // namespace
}  // namespace kaustik::test
