// SPDX-License-Identifier: MIT
// Many mixtures drawn at random, and what was found.
#pragma once

#include <cstdint>

#include "tests/mixtures/bench.h"

namespace kaustik::mixtures {

struct Draws {
    std::uint64_t seed = 1;
    int first = 0;  // the number of the first mixture
    int count = 100;
    int checks = 2;           // of a mixture that take further frames
    bool minimises = false;   // what is found
    int minimisedAtMost = 3;  // of each kind of check
};

// Prints each find as a line of the command line, and how often each check was made. Gives the
// number of finds that are not known.
[[nodiscard]] int runDraws(Bench& bench, const Draws& draws);

// The same of mixtures at the costly ends of ranges, each of which takes its time, or is refused
// for memory; an end need not be of use, so that energy is not asked for. `first`: the number of
// the one to begin with, from 1; some take hours, and can be left out so.
[[nodiscard]] int runEnds(Bench& bench, int first, int count);

}  // namespace kaustik::mixtures
