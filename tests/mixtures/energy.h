// SPDX-License-Identifier: MIT
// The light of a frame next to the reference of those paths that its technique claims to model.
#pragma once

#include "tests/mixtures/checks.h"

namespace kaustik::mixtures {

// Nothing is wrong where each output has the reference's energy, or where a warning or a limit of
// the report names a setting by which it has.
[[nodiscard]] Verdict energyVerdict(Bench& bench, const Rendered& rendered);

}  // namespace kaustik::mixtures
