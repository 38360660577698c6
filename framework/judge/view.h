// SPDX-License-Identifier: MIT
// Whether their picture is of this scene, seen by its camera.
#pragma once

#include <optional>

#include "framework/judge/comparison.h"

namespace kaustik::judge {

// How much of what varies in their picture, beyond an even light on the receivers, the mixture of
// light and mistakes explains: 1 all of it, noise left out. Nothing where no more varies than its
// noise. Throws ConfigError where that is too little for a picture of this scene, and where a
// camera at another place or in another direction explains what is left.
[[nodiscard]] std::optional<double> requireSameView(Comparison& comparison);

}  // namespace kaustik::judge
