// SPDX-License-Identifier: MIT
// God rays on the device (K06, section 3.2) against integrals along the eye's rays, and what else a
// medium changes: photons' flux, the picture, and which passes there are. The ray-traced reference
// is in tests/audit/god_rays_test.cpp, single photons in the hard cases (D36).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/scene/files/scene_file.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using namespace transport;

constexpr double kSun = 1000.0;
constexpr double kTransmitted = 1.0 - (0.333 / 2.333) * (0.333 / 2.333);  // at normal incidence
constexpr double kAnisotropy = 0.6;
const glm::dvec3 kScattering(0.1, 0.3, 0.2);
const glm::dvec3 kExtinction(0.4, 0.3, 0.25);

// Still water of 2 m by 2 m at y = 0 under a sun straight above, and a floor at y = -3; the eye
// looks at the beam from the side.
scene::Scene beamThroughMedium() {
    scene::Scene scene = sceneFromText(R"(
name = "beam"
background_radiance = [1, 2, 3]
[camera]
position = [0, -1, 5]
target = [0, -1.2, 0]
vertical_fov_degrees = 24
[[light]]
name = "sun"
type = "directional"
direction = [0, -1, 0]
irradiance = 1000
[[material]]
name = "grey"
type = "lambertian"
albedo = 0.5
[[material]]
name = "water"
type = "dielectric"
ior = 1.333
[[object]]
name = "floor"
shape = "plane"
material = "grey"
size = [12, 12]
position = [0, -3, 0]
[[object]]
name = "water"
shape = "plane"
material = "water"
size = [2, 2]
)");
    scene.medium = scene::Medium{glm::vec3(kScattering), glm::vec3(kExtinction - kScattering),
                                 static_cast<float>(kAnisotropy)};
    return scene;
}

double phase(double cosine) {
    return (1.0 - kAnisotropy * kAnisotropy) /
           (4.0 * std::numbers::pi *
            std::pow(1.0 + kAnisotropy * kAnisotropy - 2.0 * kAnisotropy * cosine, 1.5));
}

// What the beam |x|, |z| < 1 scatters along a unit ray from z > 1, by the midpoint rule.
double radianceAlong(const glm::dvec3& origin, const glm::dvec3& ray, int channel) {
    const double begin = (1.0 - origin.z) / ray.z;
    const double end = (-1.0 - origin.z) / ray.z;
    constexpr int kSteps = 400;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double along = begin + (end - begin) * (i + 0.5) / kSteps;
        const double depth = -(origin.y + along * ray.y);
        sum += std::exp(-kExtinction[channel] * (depth + along));
    }
    return kSun * kTransmitted * kScattering[channel] * phase(ray.y) * sum * (end - begin) / kSteps;
}

Texels inScattered(const Frame& frame) {
    return frame.read(frame.renderer().outputs().inScattered.radiance);
}
Texels picture(const Frame& frame) {
    return frame.read(frame.renderer().outputs().picture.radiance);
}

bool hasPass(const Frame& frame, const std::string& name, graph::PassState state) {
    const auto& records = frame.renderer().compiled().records;
    return std::any_of(records.begin(), records.end(), [&](const graph::PassRecord& record) {
        return record.name == name && record.state == state;
    });
}

const Settings kSharp = {{"media", "lines"}, {"blur", "none"}};
Settings sharp(const std::string& key, const std::string& value) {
    Settings settings = kSharp;
    settings.emplace_back(key, value);
    return settings;
}

TEST(GodRays, BeamThroughAMediumIsTheIntegralAlongTheEyesRay) {
    const scene::Scene scene = beamThroughMedium();
    for (const char* photons : {"128x128", "300x300"}) {
        const Frame frame(scene, 96, 72, sharp("emit.photons", photons));
        const Texels radiance = inScattered(frame);
        const glm::dvec3 eye = scene.camera.position;
        double worst = 0.0;
        int compared = 0;
        for (int y = 0; y < radiance.height; ++y) {
            for (int x = 0; x < radiance.width; ++x) {
                const glm::dvec3 ray = glm::normalize(frame.worldAt(x, y, 1.0) - eye);
                const glm::dvec3 front = eye + ray * ((1.0 - eye.z) / ray.z);
                const glm::dvec3 back = eye + ray * ((-1.0 - eye.z) / ray.z);
                // Away from the beam's sides and its ends.
                if (std::max(std::abs(front.x), std::abs(back.x)) > 0.93) continue;
                if (std::max(front.y, back.y) > -0.05 || std::min(front.y, back.y) < -2.9) continue;
                ++compared;
                for (int c = 0; c < 3; ++c) {
                    const double expected = radianceAlong(eye, ray, c);
                    worst = std::max(worst, std::abs(radiance.rgb(x, y)[c] / expected - 1.0));
                }
            }
        }
        EXPECT_GT(compared, 2000);
        RecordProperty(std::string("worst_ppm_") + photons, static_cast<int>(1e6 * worst));
        // Rows of photons, 1.6 cm apart and as seen from the side 5 times as dense as pixels, are
        // smoothed over 1.5 times that; what is left of their steps is 2 %.
        EXPECT_LT(worst, 0.02) << photons;
    }
}

TEST(GodRays, EveryWidthKeepsTheLight) {
    const scene::Scene scene = beamThroughMedium();
    const auto total = [&](const Settings& settings) {
        const Frame frame(scene, 96, 72, settings);
        return inScattered(frame).sum();
    };
    Settings few = sharp("emit.photons", "24x24");
    const double expected = total(few);
    EXPECT_GT(expected, 0.0);
    for (const char* width : {"1", "3.7", "16"}) {
        Settings settings = few;
        settings.emplace_back("media.lines.width", width);
        // The beam's sides are on the screen; its top and its foot are not, but lines are wide only
        // across.
        EXPECT_NEAR(total(settings) / expected, 1.0, 1e-4) << width;
    }
}

// Mesa's software rasteriser silently ends a thread's loops after 65,535 turns: wide lines are
// walked in shorter parts.
TEST(GodRays, LinesAreWholeHoweverWideTheyMayBe) {
    const scene::Scene scene = beamThroughMedium();
    const auto total = [&](const std::string& footprints) {
        Settings settings = sharp("emit.photons", "8x8");
        settings.emplace_back("media.lines.width", "0");
        settings.emplace_back("media.lines.footprints", footprints);
        settings.emplace_back("media.lines.maximum", "256");
        const Frame frame(scene, 960, 720, settings);
        return inScattered(frame).sum();
    };
    const double expected = total("0.5");
    EXPECT_GT(expected, 0.0);
    for (const char* footprints : {"2", "4", "6"})
        EXPECT_NEAR(total(footprints) / expected, 1.0, 1e-3) << footprints;
}

TEST(GodRays, PhotonsLoseTheirFluxToTheMedium) {
    scene::Scene scene = beamThroughMedium();
    // All that the sun lights of the floor is on the screen.
    scene.camera.position = {0.0, -0.5, 5.0};
    scene.camera.target = {0.0, -2.5, 0.0};
    scene.camera.verticalFovDegrees = 45.0;
    Frame frame(scene, 160, 120, sharp("emit.photons", "64x64"));
    const EnergyLedger ledger = frame.renderer().ledger();
    // Three equal channels of 4 m² of water, of which 3 m of the medium leave a part.
    double arrives = 0.0;
    for (int c = 0; c < 3; ++c)
        arrives += std::exp(-3.0 * kExtinction[c]) * kTransmitted / 3.0;
    const double emitted = ledger.watts[kAccountEmitted];
    EXPECT_NEAR(ledger.watts[kAccountArrived] / emitted, arrives, 1e-5);
    EXPECT_NEAR(ledger.watts[kAccountAbsorbed] / emitted, kTransmitted - arrives, 1e-5);
    EXPECT_LT(std::abs(ledger.balance()), 1e-7);
}

TEST(GodRays, TheyComeOnTopOfWhatTheMediumLeavesOfThePicture) {
    const scene::Scene scene = beamThroughMedium();
    const Settings few = sharp("emit.photons", "64x64");
    const Frame whole(scene, 96, 72, few, {"view.radiance"});
    const Texels seen = whole.read("view.radiance");
    const Texels receiver = whole.read("eye.receiver");
    const Texels scattered = inScattered(whole);
    const Texels shown = picture(whole);
    const glm::dvec3 eye = scene.camera.position;
    int floor = 0;
    int sky = 0;
    double worst = 0.0;
    for (int y = 0; y < shown.height; ++y) {
        for (int x = 0; x < shown.width; ++x) {
            const auto depth = static_cast<double>(receiver.at(x, y, 0));
            const glm::dvec3 ray = glm::normalize(whole.worldAt(x, y, 1.0) - eye);
            double distance = 0.0;
            if (depth > 0.0) {
                ++floor;
                distance = glm::length(whole.worldAt(x, y, depth) - eye);
            } else {
                ++sky;
                // To the end of the scene: 12 m by 12 m, from y = -3 to 0.
                for (int axis = 0; axis < 3; ++axis) {
                    const double low = axis == 1 ? -3.0 : -6.0;
                    const double high = axis == 1 ? 0.0 : 6.0;
                    const double side = ray[axis] > 0.0 ? high : low;
                    const double along = (side - eye[axis]) / ray[axis];
                    distance = axis == 0 ? along : std::min(distance, along);
                }
            }
            for (int c = 0; c < 3; ++c) {
                const double expected = seen.rgb(x, y)[c] * std::exp(-kExtinction[c] * distance) +
                                        scattered.rgb(x, y)[c];
                worst = std::max(worst, std::abs(shown.rgb(x, y)[c] - expected) / expected);
            }
        }
    }
    EXPECT_GT(floor, 500);
    EXPECT_GT(sky, 500);
    // Distances of 32-bit depths and box faces.
    EXPECT_LT(worst, 1e-5);
}

TEST(GodRays, AreLeftOutWhereNothingScatters) {
    scene::Scene scene = beamThroughMedium();
    scene.medium->scatteringPerMeter = glm::vec3(0.0f);
    const Settings few = {{"emit.photons", "16x16"}};
    const Frame absorbing(scene, 32, 24, few);
    EXPECT_TRUE(hasPass(absorbing, "media.lines", graph::PassState::skipped));
    EXPECT_TRUE(hasPass(absorbing, "compose.medium", graph::PassState::ran));
    EXPECT_FALSE(absorbing.renderer().outputs().inScattered.radiance.valid());
    scene.medium.reset();
    const Frame clear(scene, 32, 24, few);
    EXPECT_TRUE(hasPass(clear, "media.lines", graph::PassState::skipped));
    EXPECT_TRUE(hasPass(clear, "compose.medium", graph::PassState::skipped));
    // Nor is there anything to blur where the settings leave it out.
    const Frame without(beamThroughMedium(), 32, 24,
                        {{"emit.photons", "16x16"}, {"media", "none"}, {"blur", "gaussian"}});
    EXPECT_TRUE(hasPass(without, "blur.gaussian", graph::PassState::skipped));
    EXPECT_FALSE(without.renderer().outputs().inScattered.radiance.valid());
    // What stands in for a light path that cannot be needs no medium's light either.
    scene = beamThroughMedium();
    scene.lights.clear();
    const Frame dark(scene, 32, 24, few);
    EXPECT_TRUE(hasPass(dark, "media.lines", graph::PassState::skipped));
    EXPECT_TRUE(hasPass(dark, "compose.medium", graph::PassState::ran));
}

TEST(GodRayBlur, KeepsTheLightAndSpreadsItByItsSigma) {
    const scene::Scene scene = beamThroughMedium();
    const Settings few = {
        {"emit.photons", "2x2"}, {"media.lines.width", "1"}, {"blur", "gaussian"}};
    const auto render = [&](const char* sigma) {
        Settings settings = few;
        settings.emplace_back("blur.gaussian.sigma", sigma);
        return Frame(scene, 96, 72, settings, {"media.in_scattered"});
    };
    for (const char* sigma : {"0.5", "3", "40"}) {
        const Frame frame = render(sigma);
        const Texels sharpMap = frame.read("media.in_scattered");
        const Texels blurred = inScattered(frame);
        EXPECT_NEAR(blurred.sum() / sharpMap.sum(), 1.0, 1e-5) << sigma;
    }
    // Across the upright lines of light, away from the borders, the variance grows by the kernel's.
    const Frame frame = render("3");
    const auto varianceOf = [](const Texels& map) {
        double weight = 0.0;
        double first = 0.0;
        double second = 0.0;
        for (int y = 0; y < map.height; ++y) {
            for (int x = 0; x < map.width; ++x) {
                const double value = map.rgb(x, y).g;
                weight += value;
                first += value * x;
                second += value * x * x;
            }
        }
        first /= weight;
        return second / weight - first * first;
    };
    double weights = 0.0;
    double variance = 0.0;
    for (int k = -9; k <= 9; ++k) {  // cut off at 3 sigma
        weights += std::exp(-k * k / 18.0);
        variance += k * k * std::exp(-k * k / 18.0);
    }
    EXPECT_NEAR(varianceOf(inScattered(frame)) - varianceOf(frame.read("media.in_scattered")),
                variance / weights, 1e-2);
}

}  // namespace
}  // namespace kaustik::test
