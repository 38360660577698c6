// SPDX-License-Identifier: MIT
#include "framework/numerics/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <tuple>

#include "framework/core/error.h"
#include "framework/core/names.h"
#include "framework/numerics/cases/common_cases.h"

namespace kaustik::numerics {
namespace {

// "C28a" as C, 28, "a".
std::tuple<char, int, std::string> orderOf(const std::string& id) {
    std::size_t end = 1;
    while (end < id.size() && std::isdigit(static_cast<unsigned char>(id[end])) != 0)
        ++end;
    const int number = end > 1 ? std::stoi(id.substr(1, end - 1)) : 0;
    return {id.front(), number, id.substr(end)};
}

bool matches(const std::string& pattern, const std::string& id) {
    if (!pattern.ends_with('*')) return pattern == id;
    return id.starts_with(pattern.substr(0, pattern.size() - 1));
}

}  // namespace

bool Row::passes() const {
    if (!std::isfinite(measured)) return false;
    switch (bound) {
        case Bound::near:
            return std::abs(measured - expected) <= tolerance;
        case Bound::atLeast:
            return measured >= expected - tolerance;
        case Bound::atMost:
            return measured <= expected + tolerance;
    }
    return false;
}

std::string Row::expectedText() const {
    const char* words = bound == Bound::near      ? ""
                        : bound == Bound::atLeast ? "at least "
                                                  : "at most ";
    return fmt::format("{}{:.7g}", words, expected);
}

void Suite::add(const std::string& id, const std::string& sentence,
                std::function<void(Lab&)> measure) {
    const auto there =
        std::find_if(cases_.begin(), cases_.end(), [&](const Case& c) { return c.id == id; });
    if (there != cases_.end()) {
        there->measure.push_back(std::move(measure));
        return;
    }
    cases_.push_back({id, sentence, {std::move(measure)}});
    std::sort(cases_.begin(), cases_.end(),
              [](const Case& a, const Case& b) { return orderOf(a.id) < orderOf(b.id); });
}

bool Suite::mayBeUnwritten(const std::string& name) const {
    return std::any_of(unwritten_.begin(), unwritten_.end(),
                       [&](const std::string& prefix) { return name.starts_with(prefix); });
}

Suite commonCases() {
    Suite suite;
    addRaySegmentCases(suite);
    addTracingCases(suite);
    addLayerCases(suite);
    addInterfaceCases(suite);
    addSurfaceSideCases(suite);
    addOpticsCases(suite);
    addReconstructionCases(suite);
    addMediaCases(suite);
    addMirrorCases(suite);
    addBallCases(suite);
    addDispersionCases(suite);
    addForeignSceneCases(suite);
    addWholeFrameCases(suite);
    return suite;
}

std::vector<Case> selectCases(const Suite& suite, const std::vector<std::string>& patterns) {
    std::vector<std::string> ids;
    for (const Case& c : suite.cases())
        ids.push_back(c.id);
    for (const std::string& pattern : patterns) {
        const bool isThere = std::any_of(
            ids.begin(), ids.end(), [&](const std::string& id) { return matches(pattern, id); });
        if (isThere) continue;
        const std::string suggestion = didYouMean(pattern, ids);
        throw ConfigError(fmt::format("there is no case '{}'{} The cases are {}.", pattern,
                                      suggestion.empty() ? "." : suggestion, joinNames(ids)));
    }
    std::vector<Case> selected;
    for (const Case& c : suite.cases()) {
        const bool isRequested =
            patterns.empty() || std::any_of(patterns.begin(), patterns.end(),
                                            [&](const std::string& p) { return matches(p, c.id); });
        if (isRequested) selected.push_back(c);
    }
    return selected;
}

}  // namespace kaustik::numerics
