// SPDX-License-Identifier: MIT
// The images of a scene in linear light, for the device and for the reference alike.
#pragma once

#include "framework/image/image.h"
#include "framework/scene/scene.h"

namespace kaustik::scene {

// Three channels (a grey image in all of them), rows from the top; sRGB is decoded where the image
// says so (IEC 61966-2-1), other values stay as they are; of a normal map they become the
// components of vectors, 2 c - 1. Throws IoError that names the image when it cannot be read, holds
// a value that is negative or no number, or is called a normal map and cannot be one.
[[nodiscard]] Image decodeTexture(const TextureImage& texture);

}  // namespace kaustik::scene
