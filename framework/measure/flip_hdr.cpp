// SPDX-License-Identifier: MIT
#include "framework/measure/flip_hdr.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <future>
#include <thread>
#include <vector>

namespace kaustik::measure {
namespace {

// (A x² + B x) / (D x² + E x + F)
constexpr double kA = 0.6 * 0.6 * 2.51;
constexpr double kB = 0.6 * 0.03;
constexpr double kD = 0.6 * 0.6 * 2.43;
constexpr double kE = 0.6 * 0.59;
constexpr double kF = 0.14;
constexpr double kShown = 0.85;

// The linear value that is shown as 0.85: the curve's equation solved for x.
double linearShownAsTarget() {
    const double a = kA - kShown * kD;
    const double b = kB - kShown * kE;
    const double c = -kShown * kF;
    return (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
}

RgbPlanes shown(const Image& rgb, double exposure) {
    const double gain = std::exp2(exposure);
    RgbPlanes planes;
    for (std::size_t c = 0; c < 3; ++c) {
        planes[c] = Plane<float>(rgb.width, rgb.height);
        for (std::size_t i = 0; i < planes[c].values.size(); ++i) {
            const double value = static_cast<double>(rgb.values[3 * i + c]);
            planes[c].values[i] = static_cast<float>(toneMap(gain * std::max(value, 0.0)));
        }
    }
    return planes;
}

}  // namespace

double ExposureRange::at(int index) const {
    return count < 2 ? start : start + (stop - start) * index / (count - 1);
}

double toneMap(double linear) {
    // The curve is 1 from 12.1 on; squares of what is far above would overflow.
    const double x = std::min(linear, 100.0);
    return std::min(x * (kA * x + kB) / (x * (kD * x + kE) + kF), 1.0);
}

ExposureRange defaultExposures(const ReferenceScale& scale) {
    assert(!scale.isBlack());
    ExposureRange range;
    range.start = std::log2(linearShownAsTarget() / scale.brightest);
    range.stop = std::log2(linearShownAsTarget() / scale.faint);
    range.count = std::max(2, static_cast<int>(std::ceil(range.stop - range.start)));
    return range;
}

Plane<float> hdrFlipMap(const ImagePair& pair, const ExposureRange& exposures,
                        double pixelsPerDegree) {
    assert(exposures.count >= 1);
    std::atomic<int> next{0};
    const auto largestOfMany = [&] {
        Plane<float> largest(pair.width(), pair.height());
        for (int index = next++; index < exposures.count; index = next++) {
            const double exposure = exposures.at(index);
            const Plane<float> map = flipMap(shown(pair.image(), exposure),
                                             shown(pair.reference(), exposure), pixelsPerDegree);
            for (std::size_t i = 0; i < map.values.size(); ++i)
                largest.values[i] = std::max(largest.values[i], map.values[i]);
        }
        return largest;
    };
    const int workers =
        std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, exposures.count);
    std::vector<std::future<Plane<float>>> others;
    for (int worker = 1; worker < workers; ++worker)
        others.push_back(std::async(std::launch::async, largestOfMany));
    Plane<float> largest = largestOfMany();
    for (std::future<Plane<float>>& other : others) {
        const Plane<float> map = other.get();
        for (std::size_t i = 0; i < map.values.size(); ++i)
            largest.values[i] = std::max(largest.values[i], map.values[i]);
    }
    return largest;
}

}  // namespace kaustik::measure
