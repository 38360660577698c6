// SPDX-License-Identifier: MIT
// The scene's dielectrics by number, so that a stack of those around a photon fits into one float
// (transport/media_stack.h): the fewer there are, the deeper they may be nested.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/scene/scene.h"

namespace kaustik::scene {

struct Dielectrics {
    std::vector<std::uint32_t> numberOf;    // by material; from 1, 0 for what is none
    std::vector<std::uint32_t> materialOf;  // index, by number - 1
    std::uint32_t base = 2;                 // that stacks of numbers are packed by
    std::uint32_t end = 2;                  // base to the power of `depth`: above all that fit
    int depth = 1;                          // how deep they may be nested: 4 up to 44 dielectrics
};
[[nodiscard]] Dielectrics numberDielectrics(const Scene& scene);

// `media`: material index + 1, the innermost first; no more than `depth`.
[[nodiscard]] std::uint32_t packMedia(const Dielectrics& dielectrics,
                                      const std::vector<std::uint32_t>& media,
                                      std::uint32_t leftSide = 0);
[[nodiscard]] std::vector<std::uint32_t> unpackMedia(const Dielectrics& dielectrics,
                                                     std::uint32_t packed);

}  // namespace kaustik::scene
