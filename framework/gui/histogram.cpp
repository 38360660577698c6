// SPDX-License-Identifier: MIT
#include "framework/gui/histogram.h"

#include <algorithm>
#include <cmath>

namespace kaustik::gui {

Histogram histogramOf(const Image& image) {
    Histogram histogram;
    const auto channels = static_cast<std::size_t>(std::max(image.channels, 1));
    const std::size_t colours = std::min<std::size_t>(channels, 3);
    bool isFirst = true;
    const auto visit = [&](const auto& take) {
        for (std::size_t i = 0; i + channels <= image.values.size(); i += channels) {
            for (std::size_t c = 0; c < colours; ++c) {
                if (std::isfinite(image.values[i + c])) take(image.values[i + c]);
            }
        }
    };
    visit([&](float value) {
        histogram.low = isFirst ? value : std::min(histogram.low, value);
        histogram.high = isFirst ? value : std::max(histogram.high, value);
        isFirst = false;
    });
    const float range = histogram.high - histogram.low;
    if (!(range > 0.0f) || !std::isfinite(range)) {
        histogram.percentile99 = histogram.high;
        return histogram;
    }
    const float scale = static_cast<float>(Histogram::kBins) / range;
    std::uint64_t positive = 0;
    std::array<std::uint64_t, Histogram::kBins> positives{};
    visit([&](float value) {
        const auto bin = std::min(static_cast<std::size_t>((value - histogram.low) * scale),
                                  Histogram::kBins - 1);
        ++histogram.counts[bin];
        if (value > 0.0f) {
            ++positives[bin];
            ++positive;
        }
    });
    std::uint64_t below = 0;
    for (std::size_t bin = 0; bin < Histogram::kBins; ++bin) {
        below += positives[bin];
        histogram.percentile99 = histogram.low + static_cast<float>(bin + 1) / scale;
        if (static_cast<double>(below) >= 0.99 * static_cast<double>(positive)) break;
    }
    return histogram;
}

}  // namespace kaustik::gui
