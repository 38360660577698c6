// SPDX-License-Identifier: MIT
// How large an image may be. A damaged header that asks for more is an error before any memory is.
#pragma once

#include <cstdint>
#include <string>

namespace kaustik {

inline constexpr std::int64_t kLargestImageSide = 65536;                    // pixels
inline constexpr std::int64_t kLargestImageValues = std::int64_t{1} << 29;  // floats: 2 GiB

// "" when an image of that size is allowed, else what is wrong, for the end of a sentence that
// begins with the file's name: "has no pixels (0x4)".
[[nodiscard]] std::string imageSizeProblem(std::int64_t width, std::int64_t height,
                                           std::int64_t channels);

}  // namespace kaustik
