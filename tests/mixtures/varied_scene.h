// SPDX-License-Identifier: MIT
// The same scene in another size, place, light or order.
#pragma once

#include "tests/mixtures/bench.h"

namespace kaustik::mixtures {

[[nodiscard]] scene::Scene varied(scene::Scene scene, const Variation& variation);

}  // namespace kaustik::mixtures
