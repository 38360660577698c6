// SPDX-License-Identifier: MIT
// Hard cases of caustic triangles: those that cross the faces of a cube, a silhouette or
// themselves.
#include "techniques/register_hard_cases.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/stage_harness.h"

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
                          static_cast<double>(pixels), kTooFewReason);
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
        double maximum = 0.0;
        const glm::dvec3 up = glm::dmat3(frame.view().worldToView) * glm::dvec3(0, 1, 0);
        for (int y = 0; y < 96; ++y) {
            for (int x = 0; x < 96; ++x) {
                if (glm::dot(surface.rgb(x, y), up) > 0.5 || surface.at(x, y, 3) == 0.0f) continue;
                maximum = std::max(maximum, irradiance.rgb(x, y).g);
            }
        }
        lab.expect(subject, "most light on the block's sides, W/m²", 0.0, maximum, kExactly);
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

}  // namespace

void addTrianglesCases(Suite& suite) {
    suite.add(
        "D33",
        "A caustic triangle is whole across a cube's faces, left out across a silhouette, and "
        "there as often as light is.",
        acrossFaces);
    suite.add("D33", "", acrossASilhouette);
    suite.add("D33", "", foldedOver);
}

}  // namespace kaustik
