// SPDX-License-Identifier: MIT
// How an image's values are spread: for the range of false colours and the histogram beside them.
#pragma once

#include <array>
#include <cstdint>

#include "framework/image/image.h"

namespace kaustik::gui {

struct Histogram {
    static constexpr std::size_t kBins = 96;
    float low = 0.0f;  // least and greatest finite value of any channel of colour
    float high = 0.0f;
    float percentile99 = 0.0f;                  // of the values above 0, to a bin
    std::array<std::uint32_t, kBins> counts{};  // values by even steps from low to high
};

// Of the first three channels (a fourth is alpha or a flag).
[[nodiscard]] Histogram histogramOf(const Image& image);

}  // namespace kaustik::gui
