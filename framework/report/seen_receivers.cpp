// SPDX-License-Identifier: MIT
#include "framework/report/seen_receivers.h"

#include <algorithm>
#include <cstddef>

namespace kaustik::report {

std::vector<float> seenReceivers(const std::vector<float>& receiver, int width, int side) {
    const auto texels = static_cast<std::size_t>(width);
    const auto across = static_cast<std::size_t>(side);
    const std::size_t columns = texels / across;
    std::vector<float> pixels(receiver.size() / (across * across), 0.0f);
    for (std::size_t i = 0; 2 * i + 1 < receiver.size(); ++i) {
        if (!(receiver[2 * i] > 0.0f)) continue;
        const std::size_t pixel = i / texels / across * columns + i % texels / across;
        pixels[2 * pixel] = std::max(pixels[2 * pixel], receiver[2 * i]);
        pixels[2 * pixel + 1] += receiver[2 * i + 1];
    }
    return pixels;
}

}  // namespace kaustik::report
