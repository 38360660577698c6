// SPDX-License-Identifier: MIT
// The colour spaces that their pictures come in, by the chromaticities of their primaries and of
// their white; the reference's is Rec. 709.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>

#include "framework/judge/judge.h"

namespace kaustik::judge {

inline constexpr std::array kAllPrimaries = {Primaries::rec709, Primaries::rec2020, Primaries::p3,
                                             Primaries::acescg, Primaries::aces2065};

// Linear light of such primaries in Rec. 709: white stays white (Bradford's adaptation, where
// whites differ). A column is a primary.
[[nodiscard]] glm::dmat3 toRec709(Primaries primaries);

// Pixels of three channels by a matrix, and standard errors of channels that are independent.
[[nodiscard]] Image transformed(const Image& image, const glm::dmat3& matrix);
[[nodiscard]] Image transformedError(const Image& error, const glm::dmat3& matrix);

// "Rec. 2020".
[[nodiscard]] std::string titleOf(Primaries primaries);

}  // namespace kaustik::judge
