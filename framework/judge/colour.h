// SPDX-License-Identifier: MIT
// What their values are: how light is coded, and which primaries the channels are of.
#pragma once

#include <vector>

#include "framework/judge/comparison.h"

namespace kaustik::judge {

// Sets `encoding`, for the best primaries of each, and aligns. The unexplained shares of linear,
// sRGB and a power of 1/2.2; nothing where the encoding was given.
[[nodiscard]] std::vector<double> decideEncoding(Comparison& comparison);

// Sets `primaries` and aligns, by the columns that there are. Which others the colours of the
// picture do not tell from these; nothing where they were given.
[[nodiscard]] std::vector<Primaries> decidePrimaries(Comparison& comparison);

}  // namespace kaustik::judge
