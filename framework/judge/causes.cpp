// SPDX-License-Identifier: MIT
#include "framework/judge/causes.h"

#include <algorithm>
#include <cmath>

#include "framework/judge/class_verdicts.h"
#include "framework/judge/fitting.h"
#include "framework/judge/pictures.h"
#include "framework/judge/placement.h"
#include "framework/judge/sentences.h"
#include "framework/judge/significance.h"

namespace kaustik::judge {
namespace {

// A picture with more mistakes than this is another one.
constexpr int kMaxCauses = 6;
// Of nested models the larger one is believed where chi squared falls by more than chance would
// have it, in units of what no mixture explains of one value: the likelihood ratio's test, with
// Šidák's correction for the number of candidates. The chance that any is taken by chance:
constexpr double kFalseAlarmRate = 0.01;
// That takes what is left for noise. What is left of a picture with a mistake that nobody has
// thought of is none, and any column explains a percent of it: so much more must be explained.
constexpr double kMinGain = 0.03;
// One that explains this share of what the best one does explains it as well.
constexpr double kEqualGain = 0.9;
// An even light on receivers is spoken of from this share of all light.
constexpr double kMinFill = 0.005;
// A whole cause was made where its coefficient is about 1.
constexpr double kMinWhole = 0.5;
constexpr double kMaxWhole = 1.5;

// Pictures of the same cause in the same direction are one candidate: what lies between two is
// a mixture of them.
void addCause(const Comparison& comparison, std::size_t column, std::vector<Candidate>& all) {
    const std::size_t index = comparison.columns[column].index;
    const Cause& cause = comparison.subject.causes[index];
    const double step = cause.kind == CauseKind::amount ? cause.amount : 1.0;
    for (Candidate& other : all) {
        if (other.role != Role::cause ||
            comparison.subject.causes[other.index].name != cause.name ||
            other.steps.front() * step < 0.0)
            continue;
        other.columns.push_back(column);
        other.steps.push_back(step);
        return;
    }
    all.push_back({{column}, Role::cause, index, {step}});
}

std::vector<Candidate> candidatesOf(const Comparison& comparison) {
    std::vector<Candidate> all;
    for (std::size_t i = 0; i < comparison.columns.size(); ++i) {
        const Column& column = comparison.columns[i];
        const Candidate alone{{i}, column.role, column.index, {1.0}};
        // What was registered is not asked for again.
        const bool isPlace = column.role == Role::shiftX || column.role == Role::scale;
        if (isPlace && isMoved(comparison)) continue;
        switch (column.role) {
            case Role::allClasses:
            case Role::scale:
            case Role::fill:
                all.push_back(alone);
                break;
            case Role::cause:
                addCause(comparison, i, all);
                break;
            case Role::lightClass:
                if (comparison.hasDirect || comparison.subject.classes.size() > 1)
                    all.push_back(alone);
                break;
            case Role::shiftX:
                all.push_back({{i, i + 1}, column.role, 0, {1.0, 1.0}});
                break;
            default:
                break;
        }
    }
    return all;
}

struct Trial {
    double gain = 0.0;  // of chi squared
    bool isNotable = false;
    std::vector<double> amounts;  // with the light's coefficient as 1
};

// Whether it is large enough to be spoken of.
bool isNotable(const Comparison& comparison, const Candidate& candidate,
               const std::vector<double>& amounts) {
    const double amount = std::abs(amounts.front());
    switch (candidate.role) {
        case Role::lightClass:
        case Role::allClasses:
            return amount > kCoefficientTolerance;
        case Role::shiftX:
            return std::hypot(amounts[0], amounts[1]) > kMinShiftPixels;
        case Role::scale:
            return amount > kMinScale;
        case Role::fill:
            return amount * total(comparison.subject.fill, comparison.counted) >
                   kMinFill * total(comparison.columns.front().image, comparison.counted);
        default: {
            const Cause& cause = comparison.subject.causes[candidate.index];
            return cause.kind == CauseKind::whole
                       ? amounts.front() > kMinWhole && amounts.front() < kMaxWhole
                       : amount > cause.least;
        }
    }
}

// What it explains together with those that are selected, that leave `before`.
Trial trialOf(const Comparison& comparison, const std::vector<std::size_t>& selected, double before,
              const Candidate& candidate) {
    std::vector<std::size_t> columns = selected;
    columns.insert(columns.end(), candidate.columns.begin(), candidate.columns.end());
    const LinearFit fitted = fit(comparison, columns);
    Trial trial;
    if (!fitted.isSolved()) return trial;
    trial.gain = before - fitted.chiSquared;
    const double light = std::max(coefficientOf(fitted, 0), 1e-9);
    for (const std::size_t column : candidate.columns)
        trial.amounts.push_back(coefficientOf(fitted, column) / light);
    if (candidate.role == Role::cause) {
        trial.amounts.front() *= candidate.steps.front();
        for (std::size_t i = 1; i < candidate.steps.size(); ++i)
            trial.amounts.front() += candidate.steps[i] * trial.amounts[i];
    }
    trial.isNotable = isNotable(comparison, candidate, trial.amounts);
    return trial;
}

// What no mixture of causes explains of one value: the unit of what is significant. `first` is chi
// squared of the whole alone.
double unexplainedUnit(const Comparison& comparison, double first) {
    std::vector<std::size_t> everything = columnsOf(
        comparison,
        {Role::direct, Role::lightClass, Role::cause, Role::shiftX, Role::shiftY, Role::fill});
    if (!comparison.hasDirect) {
        // The whole is the sum of its classes.
        everything = columnsOf(
            comparison, {Role::lightClass, Role::cause, Role::shiftX, Role::shiftY, Role::fill});
    }
    const LinearFit best = fit(comparison, everything);
    return std::max(1.0, (best.isSolved() ? best.chiSquared : first) /
                             std::max(static_cast<double>(comparison.equations.rows), 1.0));
}

}  // namespace

std::vector<Choice> selectCauses(Comparison& comparison) {
    makeEquations(comparison);
    std::vector<std::size_t> selected = {0};
    std::vector<Candidate> open = candidatesOf(comparison);
    const double first = fit(comparison, selected).chiSquared;
    const double unit = unexplainedUnit(comparison, first);
    std::vector<Choice> choices;
    double now = first;
    for (int round = 0; round < kMaxCauses && !open.empty(); ++round) {
        std::vector<Trial> trials;
        std::size_t chosen = open.size();
        for (const Candidate& candidate : open) {
            trials.push_back(trialOf(comparison, selected, now, candidate));
            if (!trials.back().isNotable) continue;
            if (chosen == open.size() || trials.back().gain > trials[chosen].gain)
                chosen = trials.size() - 1;
        }
        if (chosen == open.size()) break;
        const double gain = trials[chosen].gain;
        const double critical =
            criticalChiSquared(chanceOfEach(kFalseAlarmRate, static_cast<double>(open.size())),
                               open[chosen].columns.size());
        if (gain < kMinGain * now || gain < critical * unit) break;
        Choice choice{open[chosen], {}};
        for (std::size_t i = 0; i < open.size(); ++i) {
            if (i != chosen && trials[i].isNotable && trials[i].gain >= kEqualGain * gain)
                choice.also.push_back(sentenceOf(comparison, open[i], trials[i].amounts, {}));
        }
        selected.insert(selected.end(), open[chosen].columns.begin(), open[chosen].columns.end());
        choices.push_back(std::move(choice));
        now = fit(comparison, selected).chiSquared;
        open.erase(open.begin() + static_cast<std::ptrdiff_t>(chosen));
    }
    return choices;
}

}  // namespace kaustik::judge
