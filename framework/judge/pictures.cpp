// SPDX-License-Identifier: MIT
#include "framework/judge/pictures.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kaustik::judge {
namespace {

double linearOfSrgb(double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

std::vector<double> gaussianKernel(double sigma) {
    const int reach = std::max(1, static_cast<int>(std::ceil(3.5 * sigma)));
    std::vector<double> kernel;
    double total = 0.0;
    for (int i = -reach; i <= reach; ++i) {
        // The part of the Gaussian that falls on the pixel: narrow ones keep their width too.
        const double weight = std::erf((i + 0.5) / (sigma * std::sqrt(2.0))) -
                              std::erf((i - 0.5) / (sigma * std::sqrt(2.0)));
        kernel.push_back(weight);
        total += weight;
    }
    for (double& weight : kernel)
        weight /= total;
    return kernel;
}

Image convolvedAlong(const Image& image, const std::vector<double>& kernel, bool isAlongX) {
    const int reach = static_cast<int>(kernel.size()) / 2;
    Image result(image.width, image.height, image.channels);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < image.channels; ++c) {
                double total = 0.0;
                for (int i = -reach; i <= reach; ++i) {
                    const int column = std::clamp(isAlongX ? x + i : x, 0, image.width - 1);
                    const int row = std::clamp(isAlongX ? y : y + i, 0, image.height - 1);
                    total += kernel[static_cast<std::size_t>(i + reach)] *
                             static_cast<double>(image.at(column, row, c));
                }
                result.at(x, y, c) = static_cast<float>(total);
            }
        }
    }
    return result;
}

Image difference(const Image& image, int dx, int dy) {
    Image result(image.width, image.height, image.channels);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const int left = std::clamp(x - dx, 0, image.width - 1);
            const int right = std::clamp(x + dx, 0, image.width - 1);
            const int top = std::clamp(y - dy, 0, image.height - 1);
            const int bottom = std::clamp(y + dy, 0, image.height - 1);
            for (int c = 0; c < image.channels; ++c)
                result.at(x, y, c) = 0.5f * (image.at(right, bottom, c) - image.at(left, top, c));
        }
    }
    return result;
}

double medianOf(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// A value of a residual, as noise.
struct Sample {
    double light = 0.0;
    double deviation = 0.0;  // from the mean of its neighbours, as if of one pixel
    double variance = 0.0;   // that is known
};

// Of the pixels whose four neighbours are in the mask, as they are.
std::vector<Sample> noiseSamples(const Image& residual, const Image& expected, const Image& known,
                                 const Image& mask) {
    std::vector<Sample> samples;
    for (int y = 1; y + 1 < residual.height; ++y) {
        for (int x = 1; x + 1 < residual.width; ++x) {
            if (mask.at(x, y, 0) < 0.5f || mask.at(x - 1, y, 0) < 0.5f ||
                mask.at(x + 1, y, 0) < 0.5f || mask.at(x, y - 1, 0) < 0.5f ||
                mask.at(x, y + 1, 0) < 0.5f)
                continue;
            for (int c = 0; c < 3; ++c) {
                const float around = residual.at(x - 1, y, c) + residual.at(x + 1, y, c) +
                                     residual.at(x, y - 1, c) + residual.at(x, y + 1, c);
                const double deviation =
                    static_cast<double>(residual.at(x, y, c) - 0.25f * around) / std::sqrt(1.25);
                const auto error = static_cast<double>(known.at(x, y, c));
                samples.push_back(
                    {static_cast<double>(expected.at(x, y, c)), deviation, error * error});
            }
        }
    }
    return samples;
}

// Light and its standard deviation, by rising light.
using NoiseCurve = std::vector<std::pair<double, double>>;

NoiseCurve noiseCurve(std::vector<Sample> samples) {
    std::sort(samples.begin(), samples.end(),
              [](const Sample& a, const Sample& b) { return a.light < b.light; });
    // Bins of as many samples; between their middles it is linear.
    const std::size_t bins = std::clamp<std::size_t>(samples.size() / 400, 1, 12);
    NoiseCurve curve;
    for (std::size_t bin = 0; bin < bins; ++bin) {
        const std::size_t first = bin * samples.size() / bins;
        const std::size_t end = (bin + 1) * samples.size() / bins;
        std::vector<double> sizes;
        double light = 0.0;
        double variance = 0.0;
        for (std::size_t i = first; i < end; ++i) {
            sizes.push_back(std::abs(samples[i].deviation));
            light += samples[i].light;
            variance += samples[i].variance;
        }
        const auto count = static_cast<double>(end - first);
        const double deviation = 1.4826 * medianOf(sizes);
        curve.emplace_back(light / count,
                           std::sqrt(std::max(deviation * deviation - variance / count, 0.0)));
    }
    return curve;
}

double deviationAt(const NoiseCurve& curve, double light) {
    const auto next = std::lower_bound(
        curve.begin(), curve.end(), light,
        [](const std::pair<double, double>& at, double value) { return at.first < value; });
    double deviation = curve.back().second;
    if (next == curve.end()) {
        // Brighter than all of them: shot noise grows with the root.
        deviation *= std::sqrt(std::max(light / std::max(curve.back().first, 1e-300), 1.0));
    } else if (next == curve.begin()) {
        deviation = curve.front().second;
    } else {
        const auto before = std::prev(next);
        const double share =
            (light - before->first) / std::max(next->first - before->first, 1e-300);
        deviation = before->second + share * (next->second - before->second);
    }
    return deviation;
}

}  // namespace

bool isEmpty(const Image& image) {
    return image.values.empty();
}

double total(const Image& image, const Image& mask) {
    double result = 0.0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < image.channels && mask.at(x, y, 0) > 0.5f; ++c)
                result += static_cast<double>(image.at(x, y, c));
        }
    }
    return result;
}

double pixelCount(const Image& mask) {
    return static_cast<double>(std::count_if(mask.values.begin(), mask.values.end(),
                                             [](float value) { return value > 0.5f; }));
}

Image threeChannels(const Image& image) {
    Image result(image.width, image.height, 3);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < 3; ++c)
                result.at(x, y, c) = image.at(x, y, image.channels >= 3 ? c : 0);
        }
    }
    return result;
}

Image decoded(const Image& image, Encoding encoding) {
    if (encoding == Encoding::linear || encoding == Encoding::automatic) return image;
    Image result = image;
    for (float& value : result.values) {
        const double stored = std::max(static_cast<double>(value), 0.0);
        value = static_cast<float>(encoding == Encoding::srgb ? linearOfSrgb(stored)
                                                              : std::pow(stored, 2.2));
    }
    return result;
}

Image blurred(const Image& image, double sigma) {
    if (!(sigma > 0.0)) return image;
    const std::vector<double> kernel = gaussianKernel(sigma);
    return convolvedAlong(convolvedAlong(image, kernel, true), kernel, false);
}

Image blurredVariance(const Image& variance, double sigma) {
    if (!(sigma > 0.0)) return variance;
    std::vector<double> squares = gaussianKernel(sigma);
    for (double& weight : squares)
        weight *= weight;
    return convolvedAlong(convolvedAlong(variance, squares, true), squares, false);
}

Image sum(const std::vector<const Image*>& images) {
    Image result = *images.front();
    for (std::size_t i = 1; i < images.size(); ++i) {
        for (std::size_t at = 0; at < result.values.size(); ++at)
            result.values[at] += images[i]->values[at];
    }
    return result;
}

Image derivativeX(const Image& image) {
    return difference(image, 1, 0);
}

Image derivativeY(const Image& image) {
    return difference(image, 0, 1);
}

Image derivativeScale(const Image& image) {
    const Image dx = derivativeX(image);
    Image result = derivativeY(image);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const auto across = static_cast<float>(x + 0.5 - 0.5 * image.width);
            const auto down = static_cast<float>(y + 0.5 - 0.5 * image.height);
            for (int c = 0; c < image.channels; ++c)
                result.at(x, y, c) = across * dx.at(x, y, c) + down * result.at(x, y, c);
        }
    }
    return result;
}

Image noiseOf(const Image& residual, const Image& expected, const Image& known, const Image& mask) {
    Image result(residual.width, residual.height, 3);
    std::vector<Sample> samples = noiseSamples(residual, expected, known, mask);
    if (samples.empty()) return result;
    const NoiseCurve curve = noiseCurve(std::move(samples));
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        result.values[i] =
            static_cast<float>(deviationAt(curve, static_cast<double>(expected.values[i])));
    }
    return result;
}

}  // namespace kaustik::judge
