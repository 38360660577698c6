// SPDX-License-Identifier: MIT
// What there is to say of their picture, a finding each.
#pragma once

#include <optional>
#include <vector>

#include "framework/judge/causes.h"
#include "framework/judge/class_verdicts.h"
#include "framework/judge/placement.h"

namespace kaustik::judge {

// What the steps of a judgement have found.
struct Evidence {
    std::vector<double> encodingScores;     // as of decideEncoding()
    std::vector<Primaries> otherPrimaries;  // as of decidePrimaries()
    PlacementError placementError;
    std::optional<double> explainedShare;  // as of requireSameView()
    std::vector<Choice> choices;
    Solution solution;
    Exposure exposure;
    std::vector<ClassVerdict> classes;
};

// In the order of a report: registration, encoding, primaries, channels, blur, causes, classes.
[[nodiscard]] std::vector<Finding> findingsOf(const Comparison& comparison,
                                              const Evidence& evidence);
// Those of the evidence's classes, on their own or with one factor of all of them.
void addClasses(const Comparison& comparison, const Evidence& evidence,
                std::vector<Finding>& findings);

}  // namespace kaustik::judge
