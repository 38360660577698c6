// SPDX-License-Identifier: MIT
// Mixtures that are refused, and what refusals and warnings advise.
#pragma once

#include <exception>

#include "tests/mixtures/checks.h"

namespace kaustik::mixtures {

[[nodiscard]] Refusal refusalOf(const std::exception& error);

}  // namespace kaustik::mixtures
