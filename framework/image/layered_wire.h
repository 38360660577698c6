// SPDX-License-Identifier: MIT
// A layered image as a reader process sends it.
#pragma once

#include <tuple>
#include <type_traits>

#include "framework/image/layered_image.h"
#include "framework/reading/wire.h"

namespace kaustik {

template <class T>
requires std::is_same_v<std::remove_const_t<T>, LayeredImage::Attribute>
auto partsOf(T& attribute) {
    auto& [name, value] = attribute;
    return std::tie(name, value);
}

template <class T>
requires std::is_same_v<std::remove_const_t<T>, LayeredImage>
auto partsOf(T& image) {
    auto& [width, height, channels, values, attributes] = image;
    return std::tie(width, height, channels, values, attributes);
}

}  // namespace kaustik
