// SPDX-License-Identifier: MIT
// D31, D32, D34 and D34a for every node that answers `reconstruct` or `emit`: hits made up one by
// one, and what becomes of their flux.
#include <algorithm>
#include <cmath>

#include "framework/numerics/cases/common_cases.h"
#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/kernel_weights.h"
#include "framework/numerics/stage_harness.h"

namespace kaustik::numerics {
namespace {

// Those that store all of a photon's flux in a map's own texels. A multi-resolution map has some of
// it in coarser ones, which see no edges (tests/gpu/techniques/hierarchical_caustic_map_test.cpp).
std::vector<Lab::Choice> inOneMap(const Lab& lab) {
    std::vector<Lab::Choice> choices = lab.each<ReconstructStage>();
    std::erase_if(choices, [](const Lab::Choice& choice) {
        return choice.subject == "reconstruct.multi_level";
    });
    return choices;
}

using namespace transport;

const Tolerance kWeights{1e-6, "1e-6 of the flux, as the case asks for"};

// The camera: 128 x 128 pixels of 60 degrees at the origin.
constexpr int kSide = 128;
constexpr int kEverywhere = 1 << 20;
constexpr double kTangent = 0.57735026918962576;

glm::dvec3 at(double pixelX, double pixelY, double depth) {
    return {(2.0 * pixelX / kSide - 1.0) * kTangent * depth,
            (2.0 * pixelY / kSide - 1.0) * kTangent * depth, -depth};
}

StagePhoton landing(const glm::dvec3& position, const glm::dvec3& normal,
                    const glm::dvec3& direction, double footprint) {
    StagePhoton photon;
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

// Of one of three equal channels.
double account(const Frame& frame, unsigned which) {
    return frame.renderer().ledger().watts[which];
}

// W of a channel that are stored on these pixels: as irradiance says, or, where a filter makes one
// map of several and keeps no sum, as the first of them does.
double arrived(const Frame& frame, int x0, int y0, int x1, int y1) {
    if (frame.renderer().outputs().map.maps.front().sets.layout != SetLayout::one)
        return readStored(frame).in(x0, y0, x1, y1);
    const Texels irradiance = frame.read(frame.renderer().outputs().caustic.irradiance);
    const Texels receiver = frame.read(frame.renderer().outputs().eye.receiver);
    return deposited(irradiance, receiver, x0, y0, x1, y1);
}
double arrivedEverywhere(const Frame& frame) {
    return arrived(frame, 0, 0, kEverywhere, kEverywhere);
}

const std::string kSun = sun({0.0, -1.0, 0.0});
// One whose map looks as the eye does.
const std::string kSunAlongTheView = sun({0.0, 0.0, -1.0});

// Where light is stored, whatever the technique that a node comes from chooses.
const Settings kOnTheScreen = {{"reconstruct.space", "screen"}, {"gather", "screen"}};
Settings inTheLightsMap(int texels, const char* covers = "seen") {
    return {{"reconstruct.space", "light"},
            {"gather", "project"},
            {"reconstruct.map_size", std::to_string(texels)},
            {"reconstruct.map_covers", covers}};
}

void kernelAtEverySubPixelOffset(Lab& lab) {
    const scene::Scene scene = makeScene({}, kSun + facingPlane("wall", "grey", 60, {0, 0, -10}));
    const double pixel = 2.0 * kTangent * 10.0 / kSide;
    for (const Lab::Choice& node : inOneMap(lab)) {
        expectKernelWeights(lab, node, kOnTheScreen, "");
        std::vector<StagePhoton> border;
        for (int i = 0; i < 60; ++i)
            border.push_back(
                landing(at(0.05 * i, 4.0 + 2.0 * i, 10.0), {0, 0, 1}, {0, 0, -1}, pixel));
        const Frame frame = reconstructHits(lab, node, scene, border, kOnTheScreen);
        const double on = arrivedEverywhere(frame);
        const double off = account(frame, kAccountOffScreen);
        lab.expect(node.subject, "flux on the picture and clipped by its border, W", 60.0, on + off,
                   {60e-6, "1e-6 of the flux, as the case asks for"});
        lab.expectAtLeast(node.subject, "of it, clipped and counted off screen, W", 0.5, off,
                          "else the border would not be tried");
        lab.expectAtLeast(node.subject, "of it, on the picture, W", 30.0, on,
                          "the photons lie on the picture, and so does half of each at least");
    }
}

// As expectKernelWeights, of a map: texels of a sun that looks as the eye does, 12 of them from
// photon to photon and a tenth more.
void kernelAtEverySubTexelOffset(Lab& lab) {
    const double texel = 0.1;
    // The map covers a wall of 12.8 m.
    const scene::Scene scene =
        makeScene({}, kSunAlongTheView + facingPlane("wall", "grey", kSide * texel, {0, 0, -20}));
    for (const Lab::Choice& node : inOneMap(lab)) {
        for (const double width : {0.02, 0.3, 1.3}) {
            std::vector<StagePhoton> photons;
            for (int i = 0; i < 100; ++i) {
                photons.push_back(landing({12.1 * texel * (i % 10 - 4.5) + 0.03 * texel,
                                           12.1 * texel * (i / 10 - 4.5) + 0.03 * texel, -20.0},
                                          {0, 0, 1}, {0.2, 0.1, -1}, width * texel));
            }
            const Frame frame =
                reconstructHits(lab, node, scene, photons, inTheLightsMap(kSide, "scene"));
            const StoredFlux stored = readStored(frame);
            double worst = 0.0;
            for (const StagePhoton& photon : photons) {
                const int x = static_cast<int>(std::floor(photon.position.x / texel)) + kSide / 2;
                const int y = static_cast<int>(std::floor(photon.position.y / texel)) + kSide / 2;
                worst = std::max(worst, std::abs(stored.in(x - 5, y - 5, x + 6, y + 6) - 1.0));
            }
            lab.expectDeviation(
                node.subject,
                fmt::format("worst sum of weights, less 1, of beams {} texels of a map wide",
                            width),
                worst, kWeights);
        }
    }
}

void grazingEdgeAndOccluder(Lab& lab) {
    // A floor seen at 2 degrees.
    CameraText low;
    low.position = {0.0, 0.35, 10.0};
    low.target = {0.0, 0.0, 0.0};
    const scene::Scene floor = makeScene(low, kSun + floorPlane("floor", "grey", 200, {0, 0, 0}));
    std::vector<StagePhoton> grazing;
    for (int i = 0; i < 100; ++i) {
        grazing.push_back(landing({0.2 * (i % 10) - 0.9, 0.0, 0.3 * (i / 10) - 1.5}, {0, 1, 0},
                                  {0.3, -1.0, 0.2}, 0.02));
    }
    // A shelf whose edge lies in the middle of the picture, 5 m in front of the wall.
    const scene::Scene shelf = makeScene({}, kSun + facingPlane("wall", "grey", 60, {0, 0, -10}) +
                                                 facingPlane("shelf", "grey", 10, {-5.0, 0, -5}));
    const double pixel = 2.0 * kTangent * 5.0 / kSide;
    std::vector<StagePhoton> onTheEdge;
    std::vector<StagePhoton> behindTheEdge;
    for (int i = 0; i < 60; ++i) {
        onTheEdge.push_back(landing(at(63.5, 4.0 + 2.0 * i, 5.0), {0, 0, 1}, {0, 0, -1}, pixel));
        behindTheEdge.push_back(
            landing(at(64.5, 4.0 + 2.0 * i, 10.0), {0, 0, 1}, {0, 0, -1}, 3.2 * pixel));
    }
    for (const Lab::Choice& node : inOneMap(lab)) {
        lab.expect(node.subject, "flux on a floor seen at 2 degrees, W", 100.0,
                   arrivedEverywhere(reconstructHits(lab, node, floor, grazing, kOnTheScreen)),
                   {100e-6, "1e-6 of the flux, as for every kernel"});

        const Frame edge = reconstructHits(lab, node, shelf, onTheEdge, kOnTheScreen);
        lab.expect(node.subject, "flux kept on a shelf by splats that hang off its edge, W", 60.0,
                   arrived(edge, 0, 0, 64, kSide),
                   {60e-6, "1e-6 of the flux: what hangs off is redistributed on the shelf"});
        lab.expectDeviation(node.subject, "flux that leaks to the wall beyond, W",
                            arrived(edge, 64, 0, kSide, kSide), kExactly);

        const Frame hidden = reconstructHits(lab, node, shelf, behindTheEdge, kOnTheScreen);
        const double wall = arrived(hidden, 64, 0, kSide, kSide);
        const double occluded = account(hidden, kAccountOccludedSplat);
        lab.expect(node.subject, "flux on the wall and counted as hidden by the shelf, W", 60.0,
                   wall + occluded, {60e-6, "1e-6 of the flux"});
        lab.expectAtLeast(node.subject, "of it, counted as hidden, W", 5.0, occluded,
                          "of the narrowest, three texels wide, a tenth lies behind the shelf");
        lab.expectAtLeast(node.subject, "of it, on the wall, W", 20.0, wall,
                          "the photons lie on the wall, and so does much of each");
        lab.expectDeviation(node.subject, "flux that leaks to the shelf in front of it, W",
                            arrived(hidden, 0, 0, 64, kSide), kExactly);
    }
}

// The same where light is stored in the map of a light: the eye sees the floor well, the sun sees
// it at 2 degrees; map and picture end at the same places.
void borderOfAMap(Lab& lab) {
    const scene::Scene scene =
        makeScene({}, kSunAlongTheView + facingPlane("wall", "grey", 60, {0, 0, -10}));
    // Half a metre to each side of where the map ends: a fiftieth beyond what the eye sees.
    const double end = 1.04 * 10.0 * kTangent;
    std::vector<StagePhoton> border;
    for (int i = 0; i < 60; ++i) {
        border.push_back(
            landing({end - 0.5 + i / 60.0, -5.0 + i / 6.0, -10.0}, {0, 0, 1}, {0, 0, -1}, 0.1));
    }
    for (const Lab::Choice& node : inOneMap(lab)) {
        const Frame frame = reconstructHits(lab, node, scene, border, inTheLightsMap(kSide));
        const double on = readStored(frame).all();
        const double off = account(frame, kAccountOutsideMap);
        lab.expect(node.subject, "flux in a light's map and counted outside of it, W", 60.0,
                   on + off, {60e-6, "1e-6 of the flux, as the case asks for"});
        lab.expectAtLeast(node.subject, "of it, counted outside of the map, W", 15.0, off,
                          "half of the photons lie outside");
        lab.expectAtLeast(node.subject, "of it, in the map, W", 15.0, on,
                          "half of the photons lie inside");
    }
}

void grazingEdgeAndOccluderOfAMap(Lab& lab) {
    CameraText above;
    above.position = {0.0, 3.0, 0.01};
    const double low = glm::radians(2.0);
    const scene::Scene floor = makeScene(above, sun({0.0, -std::sin(low), -std::cos(low)}) +
                                                    floorPlane("floor", "grey", 200, {0, 0, 0}));
    std::vector<StagePhoton> grazing;
    for (int i = 0; i < 100; ++i) {
        grazing.push_back(landing({0.1 * (i % 10) - 0.45, 0.0, 0.1 * (i / 10) - 0.45}, {0, 1, 0},
                                  {0.3, -1.0, 0.2}, 0.02));
    }
    const scene::Scene shelf =
        makeScene({}, kSunAlongTheView + facingPlane("wall", "grey", 60, {0, 0, -10}) +
                          facingPlane("shelf", "grey", 10, {-5.0, 0, -5}));
    const double texel = 2.0 * 1.04 * 10.0 * kTangent / kSide;
    std::vector<StagePhoton> onTheEdge;
    std::vector<StagePhoton> behindTheEdge;
    for (int i = 0; i < 60; ++i) {
        const double y = 0.09 * i - 2.7;
        onTheEdge.push_back(landing({-0.5 * texel, y, -5.0}, {0, 0, 1}, {0, 0, -1}, 1.6 * texel));
        behindTheEdge.push_back(
            landing({0.5 * texel, y, -10.0}, {0, 0, 1}, {0, 0, -1}, 1.6 * texel));
    }
    const Settings settings = inTheLightsMap(kSide);
    for (const Lab::Choice& node : inOneMap(lab)) {
        lab.expect(node.subject, "flux on a floor that its light sees at 2 degrees, W", 100.0,
                   readStored(reconstructHits(lab, node, floor, grazing, settings)).all(),
                   {100e-6, "1e-6 of the flux, as for every kernel"});

        const Frame edge = reconstructHits(lab, node, shelf, onTheEdge, settings);
        lab.expect(node.subject, "flux kept on a shelf's part of a light's map, W", 60.0,
                   readStored(edge).in(0, 0, kSide / 2, kSide),
                   {60e-6, "1e-6 of the flux: what hangs off is redistributed on the shelf"});
        lab.expectDeviation(node.subject, "flux that leaks to the wall's part of the map, W",
                            readStored(edge).in(kSide / 2, 0, kSide, kSide), kExactly);

        const Frame hidden = reconstructHits(lab, node, shelf, behindTheEdge, settings);
        const double wall = readStored(hidden).in(kSide / 2, 0, kSide, kSide);
        const double counted = account(hidden, kAccountHiddenInMap);
        lab.expect(node.subject, "flux on the wall and counted as hidden from the light, W", 60.0,
                   wall + counted, {60e-6, "1e-6 of the flux"});
        lab.expectAtLeast(node.subject, "of it, counted as hidden from the light, W", 5.0, counted,
                          "else the edge would not be tried");
        lab.expectDeviation(node.subject, "flux that leaks to the shelf's part of the map, W",
                            readStored(hidden).in(0, 0, kSide / 2, kSide), kExactly);
    }
}

void manyDepositsInOnePixel(Lab& lab) {
    // 2^21, which is what fits; a plain sum of 32-bit floats is 1.7 % off there, and worse from
    // there to 2^25.
    const scene::Scene scene = makeScene({}, kSun + facingPlane("wall", "grey", 60, {0, 0, -10}));
    constexpr int kDeposits = 1 << 21;
    StagePhoton photon = landing({0, 0, -10}, {0, 0, 1}, {0, 0, -1}, 0.01);
    photon.fluxWatts = glm::dvec3(0.1);
    const std::vector<StagePhoton> photons(kDeposits, photon);
    for (const Lab::Choice& node : lab.each<ReconstructStage>()) {
        const Frame frame = reconstructHits(lab, node, scene, photons, kOnTheScreen, {1, 1});
        const double flux = 0.1 * kDeposits - account(frame, kAccountOffScreen);
        lab.expect(node.subject, "flux of 2^21 deposits of 0.1 W in one pixel, W", flux,
                   arrivedEverywhere(frame), {1e-4 * flux, "1e-4, as the case asks for"});
        const double share = flux / (0.1 * kDeposits);
        const std::string chosen = frame.renderer().settings().params.choice("reconstruct");
        const bool isWide = chosen == "fixed" || chosen == "four_radii" || chosen == "levels" ||
                            chosen == "multi_level" || chosen == "lens";
        if (isWide) {
            lab.expectAtLeast(node.subject, "share of it that is in the pixel", 0.1, share,
                              "of a Gaussian seven pixels wide, which is the widest, the middle "
                              "one holds 0.117");
        } else {
            lab.expect(node.subject, "share of it that is in the pixel", 1.0, share,
                       {0.1,
                        "a splat of one pixel's radius on a picture of "
                        "one: its rim may touch what is beside it"});
        }
    }
}

// A plate of less than a texel in the middle of one, and others that make the map as large as it
// is.
void manyDepositsInOneTexel(Lab& lab) {
    constexpr int kTexels = 16;
    const double size = 1.0 / kTexels;  // of a texel, of a map of [-0.5, 0.5]²
    // The ledger's unit is by what the light sends: no less than what is deposited.
    const std::string brightSun = sun({0.0, 0.0, -1.0}, 1e6);
    std::string plates;
    for (const double x : {-0.45, 0.45}) {
        for (const double y : {-0.45, 0.45})
            plates += facingPlane(fmt::format("{} {}", x, y), "grey", 0.1, {x, y, -10});
    }
    const glm::dvec3 middle(0.5 * size, 0.5 * size, -10.0);
    const scene::Scene scene =
        makeScene({}, brightSun + plates + facingPlane("plate", "grey", 0.8 * size, middle));
    constexpr int kDeposits = 1 << 21;
    StagePhoton photon = landing(middle, {0, 0, 1}, {0, 0, -1}, 0.001);
    photon.fluxWatts = glm::dvec3(0.1);
    const std::vector<StagePhoton> photons(kDeposits, photon);
    for (const Lab::Choice& node : lab.each<ReconstructStage>()) {
        const Frame frame =
            reconstructHits(lab, node, scene, photons, inTheLightsMap(kTexels, "scene"), {1, 1});
        const double flux = 0.1 * kDeposits;
        lab.expect(node.subject, "flux of 2^21 deposits of 0.1 W in one texel of a map, W", flux,
                   readStored(frame).in(kTexels / 2, kTexels / 2, kTexels / 2 + 1, kTexels / 2 + 1),
                   {1e-4 * flux, "1e-4, as the case asks for"});
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

// A receiver that the sun sees at 60 degrees from its normal, through a sheet that bends nothing:
// what a texel holds is spread over the receiver's area, not over the texel's.
void slantedReceiverOfAMap(Lab& lab) {
    CameraText camera;
    camera.position = {0.0, 3.0, 0.01};
    const double slant = glm::radians(60.0);
    scene::Scene scene = makeScene(camera, sun({std::sin(slant), -std::cos(slant), 0.0}) +
                                               floorPlane("floor", "grey", 8, {0, 0, 0}) +
                                               floorPlane("air", "water", 6, {0, 0.2, 0}));
    scene.materials[kWater - 1].ior = 1.0f;
    for (const Lab::Choice& node : lab.each<ReconstructStage>()) {
        FrameRequest request{48, 48, inTheLightsMap(64, "scene")};
        request.settings.emplace_back("emit.photons", "128x128");
        const Frame frame = lab.render(node, scene, request);
        const Texels irradiance = frame.read(frame.renderer().outputs().caustic.irradiance);
        double sum = 0.0;
        for (int y = 16; y < 32; ++y) {
            for (int x = 16; x < 32; ++x)
                sum += irradiance.rgb(x, y).g;
        }
        const double expected = 1000.0 * std::cos(slant);
        lab.expect(node.subject, "irradiance of a floor seen by its sun at 60 degrees, W/m²",
                   expected, sum / 256.0,
                   {0.02 * expected,
                    "one to three photons fall on a texel, and their rows beat with the map's: "
                    "over the 16 x 16 pixels looked at, some 20 x 10 texels, that leaves 1 %; "
                    "over the texel's own area it would be 100 % more"});
    }
}

}  // namespace

void expectKernelWeights(Lab& lab, const Lab::Choice& reconstruct, const Settings& settings,
                         const std::string& what) {
    const scene::Scene scene = makeScene({}, kSun + facingPlane("wall", "grey", 60, {0, 0, -10}));
    const double pixel = 2.0 * kTangent * 10.0 / kSide;
    for (const double footprint : {0.02 * pixel, 0.3 * pixel, 1.3 * pixel}) {
        // One photon in every 12 x 12 pixels.
        std::vector<StagePhoton> photons;
        for (int i = 0; i < 100; ++i) {
            const double x = 12.0 * (i % 10) + 6.0 + 0.1 * (i % 10);
            const double y = 12.0 * (i / 10) + 6.0 + 0.1 * (i / 10);
            photons.push_back(landing(at(x, y, 10.0), {0, 0, 1}, {0.2, 0.1, -1}, footprint));
        }
        const Frame frame = reconstructHits(lab, reconstruct, scene, photons, settings);
        double worst = 0.0;
        for (int i = 0; i < 100; ++i) {
            const int x = 12 * (i % 10);
            const int y = 12 * (i / 10);
            worst = std::max(worst, std::abs(arrived(frame, x, y, x + 12, y + 12) - 1.0));
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
    suite.add("D31", "", kernelAtEverySubTexelOffset);
    suite.add("D31", "", borderOfAMap);
    suite.add("D32",
              "A splat stays on its surface: at grazing angles, at an edge, behind an "
              "occluder.",
              grazingEdgeAndOccluder);
    suite.add("D32", "", grazingEdgeAndOccluderOfAMap);
    suite.add("D34", "Very many deposits in one pixel do not drift.", manyDepositsInOnePixel);
    suite.add("D34", "", manyDepositsInOneTexel);
    suite.add("D34a", "The flux of a point light's texel is by its solid angle.", pointLightGrid);
    suite.add("D34a", "", slantedReceiverOfAMap);
}

}  // namespace kaustik::numerics
