// SPDX-License-Identifier: MIT
// Hard cases of the secant search: without a bracket, and with a jump in it.
#include "techniques/register_hard_cases.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/stage_harness.h"

namespace kaustik {
namespace {

using namespace numerics;

// A ball in the open over a floor, next to a plate.
constexpr double kBall = 0.2;
const glm::dvec3 kMiddle{0.0, 1.0, 0.0};
const glm::dvec3 kPlate{0.9, 0.6, 0.0};
const glm::dvec3 kPlateHalf{0.4, 0.02, 0.4};

scene::Scene ballNextToPlate() {
    CameraText camera;
    camera.position = {0.0, 3.0, 5.0};
    camera.target = {0.0, 0.5, 0.0};
    return makeScene(camera, sun({0.0, -1.0, 0.0}) + floorPlane("floor", "grey", 8, {0, 0, 0}) +
                                 object("ball", "sphere", "glass", kMiddle,
                                        fmt::format("radius = {}\nsegments = 48", number(kBall))) +
                                 object("plate", "box", "white", kPlate,
                                        fmt::format("size = {}", numbers(2.0 * kPlateHalf))));
}

// Distance to the first of plate and floor, m.
std::optional<double> firstSurface(const glm::dvec3& origin, const glm::dvec3& direction) {
    std::optional<double> first;
    double low = 0.0;
    double high = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (kPlate[axis] - kPlateHalf[axis] - origin[axis]) / direction[axis];
        const double b = (kPlate[axis] + kPlateHalf[axis] - origin[axis]) / direction[axis];
        low = std::max(low, std::min(a, b));
        high = std::min(high, std::max(a, b));
    }
    if (low < high) first = low;
    const double floor = -origin.y / direction.y;
    const glm::dvec3 there = origin + floor * direction;
    const bool isOnFloor = floor > 0.0 && std::max(std::abs(there.x), std::abs(there.z)) < 4.0;
    if (isOnFloor && (!first || floor < *first)) first = floor;
    return first;
}

StagePhoton leaving(const glm::dvec3& normal, const glm::dvec3& direction) {
    StagePhoton photon;
    photon.position = kMiddle + kBall * normal;
    photon.direction = glm::normalize(direction);
    photon.startNormal = normal;
    photon.startMaterial = kGlass;
    return photon;
}

// Searches with a bracket, without one, and with a jump of distance in it: whatever they end with
// lies on a surface.
void searches(Lab& lab) {
    const Lab::Choice secant = lab.choose(TraceStage::name, "secant");
    const scene::Scene scene = ballNextToPlate();
    std::vector<StagePhoton> photons;
    constexpr int kRays = 3000;
    for (int i = 0; i < kRays; ++i) {
        // Evenly over the ball (a spiral of golden angles), each ray leant to one side.
        const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
        const auto direction = [&](double share, double turn) {
            const double y = 1.0 - 2.0 * share;
            const double r = std::sqrt(std::max(1.0 - y * y, 0.0));
            return glm::dvec3(r * std::cos(turn), y, r * std::sin(turn));
        };
        const glm::dvec3 normal = direction((i + 0.5) / kRays, golden * i);
        const glm::dvec3 lean = direction(std::fmod(0.5 + 0.7548776662 * i, 1.0),
                                          2.0 * std::numbers::pi * 0.5698402910 * i);
        photons.push_back(leaving(normal, normal + 0.9 * lean));
    }
    for (const char* refinements : {"1", "3", "8", "32"}) {
        const Traced traced =
            tracePhotons(lab, secant, scene, photons, {{"trace.secant.refinements", refinements}});
        std::size_t right = 0;
        std::size_t wrong = 0;
        std::size_t missed = 0;
        std::size_t inTheSky = 0;
        std::size_t open = 0;
        std::vector<double> off;
        for (std::size_t i = 0; i < photons.size(); ++i) {
            const auto exact = firstSurface(photons[i].position, photons[i].direction);
            const StageHit& hit = traced.hits[i];
            if (!exact) {
                ++open;
                inTheSky += hit.isHit() ? 1 : 0;
            } else if (!hit.isHit()) {
                ++missed;
            } else if (std::abs(hit.distanceMeters - *exact) < 0.02 * *exact + 0.01) {
                ++right;
                off.push_back(std::abs(hit.distanceMeters - *exact));
            } else {
                ++wrong;
            }
        }
        std::sort(off.begin(), off.end());
        const std::string subject = fmt::format("trace.secant, {} refinements", refinements);
        lab.expectAtLeast(subject, "rays that meet nothing", 500.0, static_cast<double>(open),
                          kTooFewReason);
        lab.expect(subject, "of these, hits: no bracket, or one of a jump in distance", 0.0,
                   static_cast<double>(inTheSky), kExactly);
        lab.expectAtMost(subject, "hits elsewhere, of 1000 rays", 3.0,
                         1000.0 * static_cast<double>(wrong) / kRays,
                         "beside the plate's edge a texel of 1 cm is of plate or of floor");
        if (std::string(refinements) == "8" || std::string(refinements) == "32") {
            lab.expectAtMost(subject, "rays that end in no hit where there is one, of 1000", 5.0,
                             1000.0 * static_cast<double>(missed) / kRays,
                             "the plate's sides are 4 cm high, 4 texels: a step of the search");
            lab.expectDeviation(subject, "distance that 99 % of the hits are off by, m",
                                off.empty() ? 1.0 : off[off.size() * 99 / 100],
                                {1e-4, "a hit lies on the plane of its texel's triangle"});
        }
    }
}

// The same depth at both ends of a step: a ray along a surface that it never comes nearer to.
void alongASurface(Lab& lab) {
    const Lab::Choice secant = lab.choose(TraceStage::name, "secant");
    const scene::Scene scene = ballNextToPlate();
    std::vector<StagePhoton> photons;
    for (int i = 0; i < 360; ++i) {
        const double turn = glm::radians(static_cast<double>(i) + 0.3);
        const glm::dvec3 outwards(std::cos(turn), 0.0, std::sin(turn));
        photons.push_back(leaving(outwards, outwards));
    }
    const Traced traced = tracePhotons(lab, secant, scene, photons);
    lab.expect(secant.subject, "hits of rays that run level with the floor, above the plate", 0.0,
               static_cast<double>(traced.hitCount()), kExactly);
}

}  // namespace

void addSecantCases(Suite& suite) {
    suite.add("D35", "A secant search is bounded, and ends with what the residual allows.",
              searches);
    suite.add("D35", "", alongASurface);
}

}  // namespace kaustik
