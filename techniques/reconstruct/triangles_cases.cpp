// SPDX-License-Identifier: MIT
// Hard cases of caustic triangles: those that cross the faces of a cube, a silhouette or
// themselves, and searches without a bracket or with a jump in it.
#include "techniques/caustic_triangles/hard_cases.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "framework/numerics/bench.h"
#include "framework/numerics/cases/scene_text.h"

namespace kaustik {
namespace {

using namespace numerics;
using transport::kAccountArrived;
using transport::kAccountDeposited;
using transport::kAccountDiscardedTriangle;

// Light straight down through a sheet that bends nothing: what is below it is lit evenly, and the
// cube around the sheet's middle has its edges on the floor.
scene::Scene underASheet(const std::string& parts, double sheetSide = 5.0) {
    CameraText camera;
    camera.position = {0.0, 6.0, 2.5};
    camera.target = {0.0, 0.0, 0.0};
    scene::Scene scene =
        makeScene(camera, sun({0.0, -1.0, 0.0}) + floorPlane("floor", "grey", 8, {0, 0, 0}) +
                              floorPlane("air", "water", sheetSide, {0, 1, 0}) + parts);
    scene.materials[kWater - 1].ior = 1.0f;
    return scene;
}

Settings onFaces(const std::string& unjoined) {
    return {{"emit.photons", "64x64"},
            {"reconstruct.map_size", "512"},
            {"reconstruct.triangles.unjoined", unjoined}};
}

// Across the edges of faces triangles are whole.
void acrossFaces(Lab& lab) {
    const Technique& technique = lab.registry().findTechnique("caustic_triangles");
    const scene::Scene scene = underASheet("");
    for (const char* shading : {"vertices", "smooth", "flat"}) {
        FrameRequest request{96, 96, onFaces("beams")};
        request.settings.emplace_back("reconstruct.triangles.shading", shading);
        request.saved = {"eye.receiver"};
        const Frame frame = lab.render(technique, scene, request);
        const Texels irradiance = frame.causticIrradiance();
        const Texels receiver = frame.read("eye.receiver");
        double worst = 0.0;
        std::size_t pixels = 0;
        for (int y = 0; y < 96; ++y) {
            for (int x = 0; x < 96; ++x) {
                const glm::dvec3 at =
                    frame.worldAt(x, y, static_cast<double>(receiver.at(x, y, 0)));
                if (std::max(std::abs(at.x), std::abs(at.z)) > 2.2) continue;
                ++pixels;
                worst = std::max(worst, std::abs(irradiance.rgb(x, y).g / 1000.0 - 1.0));
            }
        }
        const std::string subject = std::string("reconstruct.triangles, ") + shading;
        lab.expectAtLeast(subject, "pixels of a floor that five faces of a cube see", 1000.0,
                          static_cast<double>(pixels), kEnough);
        lab.expectDeviation(subject, "worst relative error of even light on it", worst,
                            {0.02,
                             "flux is exact in every texel that a triangle covers wholly; the "
                             "area that a texel sees is that of its middle's ray, 0.5 % off "
                             "in the corner of a face of 256 texels, and a pixel is the mean "
                             "of a few of them"});
        const EnergyLedger ledger = frame.renderer().ledger();
        lab.expectDeviation(
            subject, "stored by what arrived, less 1",
            std::abs(ledger.watts[kAccountDeposited] / ledger.watts[kAccountArrived] - 1.0),
            {1e-5, "shares add up to 1 but for 32 bits, and sums are integers"});
    }
}

// At the silhouette of a block there is no triangle between its top and the floor.
void acrossASilhouette(Lab& lab) {
    const Technique& technique = lab.registry().findTechnique("caustic_triangles");
    const scene::Scene scene =
        underASheet(object("block", "box", "white", {1.2, 0.15, 0.0}, "size = [0.9, 0.3, 0.9]"));
    for (const char* unjoined : {"beams", "discard"}) {
        FrameRequest request{96, 96, onFaces(unjoined)};
        request.saved = {"eye.receiver_surface"};
        const Frame frame = lab.render(technique, scene, request);
        const EnergyLedger ledger = frame.renderer().ledger();
        const double discarded = ledger.watts[kAccountDiscardedTriangle];
        const std::string subject = std::string("reconstruct.triangles, ") + unjoined;
        const bool areDiscarded = std::string(unjoined) == "discard";
        // The floor's photons have cells of 5/64 m; around the block are 4 x 0.9 m of them, half of
        // each is between two surfaces. At the sheet's own border no photon has a neighbour.
        const double cell = 5.0 / 64.0;
        const double between = 1000.0 * cell * (4.0 * 0.9 + 4.0 * 5.0 / 2.0);
        if (areDiscarded) {
            lab.expect(subject, "flux between surfaces and at the border, counted, W", between,
                       discarded,
                       {0.1 * between,
                        "corners count differently, and the block's "
                        "sides lie anywhere within a cell"});
        } else {
            lab.expect(subject, "flux of triangles that were left out, W", 0.0, discarded,
                       kExactly);
        }
        const double stored = ledger.watts[kAccountDeposited] + discarded +
                              ledger.watts[transport::kAccountHiddenInMap] +
                              ledger.watts[transport::kAccountEdgeOn];
        lab.expectDeviation(subject, "stored, hidden and left out by what arrived, less 1",
                            std::abs(stored / ledger.watts[kAccountArrived] - 1.0),
                            {1e-5, "sums are integers"});
        // Light comes straight down: nothing of it belongs on the block's sides.
        const Texels irradiance = frame.causticIrradiance();
        const Texels surface = frame.read("eye.receiver_surface");
        double most = 0.0;
        const glm::dvec3 up = glm::dmat3(frame.view().worldToView) * glm::dvec3(0, 1, 0);
        for (int y = 0; y < 96; ++y) {
            for (int x = 0; x < 96; ++x) {
                if (glm::dot(surface.rgb(x, y), up) > 0.5 || surface.at(x, y, 3) == 0.0f) continue;
                most = std::max(most, irradiance.rgb(x, y).g);
            }
        }
        lab.expect(subject, "most light on the block's sides, W/m²", 0.0, most, kExactly);
    }
}

// Where light is folded over it is there as often.
void foldedOver(Lab& lab) {
    const Technique& technique = lab.registry().findTechnique("caustic_triangles");
    CameraText camera;
    camera.position = {0.0, 6.0, 2.5};
    camera.target = {0.0, 0.0, 0.0};
    const scene::Scene scene = makeScene(
        camera,
        sun({0.0, -1.0, 0.0}) + floorPlane("floor", "grey", 8, {0, 0, 0}) +
            object("waves", "water", "water", {0, 2, 0},
                   "size = [3, 3]\ncells = [96, 96]\n"
                   "waves = [{amplitude = 0.03, wavelength = 0.6, direction_degrees = 0}]"));
    double brightest = 0.0;
    for (const char* merge : {"0", "32"}) {
        FrameRequest request{96, 96, onFaces("beams")};
        request.settings.emplace_back("reconstruct.triangles.merge", merge);
        request.saved = {"eye.receiver"};
        const Frame frame = lab.render(technique, scene, request);
        const EnergyLedger ledger = frame.renderer().ledger();
        const Texels irradiance = frame.causticIrradiance();
        const Texels receiver = frame.read("eye.receiver");
        double shown = 0.0;
        double folded = 0.0;
        for (int y = 0; y < 96; ++y) {
            for (int x = 0; x < 96; ++x) {
                shown += irradiance.rgb(x, y).g * static_cast<double>(receiver.at(x, y, 1));
                folded = std::max(folded, irradiance.rgb(x, y).g);
            }
        }
        const std::string subject = fmt::format("reconstruct.triangles, merge {}", merge);
        lab.expectAtLeast(subject, "irradiance where waves fold light over, W/m²", 2000.0, folded,
                          "twice what comes down, or the case has no fold");
        lab.expectDeviation(
            subject, "stored by what arrived, less 1",
            std::abs(ledger.watts[kAccountDeposited] / ledger.watts[kAccountArrived] - 1.0),
            {1e-5, "shares add up to 1 but for 32 bits, and sums are integers"});
        lab.expect(subject, "flux that the picture shows, of what is stored", 1.0,
                   shown / ledger.watts[kAccountDeposited],
                   {0.01, "pixels are as large as what they look up: sampled, not summed"});
        if (folded < brightest) {
            lab.expectAtLeast(subject, "brightest pixel by that without merging", 0.2,
                              folded / brightest, "cells are merged, and not lost");
        }
        brightest = std::max(brightest, folded);
    }
}

// A ball in the open over a floor, beside a plate.
constexpr double kBall = 0.2;
const glm::dvec3 kMiddle{0.0, 1.0, 0.0};
const glm::dvec3 kPlate{0.9, 0.6, 0.0};
const glm::dvec3 kPlateHalf{0.4, 0.02, 0.4};

scene::Scene ballBesideAPlate() {
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

BenchPhoton leaving(const glm::dvec3& normal, const glm::dvec3& direction) {
    BenchPhoton photon;
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
    const scene::Scene scene = ballBesideAPlate();
    std::vector<BenchPhoton> photons;
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
            const BenchHit& hit = traced.hits[i];
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
                          kEnough);
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
    const scene::Scene scene = ballBesideAPlate();
    std::vector<BenchPhoton> photons;
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

void addCausticTrianglesCases(numerics::Suite& suite) {
    suite.add(
        "D33",
        "A caustic triangle is whole across a cube's faces, left out across a silhouette, and "
        "there as often as light is.",
        acrossFaces);
    suite.add("D33", "", acrossASilhouette);
    suite.add("D33", "", foldedOver);
    suite.add("D35", "A secant search is bounded, and ends with what the residual allows.",
              searches);
    suite.add("D35", "", alongASurface);
}

}  // namespace kaustik
