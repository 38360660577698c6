// SPDX-License-Identifier: MIT
// An image as a reader process sends it.
#pragma once

#include <tuple>
#include <type_traits>

#include "framework/image/image.h"
#include "framework/reading/wire.h"

namespace kaustik {

template <class T>
requires std::is_same_v<std::remove_const_t<T>, Image>
auto partsOf(T& image) {
    auto& [width, height, channels, values] = image;
    return std::tie(width, height, channels, values);
}

}  // namespace kaustik
