// SPDX-License-Identifier: MIT
// Hard cases of a dense driver that refines: where finer photons lie next to coarser ones, where
// light is behind something, and where it is cut by an edge.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/stage_harness.h"
#include "techniques/register_hard_cases.h"

namespace kaustik {
namespace {

using namespace numerics;
using transport::kAccountArrived;
using transport::kAccountEmitted;

constexpr double kIrradiance = 1000.0;  // of the sun
constexpr double kSheetSide = 5.0;
constexpr int kPhotons = 32;
constexpr double kCell = kSheetSide / kPhotons;
constexpr int kSize = 256;
constexpr double kPixel = 0.04;  // of the floor, about, m

// Light straight down through a sheet that bends nothing, seen from above.
scene::Scene belowASheet(const std::string& parts) {
    CameraText camera;
    camera.position = {0.0, 6.0, 1.0};
    camera.target = {0.0, 0.0, 0.0};
    scene::Scene scene =
        makeScene(camera, sun({0.0, -1.0, 0.0}) + floorPlane("floor", "grey", 8, {0, 0, 0}) +
                              floorPlane("air", "water", kSheetSide, {0, 1, 0}) + parts);
    scene.materials[kWater - 1].ior = 1.0f;
    return scene;
}

FrameRequest refined(int parts, bool isSplit) {
    FrameRequest request{kSize,
                         kSize,
                         {{"emit.photons", fmt::format("{0}x{0}", kPhotons)},
                          {"driver.dense.refine", fmt::format("{}", parts)},
                          {"emit.batch", isSplit ? "512" : "4194304"}}};
    request.saved = {"eye.receiver"};
    return request;
}

// How far a place of the floor is from the outline of a square around `middle`, m.
double fromSquare(const glm::dvec3& at, const glm::dvec3& middle, double side) {
    const double x = std::abs(at.x - middle.x) - 0.5 * side;
    const double z = std::abs(at.z - middle.z) - 0.5 * side;
    if (x <= 0.0 && z <= 0.0) return std::min(-x, -z);
    return std::hypot(std::max(x, 0.0), std::max(z, 0.0));
}

struct Light {
    double worst = 0.0;  // relative error of even light
    std::size_t pixels = 0;
};

// A block on the floor: its outline parts the light, part of it on its top, the rest on the floor
// around it.
Light lightAround(const Frame& frame, const glm::dvec3& middle, double side, double margin) {
    const Texels irradiance = frame.causticIrradiance();
    const Texels receiver = frame.read("eye.receiver");
    Light light;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const glm::dvec3 at = frame.worldAt(x, y, static_cast<double>(receiver.at(x, y, 0)));
            const bool isLevel = std::abs(at.y) < 1e-3 || std::abs(at.y - 0.3) < 1e-3;
            if (!isLevel || std::max(std::abs(at.x), std::abs(at.z)) > 2.3) continue;
            const double distance = fromSquare(at, middle, side);
            const double error = std::abs(irradiance.rgb(x, y).g / kIrradiance - 1.0);
            if (distance < margin) continue;
            ++light.pixels;
            light.worst = std::max(light.worst, error);
        }
    }
    return light;
}

void nextToCoarser(Lab& lab) {
    const Technique& technique = lab.registry().findTechnique("exact_rays");
    const glm::dvec3 middle{1.2, 0.15, 0.13};
    constexpr double kSide = 0.9;
    const scene::Scene scene = belowASheet(
        object("block", "box", "white", middle, fmt::format("size = [{0}, 0.3, {0}]", kSide)));
    for (const int parts : {1, 3, 5}) {
        for (const bool isSplit : {false, true}) {
            const Frame frame = lab.render(technique, scene, refined(parts, isSplit));
            const std::string subject =
                fmt::format("driver.dense, refine {}{}", parts, isSplit ? ", in batches" : "");
            const EnergyLedger ledger = frame.renderer().ledger();
            lab.expect(subject, "flux that enters the sheet, W",
                       kIrradiance * kSheetSide * kSheetSide, ledger.watts[kAccountEmitted],
                       {1e-6 * kIrradiance * kSheetSide * kSheetSide,
                        "finer photons tile what coarser ones leave, and sums are integers"});
            lab.expectDeviation(
                subject, "arrived by emitted, less 1",
                std::abs(ledger.watts[kAccountArrived] / ledger.watts[kAccountEmitted] - 1.0),
                {1e-6, "nothing is bent or reflected"});
            const Light light =
                lightAround(frame, middle, kSide, 1.5 * kCell / parts + 2.0 * kPixel);
            lab.expectAtLeast(subject, "pixels farther from the outline than the finest cells",
                              10000.0, static_cast<double>(light.pixels), kTooFewReason);
            lab.expectDeviation(subject, "worst relative error of even light there", light.worst,
                                {0.01,
                                 "flux is exact in every pixel that a triangle covers wholly, the "
                                 "area of which is that of its middle's ray"});
        }
    }
}

// A ball between the light and the sheet.
void behindABall(Lab& lab) {
    const Technique& technique = lab.registry().findTechnique("exact_rays");
    constexpr double kRadius = 0.45;
    const scene::Scene scene = belowASheet(
        object("ball", "sphere", "white", {0.31, 2.0, -0.42}, fmt::format("radius = {}", kRadius)));
    constexpr double kPi = 3.14159265358979;
    const double lit = kIrradiance * (kSheetSide * kSheetSide - kPi * kRadius * kRadius);
    double coarse = 0.0;
    for (const int parts : {1, 3, 5}) {
        const Frame frame = lab.render(technique, scene, refined(parts, false));
        const EnergyLedger ledger = frame.renderer().ledger();
        const std::string subject = fmt::format("driver.dense, refine {}", parts);
        lab.expect(subject, "flux around the ball's shadow, W", lit, ledger.watts[kAccountEmitted],
                   {0.02 * kIrradiance * kPi * kRadius * kRadius,
                    "the border is told by fifths of a cell"});
        // The shadow against what a disc covers of each pixel, by the distance of its middle.
        const Texels irradiance = frame.causticIrradiance();
        const Texels receiver = frame.read("eye.receiver");
        double error = 0.0;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                const glm::dvec3 at =
                    frame.worldAt(x, y, static_cast<double>(receiver.at(x, y, 0)));
                if (std::abs(at.y) > 1e-3) continue;
                const double beyond = std::hypot(at.x - 0.31, at.z + 0.42) - kRadius;
                if (std::abs(beyond) > 2.0 * kCell) continue;
                const double share = std::clamp(0.5 + beyond / (0.67 * kPixel), 0.0, 1.0);
                error += std::abs(irradiance.rgb(x, y).g / kIrradiance - share);
            }
        }
        if (parts == 1) {
            coarse = error;
        } else {
            lab.expect(subject, "error at the shadow's border by that without finer photons", 0.0,
                       error / coarse, {0.9, "finer cells tell the border better"});
        }
    }
}

}  // namespace

void addDenseCases(Suite& suite) {
    suite.add("D48",
              "Finer photons in a part of a light's grid keep its flux and leave even light even; "
              "edges and shadows are told by their cells.",
              nextToCoarser);
    suite.add("D48", "", behindABall);
}

}  // namespace kaustik
