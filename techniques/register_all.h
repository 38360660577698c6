// SPDX-License-Identifier: MIT
// Makes the registry of everything that the project itself offers.
#pragma once

#include "framework/pipeline/registry.h"

namespace kaustik {

// Every technique and node of the project.
[[nodiscard]] Registry registerAll();

}  // namespace kaustik
