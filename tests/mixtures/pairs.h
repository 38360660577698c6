// SPDX-License-Identifier: MIT
// Mixtures in which every node meets every node of every other stage.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/mixtures/mixture.h"

namespace kaustik::mixtures {

using Answer = std::pair<std::string, std::string>;  // of a stage, or where light is stored

// Two answers that are refused together.
struct Apart {
    Answer one;
    Answer other;
};
[[nodiscard]] std::vector<Apart> answersApart();

// The same list for the same registry: few mixtures, of which each has as many pairs that none
// before it has as can be found by taking the best node stage by stage.
[[nodiscard]] const std::vector<Mixture>& mixturesOfAllPairs();

}  // namespace kaustik::mixtures
