// SPDX-License-Identifier: MIT
#include "framework/measure/ssim.h"

#include "framework/measure/color.h"
#include "framework/measure/convolution.h"

namespace kaustik::measure {
namespace {

constexpr double kC1 = 0.01 * 0.01;
constexpr double kC2 = 0.03 * 0.03;

Plane<double> product(const Plane<double>& a, const Plane<double>& b) {
    Plane<double> result(a.width, a.height);
    for (std::size_t i = 0; i < result.values.size(); ++i)
        result.values[i] = a.values[i] * b.values[i];
    return result;
}

}  // namespace

Plane<double> displayLuminance(const Image& rgb, double white) {
    Plane<double> plane = luminancePlane(rgb);
    for (double& value : plane.values)
        value = encodeSrgb(value / white);
    return plane;
}

Plane<double> ssimMap(const Plane<double>& image, const Plane<double>& reference) {
    const Kernel window = gaussianKernel(1.5, kSsimRadius);
    const auto smooth = [&](const Plane<double>& plane) { return convolve(plane, window, window); };
    const Plane<double> meanX = smooth(image);
    const Plane<double> meanY = smooth(reference);
    const Plane<double> meanXx = smooth(product(image, image));
    const Plane<double> meanYy = smooth(product(reference, reference));
    const Plane<double> meanXy = smooth(product(image, reference));
    Plane<double> map(image.width, image.height);
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        const double x = meanX.values[i];
        const double y = meanY.values[i];
        const double varianceX = meanXx.values[i] - x * x;
        const double varianceY = meanYy.values[i] - y * y;
        const double covariance = meanXy.values[i] - x * y;
        map.values[i] = (2.0 * x * y + kC1) * (2.0 * covariance + kC2) /
                        ((x * x + y * y + kC1) * (varianceX + varianceY + kC2));
    }
    return map;
}

std::optional<double> ssim(const ImagePair& pair, double white) {
    const Plane<double> map =
        ssimMap(displayLuminance(pair.image(), white), displayLuminance(pair.reference(), white));
    double sum = 0.0;
    std::size_t count = 0;
    for (int y = kSsimRadius; y < map.height - kSsimRadius; ++y) {
        for (int x = kSsimRadius; x < map.width - kSsimRadius; ++x) {
            const double* const value = map.row(y) + x;
            if (!pair.counts(static_cast<std::size_t>(value - map.values.data()))) continue;
            sum += *value;
            ++count;
        }
    }
    if (count == 0) return std::nullopt;
    return sum / static_cast<double>(count);
}

}  // namespace kaustik::measure
