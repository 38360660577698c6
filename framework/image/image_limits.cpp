// SPDX-License-Identifier: MIT
#include "framework/image/image_limits.h"

#include <fmt/format.h>

namespace kaustik {

std::string imageSizeProblem(std::int64_t width, std::int64_t height, std::int64_t channels) {
    if (width < 1 || height < 1) {
        return fmt::format("has no pixels ({}x{})", width, height);
    }
    if (channels < 1 || channels > 4) {
        return fmt::format("has {} channels; 1 to 4 can be used", channels);
    }
    // Sides first: their product is then far from overflow.
    if (width > kLargestImageSide || height > kLargestImageSide ||
        width * height * channels > kLargestImageValues) {
        return fmt::format(
            "is too large ({}x{} with {} channels; at most {} pixels a side and {} values)", width,
            height, channels, kLargestImageSide, kLargestImageValues);
    }
    return "";
}

std::string layeredSizeProblem(std::int64_t width, std::int64_t height, std::int64_t channels) {
    const std::string problem = imageSizeProblem(width, height, 1);
    if (!problem.empty()) return problem;
    if (channels < 1 || channels > kLargestChannelCount) {
        return fmt::format("has {} channels; 1 to {} can be used", channels, kLargestChannelCount);
    }
    if (width * height * channels > kLargestImageValues) {
        return fmt::format("is too large ({}x{} with {} channels; at most {} values)", width,
                           height, channels, kLargestImageValues);
    }
    return "";
}

}  // namespace kaustik
