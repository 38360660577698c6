// SPDX-License-Identifier: MIT
#include "framework/image/eight_bits.h"

#include <algorithm>
#include <cmath>

namespace kaustik {

std::vector<unsigned char> toEightBits(const Image& image) {
    std::vector<unsigned char> bytes(image.values.size());
    std::transform(image.values.begin(), image.values.end(), bytes.begin(), [](float value) {
        const float inRange = std::isnan(value) ? 0.0f : std::clamp(value, 0.0f, 1.0f);
        return static_cast<unsigned char>(std::lround(255.0f * inRange));
    });
    return bytes;
}

}  // namespace kaustik
