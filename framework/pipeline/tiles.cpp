// SPDX-License-Identifier: MIT
#include "framework/pipeline/tiles.h"

#include <fmt/format.h>

#include <limits>

#include "framework/core/error.h"

namespace kaustik {
namespace {

// Columns of the division whose tiles have the shortest border; 0: none has a pixel for each.
std::uint64_t columnsOf(std::uint64_t count, int width, int height) {
    std::uint64_t best = 0;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::uint64_t columns = 1;
         columns <= count && columns <= static_cast<std::uint64_t>(width); ++columns) {
        const std::uint64_t rows = count / columns;
        if (rows * columns != count || rows > static_cast<std::uint64_t>(height)) continue;
        const double around = static_cast<double>(width) / static_cast<double>(columns) +
                              static_cast<double>(height) / static_cast<double>(rows);
        if (around >= shortest) continue;
        shortest = around;
        best = columns;
    }
    return best;
}

}  // namespace

PixelRegion tileOf(const Shard& tile, int width, int height) {
    const std::uint64_t columns = columnsOf(tile.count, width, height);
    if (columns == 0) {
        throw ConfigError(fmt::format(
            "--tile: a picture of {}x{} cannot be divided into {} tiles of whole pixels.", width,
            height, tile.count));
    }
    const std::uint64_t place = tile.number - 1;
    const auto [left, right] =
        rangeOf({place % columns + 1, columns}, static_cast<std::uint64_t>(width));
    const auto [bottom, top] =
        rangeOf({place / columns + 1, tile.count / columns}, static_cast<std::uint64_t>(height));
    return {{static_cast<int>(left), static_cast<int>(bottom)},
            {static_cast<int>(right), static_cast<int>(top)}};
}

ScreenTile withBorder(const PixelRegion& own, int border, int width, int height) {
    const glm::ivec2 size(width, height);
    return {own, {glm::max(own.first - border, glm::ivec2(0)), glm::min(own.end + border, size)}};
}

}  // namespace kaustik
