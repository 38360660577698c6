// SPDX-License-Identifier: MIT
// What is found in sentences, for those who look at the picture.
#pragma once

#include <string>
#include <vector>

#include "framework/judge/causes.h"

namespace kaustik::judge {

// `amounts` and `errors` (none: they are not said): of the candidate's columns.
[[nodiscard]] std::string sentenceOf(const Comparison& comparison, const Candidate& candidate,
                                     const std::vector<double>& amounts,
                                     const std::vector<double>& errors);
// Their vertical field of view in degrees, where a step of the reference's pixels is `scale` of
// theirs.
[[nodiscard]] double fieldOfViewOf(const Comparison& comparison, double scale);
// ": that is the horizontal one", where the horizontal angle was taken for the vertical one, or the
// other way round; else nothing.
[[nodiscard]] std::string aspectHint(const Comparison& comparison, double zoom);
// ", which is 1/π (0.318)", where a class's factor is a known one, within its error; else nothing.
[[nodiscard]] std::string meaningOf(const Comparison& comparison, double value, double error);

}  // namespace kaustik::judge
