// SPDX-License-Identifier: MIT
// Some of a study's runs, by the values of what it varies.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "framework/experiment/plan.h"

namespace kaustik::experiment {

// The hashes of the runs that have all of `conditions`, each "KEY=VALUE": KEY is an axis of the
// plan by its full name or by its end that no other axis has, VALUE one of its values as the study
// writes it (numbers by their size: 0.10 is 0.1). Several conditions of one key are alternatives.
// Throws ConfigError that begins with `option` where a condition is not of that form, its key is no
// axis or its value is none of that axis, or where no run has them all.
[[nodiscard]] std::set<std::string> selectRuns(const Plan& plan,
                                               const std::vector<std::string>& conditions,
                                               const std::string& option);

}  // namespace kaustik::experiment
