// SPDX-License-Identifier: MIT
#include "framework/gui/histogram.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace kaustik::gui {

namespace {

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

}  // namespace kaustik::gui
