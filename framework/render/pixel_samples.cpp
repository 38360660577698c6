// SPDX-License-Identifier: MIT
#include "framework/render/pixel_samples.h"

#include <cmath>
#include <numbers>
#include <numeric>

namespace kaustik::render {

std::vector<glm::vec2> samplesOfPixel(int count) {
    // As near to the golden ratio's part as a number without a common divisor comes.
    const int modulus = count + 1;
    const double wanted = modulus / std::numbers::phi;
    int step = 1;
    for (int other = 2; other < modulus; ++other) {
        if (std::gcd(other, modulus) == 1 && std::abs(other - wanted) < std::abs(step - wanted))
            step = other;
    }
    std::vector<glm::vec2> offsets;
    for (int i = 1; i <= count; ++i) {
        const glm::vec2 cell(i, i * step % modulus);
        offsets.push_back((cell - 0.5f * static_cast<float>(modulus)) / static_cast<float>(count));
    }
    return offsets;
}

}  // namespace kaustik::render
