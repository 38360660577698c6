// SPDX-License-Identifier: MIT
#include "framework/judge/judge.h"

#include <algorithm>
#include <cmath>

#include "framework/judge/acceptance.h"
#include "framework/judge/alignment.h"
#include "framework/judge/causes.h"
#include "framework/judge/class_verdicts.h"
#include "framework/judge/colour.h"
#include "framework/judge/comparison.h"
#include "framework/judge/findings.h"
#include "framework/judge/fitting.h"
#include "framework/judge/placement.h"
#include "framework/judge/residual.h"
#include "framework/judge/view.h"
#include "framework/judge/weights.h"

namespace kaustik::judge {
namespace {

// The light and what the choices add to it; of the classes each is there already.
Solution solve(const Comparison& comparison, const std::vector<Choice>& choices) {
    std::vector<std::size_t> columns = columnsOf(comparison, {Role::direct, Role::lightClass});
    for (const Choice& choice : choices) {
        const Role role = choice.candidate.role;
        if (role == Role::lightClass || role == Role::allClasses) continue;
        columns.insert(columns.end(), choice.candidate.columns.begin(),
                       choice.candidate.columns.end());
    }
    Solution solution;
    solution.fitted = fit(comparison, columns);
    solution.covariance = covarianceOf(comparison, solution.fitted);
    for (const Choice& choice : choices) {
        const Candidate& candidate = choice.candidate;
        if (candidate.role != Role::cause ||
            comparison.subject.causes[candidate.index].kind != CauseKind::whole)
            continue;
        const std::size_t column = candidate.columns.front();
        const std::size_t place = placeOf(solution.fitted, column);
        const double error = std::sqrt(std::max(solution.covariance.at(place, place), 0.0));
        if (!solution.fitted.isDropped[place] && error < kMaxError) continue;
        // Classes of free strength can make up for it; by itself it was found to be made, which a
        // mistake is as a whole.
        std::vector<std::size_t> others = columns;
        std::erase(others, column);
        solution.fitted =
            fitBeside(comparison, others, column, coefficientOf(fit(comparison, {0, column}), 0));
        solution.covariance = covarianceOf(comparison, solution.fitted);
        break;
    }
    return solution;
}

Verdict verdictOf(const Comparison& comparison, const Evidence& evidence) {
    Verdict verdict;
    verdict.scene = comparison.subject.scene;
    verdict.theirs = comparison.subject.theirsName;
    verdict.registration = comparison.registration;
    verdict.encoding = comparison.encoding;
    verdict.primaries = comparison.primaries;
    verdict.otherPrimaries = evidence.otherPrimaries;
    verdict.hasDirect = comparison.hasDirect;
    verdict.glassIsHidden = comparison.glassIsHidden;
    verdict.exposure = evidence.exposure.ofTheirs;
    verdict.exposureError = evidence.exposure.errorOfTheirs;
    verdict.exposureBy = evidence.exposure.source;
    verdict.blurPixels = comparison.blurPixels;
    verdict.classes = evidence.classes;
    verdict.explainedShare = evidence.explainedShare;
    verdict.findings = findingsOf(comparison, evidence);
    setResidual(comparison, evidence.solution.fitted, evidence.exposure, verdict);
    return verdict;
}

}  // namespace

Verdict judge(const Subject& subject, const JudgeOptions& options) {
    Comparison comparison = comparisonOf(subject, options);
    Evidence evidence;
    const Image model = registerPictures(comparison);
    evidence.encodingScores = decideEncoding(comparison);
    static_cast<void>(decidePrimaries(comparison));
    requireNotCutOff(comparison, model);
    if (options.glass == Glass::automatic) decideGlass(comparison);
    requireCaustic(comparison.subject, comparison.counted);
    decideDirect(comparison);
    evidence.placementError = refinePlacement(comparison);
    // Where it lies better, and beyond glass that is seen, there may be more to tell them by.
    const Primaries before = comparison.primaries;
    evidence.otherPrimaries = decidePrimaries(comparison);
    if (comparison.primaries != before) evidence.placementError = refinePlacement(comparison);
    weighByNoise(comparison);
    decideBlur(comparison);
    weighByNoise(comparison);
    evidence.explainedShare = requireSameView(comparison);
    weighByNoise(comparison);
    evidence.choices = selectCauses(comparison);
    evidence.solution = solve(comparison, evidence.choices);
    evidence.exposure = exposureOf(comparison, evidence.solution);
    evidence.classes = classVerdictsOf(comparison, evidence.solution, evidence.exposure);
    return verdictOf(comparison, evidence);
}

}  // namespace kaustik::judge
