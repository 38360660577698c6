// SPDX-License-Identifier: MIT
#include "framework/gui/histogram.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace kaustik::gui {

namespace {

// Among what is kept by channel.
constexpr int kAllChannels = -1;
constexpr int kLuminance = -2;
constexpr int kLength = -3;

// Of `count` channels from the first on.
std::vector<float> finiteValues(const Image& image, std::size_t first, std::size_t count) {
    const auto channels = static_cast<std::size_t>(std::max(image.channels, 1));
    std::vector<float> values;
    values.reserve(image.values.size() / channels * count);
    for (std::size_t i = 0; i + channels <= image.values.size(); i += channels) {
        for (std::size_t c = first; c < first + count; ++c) {
            if (std::isfinite(image.values[i + c])) values.push_back(image.values[i + c]);
        }
    }
    return values;
}

Histogram histogramOf(std::vector<float> values) {
    Histogram histogram;
    if (values.empty()) return histogram;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    histogram.low = *low;
    histogram.high = *high;
    const auto firstPositive =
        std::partition(values.begin(), values.end(), [](float value) { return value <= 0.0f; });
    const auto begin = firstPositive == values.end() ? values.begin() : firstPositive;
    const auto ninetyNine = begin + (values.end() - begin) * 99 / 100;
    std::nth_element(begin, std::min(ninetyNine, values.end() - 1), values.end());
    histogram.bright = *std::min(ninetyNine, values.end() - 1);

    histogram.end = std::clamp(2.0f * histogram.bright, histogram.low, histogram.high);
    const float range = histogram.end - histogram.low;
    if (!(range > 0.0f) || !std::isfinite(range)) return histogram;
    const float scale = static_cast<float>(Histogram::kBins) / range;
    for (const float value : values) {
        const float place = std::min((value - histogram.low) * scale, Histogram::kBins - 1.0f);
        ++histogram.counts[static_cast<std::size_t>(place)];
    }
    return histogram;
}

}  // namespace

Histogram histogramOf(const Image& image) {
    const auto channels = static_cast<std::size_t>(std::max(image.channels, 1));
    return histogramOf(finiteValues(image, 0, std::min<std::size_t>(channels, 3)));
}

Histogram histogramOf(const Image& image, int channel) {
    return histogramOf(finiteValues(image, static_cast<std::size_t>(channel), 1));
}

Histogram histogramOf(const Image& image, Together together) {
    const auto channels = static_cast<std::size_t>(std::max(image.channels, 1));
    std::vector<float> values;
    values.reserve(image.values.size() / channels);
    for (std::size_t i = 0; i + channels <= image.values.size(); i += channels) {
        // As shaders/gui/tone.frag has them.
        const float red = image.values[i];
        const float green = channels > 1 ? image.values[i + 1] : red;
        const float blue = channels > 2 ? image.values[i + 2] : channels > 1 ? 0.0f : red;
        const float value =
            together == Together::length
                ? std::sqrt(red * red + green * green + blue * blue)
                : 0.2126390059f * red + 0.7151686788f * green + 0.0721923154f * blue;
        if (std::isfinite(value)) values.push_back(value);
    }
    return histogramOf(std::move(values));
}

const Histogram& Histograms::all(const Image& image) {
    return kept(kAllChannels, [&] { return histogramOf(image); });
}

const Histogram& Histograms::channel(const Image& image, int channel) {
    return kept(channel, [&] { return histogramOf(image, channel); });
}

const Histogram& Histograms::together(const Image& image, Together together) {
    return kept(together == Together::luminance ? kLuminance : kLength,
                [&] { return histogramOf(image, together); });
}

const Histogram& Histograms::kept(int key, const std::function<Histogram()>& make) {
    const std::lock_guard lock(mutex_);
    auto found = made_.find(key);
    if (found == made_.end()) found = made_.emplace(key, make()).first;
    return found->second;
}

}  // namespace kaustik::gui
