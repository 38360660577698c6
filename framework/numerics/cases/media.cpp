// SPDX-License-Identifier: MIT
// D34 and D36: the path of one photon through a homogeneous medium, against the integral of what it
// scatters towards the eye, in double. Summed over the pixels of a picture, mean radiance times the
// area of a pixel at a depth of 1 m is the integral of Φ(t) σs p(cosθ) Tr(eye) d/z³ over the path:
// d is the distance from the eye, z the depth.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "framework/numerics/cases/common_cases.h"
#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/stage_harness.h"

namespace kaustik::numerics {
namespace {

constexpr int kSide = 128;
constexpr double kTangent = 0.57735026918962576;  // of 30 degrees: the camera's half field of view
constexpr double kNear = 0.01;
constexpr double kAnisotropy = 0.4;
const glm::dvec3 kScattering(0.05, 0.2, 0.4);
const glm::dvec3 kAbsorption(0.1, 0.05, 0.0);

const std::string kSun = sun({0.0, -1.0, 0.0});
const std::string kWall = facingPlane("wall", "grey", 60, {0, 0, -10});
const std::string kMedium =
    fmt::format("[medium]\nscattering_per_meter = {}\nabsorption_per_meter = {}\nanisotropy = {}\n",
                numbers(kScattering), numbers(kAbsorption), number(kAnisotropy));
// Behind the eye, so that the medium reaches there.
const std::string kBack = facingPlane("back", "grey", 60, {0, 0, 10});

// Simpson's rule, halved until nothing changes.
double integral(const std::function<double(double)>& f, double a, double b, int depth = 0) {
    const double m = 0.5 * (a + b);
    const double whole = (b - a) / 6.0 * (f(a) + 4.0 * f(m) + f(b));
    const double left = (m - a) / 6.0 * (f(a) + 4.0 * f(0.5 * (a + m)) + f(m));
    const double right = (b - m) / 6.0 * (f(m) + 4.0 * f(0.5 * (m + b)) + f(b));
    const bool isDone = std::abs(left + right - whole) <= 1e-10 * std::abs(left + right);
    if (depth > 40 || (depth > 5 && isDone)) return left + right;
    return integral(f, a, m, depth + 1) + integral(f, m, b, depth + 1);
}

// The part [low, high] of a photon's path, m, of the eye at the origin that looks along -z.
double scattered(const StagePhoton& photon, double low, double high, int channel) {
    const double extinction = kScattering[channel] + kAbsorption[channel];
    const auto density = [&](double t) {
        const glm::dvec3 point = photon.position + t * photon.direction;
        const double distance = glm::length(point);
        const double cosine = -glm::dot(photon.direction, point) / distance;
        const double g = kAnisotropy;
        const double phase = (1.0 - g * g) / (4.0 * std::numbers::pi *
                                              std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5));
        return photon.fluxWatts[channel] * kScattering[channel] * phase *
               std::exp(-extinction * (t + distance)) * distance / (-point.z * point.z * point.z);
    };
    return high > low ? integral(density, low, high) : 0.0;
}

// The part of a path that lies beyond the near plane, within the picture and up to a depth.
struct Part {
    double low = 0.0;
    double high = 0.0;
};
Part seenPart(const StagePhoton& photon, double end, double depth, double left = -1.0,
              double right = 1.0) {
    Part part{0.0, end};
    const auto keep = [&](double a, double b) {  // where a + b t >= 0
        if (b > 0.0) part.low = std::max(part.low, -a / b);
        if (b < 0.0) part.high = std::min(part.high, -a / b);
        if (b == 0.0 && a < 0.0) part.high = part.low;
    };
    const glm::dvec3& o = photon.position;
    const glm::dvec3& d = photon.direction;
    keep(-o.z - kNear, -d.z);
    keep(o.z + depth, d.z);
    keep(o.x + o.z * kTangent * left, d.x + d.z * kTangent * left);
    keep(-o.x - o.z * kTangent * right, -d.x - d.z * kTangent * right);
    keep(o.y - o.z * kTangent, d.y - d.z * kTangent);
    keep(-o.y - o.z * kTangent, -d.y - d.z * kTangent);
    return part;
}

StagePhoton photonFrom(const glm::dvec3& from, const glm::dvec3& direction, double path) {
    StagePhoton photon;
    photon.position = from;
    photon.direction = glm::normalize(direction);
    photon.fluxWatts = {3.0, 2.0, 1.0};
    photon.pathMeters = path;
    return photon;
}

const double kPixelArea = std::pow(2.0 * kTangent / kSide, 2);

glm::dvec3 sumOf(const Texels& radiance) {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < radiance.height; ++y) {
        for (int x = 0; x < radiance.width; ++x)
            sum += radiance.rgb(x, y);
    }
    return sum * kPixelArea;
}

struct Shot {
    std::string what;
    StagePhoton photon;
    Part part;  // that the eye sees
    double tolerance = 2e-4;
    std::string reason = "a point in the middle of each pixel's part, which is 1/64 of the path";
};

void expectShots(Lab& lab, const Lab::Choice& node, const scene::Scene& scene,
                 const std::vector<Shot>& shots) {
    for (const Shot& shot : shots) {
        for (const double footprint : {1e-3, 0.1}) {
            StagePhoton photon = shot.photon;
            photon.footprintMeters = footprint;
            const Frame frame = scatterPhotons(lab, node, scene, {photon});
            const graph::ResourceRef handle = frame.renderer().outputs().inScattered.radiance;
            if (!handle.valid()) return;  // the node leaves all of it out
            const glm::dvec3 found = sumOf(frame.read(handle));
            for (const int channel : {0, 2}) {
                const double expected = scattered(photon, shot.part.low, shot.part.high, channel);
                lab.expect(node.subject,
                           fmt::format("{}, beam of {} m, {}", shot.what, footprint,
                                       channel == 0 ? "red" : "blue"),
                           expected, found[channel], {shot.tolerance * expected, shot.reason});
            }
        }
    }
}

void onePath(Lab& lab) {
    const scene::Scene room = makeScene({}, kMedium + kSun + kWall + kBack);
    const StagePhoton across = photonFrom({-2.5, 1.0, -6.0}, {5.0, -2.0, 1.0}, 5.2);
    const StagePhoton steep = photonFrom({0.4, 2.0, -5.0}, {-0.3, -4.0, -1.5}, 4.1);
    const StagePhoton endOn = photonFrom({0.0, 0.0, -9.0}, {0.0, 0.0, 1.0}, 0.0);
    const StagePhoton nearEye = photonFrom({1e-3, 5e-4, -9.0}, {0.0, 0.0, 1.0}, 0.0);
    const StagePhoton away = photonFrom({0.0, 0.0, -0.02}, {0.0, 0.0, -1.0}, 9.98);
    const StagePhoton fromBehind = photonFrom({0.05, 0.02, 1.0}, {0.01, 0.0, -1.0}, 11.0);
    const StagePhoton behind = photonFrom({1.0, 0.0, 5.0}, {0.0, 0.1, 1.0}, 3.0);
    const double forever = 1e9;
    const std::string nearEnd =
        "a point in the middle of 1/64 of the path in 1/depth: most of the light is from the "
        "nearest of them";
    const std::vector<Shot> shots = {
        {"radiance of a path across the view", across, seenPart(across, 5.2, forever)},
        {"of a steep one", steep, seenPart(steep, 4.1, forever)},
        {"of one into the eye", endOn, seenPart(endOn, 20.0, forever), 2e-3, nearEnd},
        {"of one 1 mm beside the eye", nearEye, seenPart(nearEye, 20.0, forever), 2e-3, nearEnd},
        {"of one away from the eye", away, seenPart(away, 9.98, 10.0), 2e-3, nearEnd},
        {"of one from behind the eye", fromBehind, seenPart(fromBehind, 11.0, 10.0), 2e-3, nearEnd},
        {"of one behind the eye", behind, seenPart(behind, 3.0, forever), 0.0, "nothing is drawn"},
    };
    for (const Lab::Choice& node : lab.each<MediaStage>())
        expectShots(lab, node, room, shots);
}

// The medium ends before the eye does; a path ends there too, or where a surface hides it.
void boundaries(Lab& lab) {
    const scene::Scene slab =
        makeScene({}, kMedium + kSun + kWall + facingPlane("front", "grey", 2, {25, 0, -3}));
    const StagePhoton leaves = photonFrom({0.2, 0.3, -9.0}, {0.05, 0.02, 1.0}, 0.0);
    const double path = 6.0 / leaves.direction.z;
    const scene::Scene hiding = makeScene(
        {}, kMedium + kSun + kWall + kBack + facingPlane("screen", "grey", 8, {0, 0, -5}));
    const StagePhoton hidden = photonFrom({-1.0, 0.1, -3.0}, {2.0, 0.3, -5.0}, 5.4);
    for (const Lab::Choice& node : lab.each<MediaStage>()) {
        expectShots(lab, node, slab,
                    {{"of a path out of the medium", leaves, seenPart(leaves, path, 1e9)}});
        expectShots(
            lab, node, hiding,
            {{"of a path that a screen hides the end of", hidden, seenPart(hidden, 5.4, 5.0)}});
    }
}

// Every column of pixels holds its own part of the path.
void byColumn(Lab& lab) {
    const scene::Scene room = makeScene({}, kMedium + kSun + kWall + kBack);
    StagePhoton photon = photonFrom({-3.3, 0.7, -6.0}, {6.0, -1.0, 4.0}, 6.8);
    photon.footprintMeters = 0.05;
    const Part whole = seenPart(photon, photon.pathMeters, 1e9);
    const double all = scattered(photon, whole.low, whole.high, 1);
    for (const Lab::Choice& node : lab.each<MediaStage>()) {
        const Frame frame = scatterPhotons(lab, node, room, {photon});
        const graph::ResourceRef handle = frame.renderer().outputs().inScattered.radiance;
        if (!handle.valid()) continue;
        const Texels radiance = frame.read(handle);
        double worst = 0.0;
        int lit = 0;
        for (int x = 0; x < kSide; ++x) {
            double found = 0.0;
            for (int y = 0; y < kSide; ++y)
                found += kPixelArea * radiance.rgb(x, y).g;
            const Part part = seenPart(photon, photon.pathMeters, 1e9, 2.0 * x / kSide - 1.0,
                                       2.0 * (x + 1) / kSide - 1.0);
            const double expected = scattered(photon, part.low, part.high, 1);
            lit += expected > 0.0 ? 1 : 0;
            worst = std::max(worst, std::abs(found - expected));
        }
        lab.expectDeviation(node.subject, "worst error of a column of pixels, share of a mean one",
                            worst * lit / all,
                            {1e-3, "ends of the path are pixels to 1e-5, the rest as above"});
        lab.expectAtLeast(node.subject, "columns of pixels that the path covers", 80, lit,
                          kTooFewReason);
    }
}

void noScattering(Lab& lab) {
    const scene::Scene empty = makeScene({}, kSun + kWall + kBack);
    for (const Lab::Choice& node : lab.each<MediaStage>()) {
        const Frame frame = scatterPhotons(lab, node, empty,
                                           {photonFrom({-2.5, 1.0, -6.0}, {5.0, -2.0, 1.0}, 5.2)});
        const graph::ResourceRef handle = frame.renderer().outputs().inScattered.radiance;
        if (!handle.valid()) continue;
        lab.expect(node.subject, "radiance scattered by nothing", 0.0, frame.read(handle).sum(),
                   kExactly);
    }
    // A medium of zeros is no medium: the same picture, and nothing built for it.
    const std::string parts = sun({0.1, -1.0, 0.2}) + floorPlane("floor", "grey", 4, {0, 0, 0}) +
                              floorPlane("water", "water", 2, {0, 0.5, 0});
    const CameraText above{{0.0, 2.0, 3.0}, {0.0, 0.0, 0.0}, 45.0, 0.01};
    const scene::Scene without = makeScene(above, parts);
    const scene::Scene zero = makeScene(above, "[medium]\nscattering_per_meter = 0\n" + parts);
    for (const Technique& technique : lab.registry().techniques()) {
        const FrameRequest request{96, 72, {{"emit.photons", "32x32"}}};
        const Frame expected = lab.render(technique, without, request);
        const Frame found = lab.render(technique, zero, request);
        const auto radianceOf = [](const Frame& frame) {
            return frame.read(frame.renderer().outputs().picture.radiance).values;
        };
        const std::vector<float> expectedValues = radianceOf(expected);
        const std::vector<float> foundValues = radianceOf(found);
        int different = 0;
        for (std::size_t i = 0; i < expectedValues.size(); ++i)
            different += expectedValues[i] == foundValues[i] ? 0 : 1;
        lab.expect(technique.name, "values of the picture that a medium of zeros changes", 0,
                   different, kExactly);
        lab.expect(technique.name, "textures of scattered light for a medium of zeros", 0,
                   found.renderer().outputs().inScattered.radiance.valid() ? 1 : 0, kExactly);
    }
}

void manyPathsThroughOnePixel(Lab& lab) {
    // 2^21, which is what fits, as for deposits on a receiver.
    constexpr int kPaths = 1 << 21;
    const scene::Scene room = makeScene({}, kMedium + kSun + kWall + kBack);
    const StagePhoton photon = photonFrom({-1.0, 0.2, -6.0}, {5.0, -0.5, 1.0}, 2.0);
    const double area = std::pow(2.0 * kTangent, 2);
    for (const Lab::Choice& node : lab.each<MediaStage>()) {
        const auto render = [&](int paths) {
            return scatterPhotons(lab, node, room,
                                  std::vector<StagePhoton>(static_cast<std::size_t>(paths), photon),
                                  {}, {1, 1});
        };
        const Frame one = render(1);
        const graph::ResourceRef handle = one.renderer().outputs().inScattered.radiance;
        if (!handle.valid()) continue;
        const double single = one.read(handle).rgb(0, 0).g;
        const Frame all = render(kPaths);
        const double sum = all.read(all.renderer().outputs().inScattered.radiance).rgb(0, 0).g;
        lab.expect(node.subject, "radiance of 2^21 paths through one pixel over that of one",
                   kPaths, sum / single, {1e-4 * kPaths, "1e-4, as the case asks for"});
        // A line is a pixel wide at least, and this picture is one: some of it lies next to it.
        const double expected = scattered(photon, 0.0, 2.0, 1) / area;
        lab.expect(node.subject, "radiance of one, over the whole of it", 1.0, single / expected,
                   {0.01, "what of the line lies beside the picture's one pixel"});
    }
}

}  // namespace

void addMediaCases(Suite& suite) {
    suite.add("D34", "", manyPathsThroughOnePixel);
    suite.add("D36",
              "A photon's path through a medium scatters what the integral says: across the view, "
              "end on, out of the medium; and nothing where nothing scatters.",
              onePath);
    suite.add("D36", "", boundaries);
    suite.add("D36", "", byColumn);
    suite.add("D36", "", noScattering);
}

}  // namespace kaustik::numerics
