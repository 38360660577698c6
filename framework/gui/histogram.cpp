// SPDX-License-Identifier: MIT
#include "framework/gui/histogram.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace kaustik::gui {

Histogram histogramOf(const Image& image) {
    Histogram histogram;
    const auto channels = static_cast<std::size_t>(std::max(image.channels, 1));
    const std::size_t colours = std::min<std::size_t>(channels, 3);
    std::vector<float> values;
    values.reserve(image.values.size() / channels * colours);
    for (std::size_t i = 0; i + channels <= image.values.size(); i += channels) {
        for (std::size_t c = 0; c < colours; ++c) {
            if (std::isfinite(image.values[i + c])) values.push_back(image.values[i + c]);
        }
    }
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

}  // namespace kaustik::gui
