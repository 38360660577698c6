// SPDX-License-Identifier: MIT
// D31, D32, D34 and D34a for every node that answers `reconstruct` or `emit`: hits made up one by
// one, and what becomes of their flux.
#include <algorithm>
#include <cmath>

#include "framework/numerics/bench.h"
#include "framework/numerics/cases/common_cases.h"
#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/kernel_weights.h"

namespace kaustik::numerics {
namespace {

using namespace transport;

const Tolerance kWeights{1e-6, "1e-6 of the flux, as the case asks for"};

// The camera: 128 x 128 pixels of 60 degrees at the origin.
constexpr int kSide = 128;
constexpr double kTangent = 0.57735026918962576;

glm::dvec3 at(double pixelX, double pixelY, double depth) {
    return {(2.0 * pixelX / kSide - 1.0) * kTangent * depth,
            (2.0 * pixelY / kSide - 1.0) * kTangent * depth, -depth};
}

BenchPhoton landing(const glm::dvec3& position, const glm::dvec3& normal,
                    const glm::dvec3& direction, double footprint) {
    BenchPhoton photon;
    photon.position = position;
    photon.direction = glm::normalize(direction);
    photon.startNormal = normal;
    photon.startMaterial = kGrey;
    photon.footprintMeters = footprint;
    return photon;
}

// Watts of green light that the map holds on pixels of [x0, x1) x [y0, y1).
double deposited(const Texels& irradiance, const Texels& receiver, int x0, int y0, int x1, int y1) {
    double watts = 0.0;
    for (int y = std::max(y0, 0); y < std::min(y1, irradiance.height); ++y) {
        for (int x = std::max(x0, 0); x < std::min(x1, irradiance.width); ++x)
            watts += irradiance.rgb(x, y).g * static_cast<double>(receiver.at(x, y, 1));
    }
    return watts;
}

double depositedEverywhere(const Frame& frame) {
    const Texels irradiance = frame.read(frame.renderer().outputs().caustic.irradiance);
    const Texels receiver = frame.read(frame.renderer().outputs().eye.receiver);
    return deposited(irradiance, receiver, 0, 0, irradiance.width, irradiance.height);
}

// Of one of three equal channels.
double account(const Frame& frame, unsigned which) {
    return frame.renderer().ledger().watts[which];
}

const std::string kSun = sun({0.0, -1.0, 0.0});

void kernelAtEverySubPixelOffset(Lab& lab) {
    const scene::Scene scene = makeScene({}, kSun + facingPlane("wall", "grey", 60, {0, 0, -10}));
    const double pixel = 2.0 * kTangent * 10.0 / kSide;
    for (const Lab::Choice& node : lab.each<ReconstructStage>()) {
        expectKernelWeights(lab, node, {}, "");
        std::vector<BenchPhoton> border;
        for (int i = 0; i < 60; ++i)
            border.push_back(
                landing(at(0.05 * i, 4.0 + 2.0 * i, 10.0), {0, 0, 1}, {0, 0, -1}, pixel));
        const Frame frame = reconstructHits(lab, node, scene, border);
        const double on = depositedEverywhere(frame);
        const double off = account(frame, kAccountOffScreen);
        lab.expect(node.subject, "flux on the picture and clipped by its border, W", 60.0, on + off,
                   {60e-6, "1e-6 of the flux, as the case asks for"});
        lab.expectAtLeast(node.subject, "of it, clipped and counted off screen, W", 0.5, off,
                          "else the border would not be tried");
        lab.expectAtLeast(node.subject, "of it, on the picture, W", 30.0, on,
                          "the photons lie on the picture, and so does half of each at least");
    }
}

void grazingEdgeAndOccluder(Lab& lab) {
    // A floor seen at 2 degrees.
    CameraText low;
    low.position = {0.0, 0.35, 10.0};
    low.target = {0.0, 0.0, 0.0};
    const scene::Scene floor = makeScene(low, kSun + floorPlane("floor", "grey", 200, {0, 0, 0}));
    std::vector<BenchPhoton> grazing;
    for (int i = 0; i < 100; ++i) {
        grazing.push_back(landing({0.2 * (i % 10) - 0.9, 0.0, 0.3 * (i / 10) - 1.5}, {0, 1, 0},
                                  {0.3, -1.0, 0.2}, 0.02));
    }
    // A shelf whose edge lies in the middle of the picture, 5 m in front of the wall.
    const scene::Scene shelf = makeScene({}, kSun + facingPlane("wall", "grey", 60, {0, 0, -10}) +
                                                 facingPlane("shelf", "grey", 10, {-5.0, 0, -5}));
    const double pixel = 2.0 * kTangent * 5.0 / kSide;
    std::vector<BenchPhoton> onTheEdge;
    std::vector<BenchPhoton> behindTheEdge;
    for (int i = 0; i < 60; ++i) {
        onTheEdge.push_back(landing(at(63.5, 4.0 + 2.0 * i, 5.0), {0, 0, 1}, {0, 0, -1}, pixel));
        behindTheEdge.push_back(
            landing(at(64.5, 4.0 + 2.0 * i, 10.0), {0, 0, 1}, {0, 0, -1}, 3.2 * pixel));
    }
    for (const Lab::Choice& node : lab.each<ReconstructStage>()) {
        lab.expect(node.subject, "flux on a floor seen at 2 degrees, W", 100.0,
                   depositedEverywhere(reconstructHits(lab, node, floor, grazing)),
                   {100e-6, "1e-6 of the flux, as for every kernel"});

        const Frame edge = reconstructHits(lab, node, shelf, onTheEdge);
        const Texels onEdge = edge.read(edge.renderer().outputs().caustic.irradiance);
        const Texels edgeArea = edge.read(edge.renderer().outputs().eye.receiver);
        lab.expect(node.subject, "flux kept on a shelf by splats that hang off its edge, W", 60.0,
                   deposited(onEdge, edgeArea, 0, 0, 64, kSide),
                   {60e-6, "1e-6 of the flux: what hangs off is redistributed on the shelf"});
        lab.expectDeviation(node.subject, "flux that leaks to the wall beyond, W",
                            deposited(onEdge, edgeArea, 64, 0, kSide, kSide), kExactly);

        const Frame hidden = reconstructHits(lab, node, shelf, behindTheEdge);
        const Texels onWall = hidden.read(hidden.renderer().outputs().caustic.irradiance);
        const Texels wallArea = hidden.read(hidden.renderer().outputs().eye.receiver);
        const double wall = deposited(onWall, wallArea, 64, 0, kSide, kSide);
        const double occluded = account(hidden, kAccountOccludedSplat);
        lab.expect(node.subject, "flux on the wall and counted as hidden by the shelf, W", 60.0,
                   wall + occluded, {60e-6, "1e-6 of the flux"});
        lab.expectAtLeast(node.subject, "of it, counted as hidden, W", 10.0, occluded,
                          "else the edge would not be tried");
        lab.expectAtLeast(node.subject, "of it, on the wall, W", 20.0, wall,
                          "the photons lie on the wall, and so does much of each");
        lab.expectDeviation(node.subject, "flux that leaks to the shelf in front of it, W",
                            deposited(onWall, wallArea, 0, 0, 64, kSide), kExactly);
    }
}

void manyDepositsInOnePixel(Lab& lab) {
    // 2^21, which is what fits; a plain sum of 32-bit floats is 1.7 % off there, and worse from
    // there to 2^25.
    const scene::Scene scene = makeScene({}, kSun + facingPlane("wall", "grey", 60, {0, 0, -10}));
    constexpr int kDeposits = 1 << 21;
    BenchPhoton photon = landing({0, 0, -10}, {0, 0, 1}, {0, 0, -1}, 0.01);
    photon.fluxWatts = glm::dvec3(0.1);
    const std::vector<BenchPhoton> photons(kDeposits, photon);
    for (const Lab::Choice& node : lab.each<ReconstructStage>()) {
        const Frame frame = reconstructHits(lab, node, scene, photons, {}, {1, 1});
        const double flux = 0.1 * kDeposits - account(frame, kAccountOffScreen);
        lab.expect(node.subject, "flux of 2^21 deposits of 0.1 W in one pixel, W", flux,
                   depositedEverywhere(frame), {1e-4 * flux, "1e-4, as the case asks for"});
        lab.expect(node.subject, "share of it that is in the pixel", 1.0, flux / (0.1 * kDeposits),
                   {0.1,
                    "a splat of one pixel's radius on a picture of "
                    "one: its rim may touch what is beside it"});
    }
}

void pointLightGrid(Lab& lab) {
    // A square of water that a lamp sees at a half-angle of 30 degrees along its sides, all on the
    // screen.
    const double height = 2.0;
    const double half = height * kTangent;
    const double intensity = 100.0;
    CameraText camera;
    camera.position = {0.0, 6.0, 0.01};
    camera.target = {0.0, 0.0, 0.0};
    const scene::Scene scene = makeScene(
        camera, fmt::format("[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = [0, {}, 0]\n"
                            "intensity = {}\n",
                            number(height), number(intensity)) +
                    object("water", "plane", "water", {0, 0, 0},
                           fmt::format("size = [{0}, {0}]\ncells = [64, 64]", number(2.0 * half))) +
                    floorPlane("floor", "grey", 12.0, {0, -1, 0}));
    constexpr int kTexels = 32;
    for (const Lab::Choice& node : lab.each<EmitStage>()) {
        const Frame frame =
            lab.render(node, scene, {96, 96, {{"emit.photons", fmt::format("{0}x{0}", kTexels)}}});
        // A rectangle of half-angles 30 degrees: 4 asin(sin a sin b).
        const double solidAngle = 4.0 * std::asin(0.25);
        lab.expect(node.subject, "flux of a lamp through 30 degrees to each side, W",
                   intensity * solidAngle, frame.renderer().ledger().watts[kAccountEmitted],
                   {1e-3 * intensity * solidAngle,
                    "a texel's solid angle is that of its middle: 1/12 of its angle squared, "
                    "(2 tan 30° / 32)²/12 = 1e-4, several times where cos³ bends; the trapezoid "
                    "rule over 64 x 64 cells errs by as little"});
    }
}

}  // namespace

void expectKernelWeights(Lab& lab, const Lab::Choice& reconstruct, const Settings& settings,
                         const std::string& what) {
    const scene::Scene scene = makeScene({}, kSun + facingPlane("wall", "grey", 60, {0, 0, -10}));
    const double pixel = 2.0 * kTangent * 10.0 / kSide;
    for (const double footprint : {0.02 * pixel, 0.3 * pixel, 1.3 * pixel}) {
        // One photon in every 12 x 12 pixels.
        std::vector<BenchPhoton> photons;
        for (int i = 0; i < 100; ++i) {
            const double x = 12.0 * (i % 10) + 6.0 + 0.1 * (i % 10);
            const double y = 12.0 * (i / 10) + 6.0 + 0.1 * (i / 10);
            photons.push_back(landing(at(x, y, 10.0), {0, 0, 1}, {0.2, 0.1, -1}, footprint));
        }
        const Frame frame = reconstructHits(lab, reconstruct, scene, photons, settings);
        const Texels irradiance = frame.read(frame.renderer().outputs().caustic.irradiance);
        const Texels receiver = frame.read(frame.renderer().outputs().eye.receiver);
        double worst = 0.0;
        for (int i = 0; i < 100; ++i) {
            const int x = 12 * (i % 10);
            const int y = 12 * (i / 10);
            worst = std::max(worst,
                             std::abs(deposited(irradiance, receiver, x, y, x + 12, y + 12) - 1.0));
        }
        lab.expectDeviation(reconstruct.subject,
                            fmt::format("worst sum of weights, less 1, of beams {} pixels wide{}",
                                        footprint / pixel, what),
                            worst, kWeights);
    }
}

void addReconstructionCases(Suite& suite) {
    suite.add("D31",
              "A kernel keeps its flux at every offset and size; what the border clips is "
              "counted.",
              kernelAtEverySubPixelOffset);
    suite.add("D32",
              "A splat stays on its surface: at grazing angles, at an edge, behind an "
              "occluder.",
              grazingEdgeAndOccluder);
    suite.add("D34", "Very many deposits in one pixel do not drift.", manyDepositsInOnePixel);
    suite.add("D34a", "The flux of a point light's texel is by its solid angle.", pointLightGrid);
}

}  // namespace kaustik::numerics
