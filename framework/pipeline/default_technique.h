// SPDX-License-Identifier: MIT
#pragma once

namespace kaustik {

// What renders where nobody has chosen: on the devices that were measured, with a GPU and without,
// it has its error sooner than every other (results/speed_and_error.md).
inline constexpr const char* kDefaultTechnique = "exact_rays";

}  // namespace kaustik
