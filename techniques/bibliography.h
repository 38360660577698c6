// SPDX-License-Identifier: MIT
// The papers behind the nodes, by the short names that descriptions and parameters cite them by.
// The bibliography of techniques/papers.md is the same list, which a test compares.
#pragma once

#include "framework/pipeline/registry.h"

namespace kaustik {

void registerPapers(Registry& registry);

}  // namespace kaustik
