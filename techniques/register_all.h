// SPDX-License-Identifier: MIT
#pragma once

#include "framework/pipeline/registry.h"

namespace kaustik {

// Every technique and node of the project.
[[nodiscard]] Registry registerAll();

}  // namespace kaustik
