// SPDX-License-Identifier: MIT
// How large an image may be. A damaged header that asks for more is an error before any memory is.
#pragma once

#include <cstdint>
#include <string>

namespace kaustik {

inline constexpr std::int64_t kLargestImageSide = 65536;                    // pixels
inline constexpr std::int64_t kLargestImageValues = std::int64_t{1} << 29;  // floats: 2 GiB

// No format packs more values into a byte: 8 pixels of a bit each in 1 of 1032 bytes, in PNG. The
// ratio is not asked for below so many values, so that a picture of one colour may be as small as
// its format allows.
inline constexpr std::int64_t kMaxValuesPerByte = 16384;
inline constexpr std::int64_t kUnaskedValues = std::int64_t{1} << 26;  // 256 MiB

// "" when an image of that size is allowed, else what is wrong, for the end of a sentence that
// begins with the file's name: "has no pixels (0x4)".
[[nodiscard]] std::string imageSizeProblem(std::int64_t width, std::int64_t height,
                                           std::int64_t channels);

// The same for an image of named layers (layered_image.h), which has more channels.
inline constexpr std::int64_t kLargestChannelCount = 1024;
[[nodiscard]] std::string layeredSizeProblem(std::int64_t width, std::int64_t height,
                                             std::int64_t channels);

}  // namespace kaustik
