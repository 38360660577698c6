// SPDX-License-Identifier: MIT
// The light of a frame next to the reference of those paths that its technique claims to model.
#pragma once

#include "tests/mixtures/checks.h"

namespace kaustik::mixtures {

// Whether fewer photons, cells or texels than a small mixture's stand for the light: then its
// energy is that of where a few of them happen to lie.
[[nodiscard]] bool isCoarse(const Mixture& mixture, const Shot& shot);

// Nothing is wrong where each output has the reference's energy, or where a warning or a limit of
// the report names a setting by which it has.
[[nodiscard]] Verdict energyVerdict(Bench& bench, const Rendered& rendered);

}  // namespace kaustik::mixtures
