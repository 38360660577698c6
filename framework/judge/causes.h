// SPDX-License-Identifier: MIT
// Which mistakes explain what is wrong, one after another.
#pragma once

#include <string>
#include <vector>

#include "framework/judge/comparison.h"

namespace kaustik::judge {

// A set of columns that stands or falls together.
struct Candidate {
    std::vector<std::size_t> columns;
    Role role = Role::cause;
    std::size_t index = 0;      // of a class, or of the first of its causes
    std::vector<double> steps;  // of causes: the amounts that their columns are of
};

// A candidate that was taken, and the sentences of those that explain the same nearly as well.
struct Choice {
    Candidate candidate;
    std::vector<std::string> also;
};

// Makes the equations, and takes the candidate that explains most as long as one explains enough.
[[nodiscard]] std::vector<Choice> selectCauses(Comparison& comparison);

}  // namespace kaustik::judge
