// SPDX-License-Identifier: MIT
// The two image formats that need no library: PFM (Paul Debevec's portable float map, 32-bit float,
// rows from bottom to top) and binary PPM (Netpbm's P6, 8 or 16 bits). Both as the bytes of a file.
#pragma once

#include <string>
#include <string_view>

#include "framework/image/image.h"

namespace kaustik {

// `name` is the file, for messages. Throw IoError where the bytes are not that format, are cut off,
// go on past the image's end, or hold more than checkImageSize allows. A PFM's scale multiplies its
// values; a PPM's values are divided by its maximum, so that they lie in [0,1].
[[nodiscard]] Image decodePfm(std::string_view bytes, const std::string& name);
[[nodiscard]] Image decodePpm(std::string_view bytes, const std::string& name);

// Little-endian float, scale 1. `image` has 1 or 3 channels.
[[nodiscard]] std::string encodePfm(const Image& image);

// 8 bits a channel. `image` has 1 channel (written as grey) or 3; see toEightBits.
[[nodiscard]] std::string encodePpm(const Image& image);

}  // namespace kaustik
