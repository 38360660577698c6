// SPDX-License-Identifier: MIT
// What a glass ball in parallel light makes of it on a plane below, against the closed form: where
// a ray at the height b from the axis arrives, and with which share of its light, follows from two
// refractions in a circle. Around the axis light is focused without bound, near the rim it spreads.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

constexpr double kRadius = 0.5;
constexpr double kIndex = 1.5;
constexpr double kHeight = 0.8;  // of the middle above the plane
constexpr double kSun = 1000.0;  // W/m²
constexpr double kEye = 4.0;     // height, m
constexpr double kFieldOfView = 14.25;
constexpr int kSide = 600;

scene::Scene ballFromAbove() {
    return sceneFromText(R"(
name = "ball"
[camera]
position = [0, 4, 0]
target = [0, 0, 0]
up = [0, 0, -1]
vertical_fov_degrees = 14.25
[[light]]
name = "sun"
type = "directional"
direction = [0, -1, 0]
irradiance = 1000
[[material]]
name = "paper"
type = "lambertian"
albedo = 0.5
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[object]]
name = "paper"
shape = "plane"
material = "paper"
size = [4, 4]
[[object]]
name = "ball"
shape = "sphere"
material = "glass"
radius = 0.5
position = [0, 0.8, 0]
segments = 384
)");
}

double transmittance(double cosine, double from, double to) {
    const double sine = from / to * std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
    const double beyond = std::sqrt(std::max(1.0 - sine * sine, 0.0));
    const double s = (from * cosine - to * beyond) / (from * cosine + to * beyond);
    const double p = (to * cosine - from * beyond) / (to * cosine + from * beyond);
    return 1.0 - 0.5 * (s * s + p * p);
}

// Irradiance by the distance from the axis: mean over rings of `kRing` m.
constexpr double kRing = 5e-6;
std::vector<double> irradianceByDistance() {
    std::vector<double> rings(200000, 0.0);
    constexpr int kRays = 4000000;
    for (int i = 0; i < kRays; ++i) {
        const double b = kRadius * (i + 0.5) / kRays;
        const double incident = std::asin(b / kRadius);
        const double refracted = std::asin(b / (kIndex * kRadius));
        const double turn = incident - refracted;
        const double chord = 2.0 * kRadius * std::cos(refracted);
        const double x = b - chord * std::sin(turn);
        const double y = kHeight + kRadius * std::cos(incident) - chord * std::cos(turn);
        if (std::cos(2.0 * turn) <= 0.01) continue;
        const double at = std::abs(x - y * std::tan(2.0 * turn));
        const auto ring = static_cast<std::size_t>(at / kRing);
        if (ring >= rings.size()) continue;
        rings[ring] += kSun * 2.0 * std::numbers::pi * b * (kRadius / kRays) *
                       transmittance(std::cos(incident), 1.0, kIndex) *
                       transmittance(std::cos(refracted), kIndex, 1.0);
    }
    for (std::size_t i = 0; i < rings.size(); ++i) {
        const double inner = kRing * static_cast<double>(i);
        rings[i] /= std::numbers::pi * kRing * (2.0 * inner + kRing);
    }
    return rings;
}

// Relative mean squared error, with 1 % of the sun's irradiance to keep it finite, over
// 0.02 m < r < 0.45 m.
double relativeError(const Frame& frame, const std::vector<double>& rings) {
    const Texels irradiance = frame.causticIrradiance();
    const double pixel =
        2.0 * std::tan(0.5 * kFieldOfView * std::numbers::pi / 180.0) * kEye / kSide;
    double sum = 0.0;
    int count = 0;
    constexpr int kSamples = 16;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const double r = pixel * std::hypot(x + 0.5 - kSide / 2, y + 0.5 - kSide / 2);
            if (r <= 0.02 || r >= 0.45) continue;
            double exact = 0.0;
            for (int i = 0; i < kSamples * kSamples; ++i) {
                const double px = x + (i % kSamples + 0.5) / kSamples - kSide / 2;
                const double py = y + (i / kSamples + 0.5) / kSamples - kSide / 2;
                exact += rings[static_cast<std::size_t>(pixel * std::hypot(px, py) / kRing)];
            }
            exact /= kSamples * kSamples;
            const double off = irradiance.rgb(x, y).g - exact;
            sum += off * off / (exact * exact + 0.01 * kSun * kSun);
            ++count;
        }
    }
    return sum / count;
}

double errorOf(const std::string& photons, const std::string& reconstruct) {
    static const std::vector<double> rings = irradianceByDistance();
    static const scene::Scene scene = ballFromAbove();
    const Frame frame(
        scene, kSide, kSide,
        {{"emit.photons", photons}, {"specular", "interface"}, {"reconstruct", reconstruct}});
    const double error = relativeError(frame, rings);
    ::testing::Test::RecordProperty(reconstruct + "_" + photons,
                                    static_cast<int>(std::lround(1e6 * error)));
    return error;
}

TEST(BallLens, TrianglesComeToTheClosedFormAsPhotonsBecomeMore) {
    EXPECT_LT(errorOf("256x256", "triangles"), 5e-5);
    EXPECT_LT(errorOf("512x512", "triangles"), 4e-5);
}

TEST(BallLens, BeamsAreNearerToTheClosedFormThanSplatsOfOneSize) {
    EXPECT_LT(errorOf("256x256", "beams"), 0.25 * errorOf("256x256", "sprites"));
}

}  // namespace
}  // namespace kaustik::test
