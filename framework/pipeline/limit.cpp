// SPDX-License-Identifier: MIT
#include "framework/pipeline/limit.h"

#include <vector>

#include "framework/gl/objects.h"

namespace kaustik {

std::size_t countWithFate(const gl::Texture& fated, std::uint32_t fate, int firstRow) {
    const std::vector<float> texels = fated.read();
    const std::size_t firstTexel =
        static_cast<std::size_t>(firstRow) * static_cast<std::size_t>(fated.desc().width);
    std::size_t count = 0;
    for (std::size_t i = 4 * firstTexel + 3; i < texels.size(); i += 4)
        count += static_cast<std::uint32_t>(texels[i]) == fate ? 1 : 0;
    return count;
}

}  // namespace kaustik
