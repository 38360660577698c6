// SPDX-License-Identifier: MIT
// What is handed to Python: 32-bit floats, rows from the top.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "framework/image/image.h"

namespace kaustik::python {

// Height x width x channels, with the number of layers first where there are several.
struct Array {
    std::vector<std::size_t> shape;  // three or four
    std::vector<float> values;       // without gaps, the last index fastest
    // Whether the image was made for a display: its values are in [0,1] and not linear.
    bool isForDisplay = false;

    Array() = default;
    explicit Array(Image image);

    [[nodiscard]] std::size_t layers() const { return shape.size() == 4 ? shape[0] : 1; }
    [[nodiscard]] std::size_t height() const { return shape[shape.size() - 3]; }
    [[nodiscard]] std::size_t width() const { return shape[shape.size() - 2]; }
    [[nodiscard]] std::size_t channels() const { return shape.back(); }
    // Throws ConfigError for a layer that is not there.
    [[nodiscard]] Image layer(std::size_t index) const;
};

// A picture of an image for people: 8 bits, RGB. One for a display is as it is; another is scaled,
// so that its 99th percentile becomes white, and encoded. Two channels are red and green, one is
// grey, and what is negative or no number is black.
struct Preview {
    Image image;         // values in [0,1], encoded
    double white = 1.0;  // the value that became white
};
[[nodiscard]] Preview previewOf(const Array& array, std::size_t layer);

}  // namespace kaustik::python
