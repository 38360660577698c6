// SPDX-License-Identifier: MIT
// The first question to any image: are all of its values numbers? Comparison tools that skip it
// pass an image that is full of NaN.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "framework/image/image.h"

namespace kaustik::measure {

struct NotFinite {
    std::size_t nanCount = 0;
    std::size_t infinityCount = 0;
    int x = 0;  // of the first, in reading order
    int y = 0;
    int channel = 0;
};

// The first value that is not finite. There is none where every value of every channel is finite.
[[nodiscard]] std::optional<NotFinite> findNotFinite(const Image& image);

// "2 values that are not finite (1 NaN, 1 infinite), the first at pixel (3, 4), channel 0"
[[nodiscard]] std::string describe(const NotFinite& found);

}  // namespace kaustik::measure
