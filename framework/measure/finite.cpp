// SPDX-License-Identifier: MIT
#include "framework/measure/finite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kaustik::measure {

std::optional<NotFinite> findNotFinite(const Image& image) {
    NotFinite found;
    std::size_t first = image.values.size();
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        const float value = image.values[i];
        if (std::isfinite(value)) continue;
        first = std::min(first, i);
        ++(std::isnan(value) ? found.nanCount : found.infinityCount);
    }
    if (first == image.values.size()) return std::nullopt;
    const auto channels = static_cast<std::size_t>(image.channels);
    const auto width = static_cast<std::size_t>(image.width);
    found.channel = static_cast<int>(first % channels);
    found.x = static_cast<int>(first / channels % width);
    found.y = static_cast<int>(first / channels / width);
    return found;
}

std::string describe(const NotFinite& found) {
    const std::size_t count = found.nanCount + found.infinityCount;
    return fmt::format(
        "{} value{} not finite ({} NaN, {} infinite), the first at pixel ({}, {}), channel {}",
        count, count == 1 ? " that is" : "s that are", found.nanCount, found.infinityCount, found.x,
        found.y, found.channel);
}

}  // namespace kaustik::measure
