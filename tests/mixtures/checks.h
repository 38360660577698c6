// SPDX-License-Identifier: MIT
// What must hold for every mixture. A check renders what it needs and says in a sentence what is
// wrong.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/mixtures/bench.h"

namespace kaustik::mixtures {

// A mixture, and the frame of it that all checks start from: every texture kept, from NaN.
struct Rendered {
    Mixture mixture;
    Shot shot;
};

// What is wrong; nothing where it holds. `isMade`: whether there was something to check.
struct Verdict {
    bool isMade = true;
    std::string problem = {};
};

struct Check {
    std::string name;  // "balance", "scale 100"
    std::function<Verdict(Bench&, const Rendered&)> run;
};

// Of the frame alone, made of each.
[[nodiscard]] std::vector<Check> checksOfAFrame();
// Each kind that takes more frames and that the mixture can fail, with what is drawn of it: which
// setting, angle or scale.
[[nodiscard]] std::vector<Check> drawnChecks(Random& random, const Rendered& rendered);
// The parameters of which any value gives the same bits, and nodes with others that do.
[[nodiscard]] std::vector<std::string> neutralNames();
// By a name of either list: "turn 33", "bits emit.batch=512". Throws ConfigError.
[[nodiscard]] Check checkOf(const std::string& name);

// What refused a mixture.
struct Refusal {
    std::string message;
    bool isOfMemory = false;  // which is no fault
    bool isOfRequest = false;
};
// What is wrong with a refusal: one sentence has to name a setting by which the mixture goes, or is
// refused for something else. "" where nothing is.
[[nodiscard]] std::string faultOf(Bench& bench, const Mixture& mixture, const Refusal& refusal);
// "name=value" of all that a text says is to be taken.
[[nodiscard]] Settings advised(const std::string& text);

// Renders it for the checks.
[[nodiscard]] std::optional<Rendered> renderForChecks(Bench& bench, const Mixture& mixture,
                                                      Refusal& refusal);

// "" where the check holds; else what is wrong, a refusal included. The names "refusal" and
// "throws" are checks, too.
[[nodiscard]] std::string problemOf(Bench& bench, const Mixture& mixture, const std::string& check);

}  // namespace kaustik::mixtures
