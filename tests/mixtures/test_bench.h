// SPDX-License-Identifier: MIT
// The tests' only bench, on the only context of their process.
#pragma once

#include "tests/mixtures/bench.h"

namespace kaustik::mixtures {

[[nodiscard]] Bench& testBench();

}  // namespace kaustik::mixtures
