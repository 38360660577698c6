// SPDX-License-Identifier: MIT
// Which way up and where their picture lies, and what of the scene it shows: glass, direct light.
#pragma once

#include "framework/judge/comparison.h"

namespace kaustik::judge {

// Sets `picture`, `theirsError`, `firstExposure` and `counted` by the registration, encoding
// and primaries.
void align(Comparison& comparison);

// Sets the columns without causes, `registration`, and `hasDirect` where the picture shows that
// there is none. Gives all light of the reference that the picture may have. Throws ConfigError
// where the two pictures have nothing in common.
[[nodiscard]] Image registerPictures(Comparison& comparison);
// Sets `glassIsHidden` where it was not given, and aligns.
void decideGlass(Comparison& comparison);
// Sets `hasDirect` by how much of direct light is found, and aligns.
void decideDirect(Comparison& comparison);

}  // namespace kaustik::judge
