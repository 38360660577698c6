// SPDX-License-Identifier: MIT
// What mixtures have been found to do wrong: made small, and, where it is not mended yet, told
// apart from what is new.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/mixtures/checks.h"

namespace kaustik::mixtures {

// Drops settings as long as it fails: few that all are needed.
[[nodiscard]] Mixture minimised(Mixture mixture, const std::function<bool(const Mixture&)>& fails);
// As long as the check finds something wrong.
[[nodiscard]] Mixture minimised(Bench& bench, const Mixture& mixture, const std::string& check);

// Not mended yet.
struct KnownFind {
    std::string line;   // by which it is seen, as mixtureOf() takes it
    std::string check;  // which finds it
    std::string what;   // is wrong
    // Which other mixtures it explains: those that a check of this kind ("scale") finds fault with
    // and that have one of the values ("a|b") of each setting. `scene` and `technique` count as
    // settings.
    Settings where;
};
[[nodiscard]] const std::vector<KnownFind>& knownFinds();
// The first that explains it.
[[nodiscard]] const KnownFind* knownFindOf(const Mixture& mixture, const std::string& check);

// Mended: a line, and the check that found fault with it.
struct MendedFind {
    std::string line;
    std::string check;
};
[[nodiscard]] const std::vector<MendedFind>& mendedFinds();

}  // namespace kaustik::mixtures
