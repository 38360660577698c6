// SPDX-License-Identifier: MIT
#include "framework/judge/placement.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>

#include "framework/judge/alignment.h"
#include "framework/judge/fitting.h"
#include "framework/judge/weights.h"

namespace kaustik::judge {
namespace {

// The rounds usually end earlier, by steps below the last two, a fifth and a fifteenth of what is
// spoken of.
constexpr int kMaxRounds = 8;
// A derivative by differences of neighbours reaches no farther, and at the edge of a picture of 100
// pixels a scale moves as much.
constexpr double kMaxShiftStep = 1.5;  // pixels
constexpr double kMaxScaleStep = 0.03;
constexpr double kMinShiftStep = 0.01;
constexpr double kMinScaleStep = 1e-4;
// Coefficients of the light that are smaller say that other columns have taken its place.
constexpr double kMinLight = 0.2;
// A shift that is nearer to halves of a pixel is one, or within two standard errors: what the
// interpolation between pixels biases a shift by.
constexpr double kMaxFromHalf = 0.06;  // pixels
// Halves of a pixel without any mistake are believed where they explain this share of what the best
// place does with all of them.
constexpr double kEqualGain = 0.9;
// A place is another one where less than this share of the loss is left there: four parameters
// lower it by less than that even where all that is left is a mistake in the light.
constexpr double kMaxLossOfMove = 0.85;

// How little their picture is like any mixture of some columns, as it is registered.
double lossOfPlacement(Comparison& comparison, std::initializer_list<Role> roles) {
    align(comparison);
    weighByLight(comparison);
    comparison.plainWeight = comparison.weight;
    double loss = 0.0;
    for (int round = 0; round < 3; ++round) {
        makeEquations(comparison);
        loss = reweighFarOff(comparison, fit(comparison, columnsOf(comparison, roles)));
    }
    return loss;
}

constexpr std::initializer_list<Role> kLight = {Role::direct, Role::lightClass, Role::fill};
constexpr std::initializer_list<Role> kEverything = {Role::direct, Role::lightClass, Role::cause,
                                                     Role::fill};

// A step of Gauss and Newton: the fitted derivatives of the light, in units of the light.
struct Step {
    glm::dvec2 shift{0.0};
    double scale = 0.0;
    PlacementError error;
};

std::optional<Step> stepOf(Comparison& comparison) {
    align(comparison);
    weighByLight(comparison);
    comparison.plainWeight = comparison.weight;
    makeEquations(comparison);
    static_cast<void>(reweighFarOff(
        comparison, fit(comparison, columnsOf(comparison, {Role::direct, Role::lightClass,
                                                           Role::cause, Role::fill}))));
    makeEquations(comparison);
    const std::vector<std::size_t> columns = columnsOf(
        comparison,
        {Role::direct, Role::lightClass, Role::shiftX, Role::shiftY, Role::scale, Role::fill});
    std::vector<std::size_t> more = columns;
    for (const std::size_t cause : columnsOf(comparison, {Role::cause}))
        more.push_back(cause);
    LinearFit fitted = fit(comparison, more);
    if (!fitted.isSolved()) fitted = fit(comparison, columns);
    if (!fitted.isSolved()) return std::nullopt;
    const Symmetric covariance = covarianceOf(comparison, fitted);
    // Where other columns take the light's place, nothing is known of where it lies.
    if (lightOf(comparison, fitted) < kMinLight) return std::nullopt;
    // Coefficients of derivatives are steps where those of the light are 1.
    const double light = std::max(lightOf(comparison, fitted), 1e-6);
    const auto derivative = [&](Role role, double& deviation) {
        const std::size_t place = placeOf(fitted, columnsOf(comparison, {role}).front());
        deviation = std::sqrt(std::max(covariance.at(place, place), 0.0)) / light;
        return fitted.values[place] / light;
    };
    Step step;
    step.shift.x = std::clamp(derivative(Role::shiftX, step.error.shiftPixels.x), -kMaxShiftStep,
                              kMaxShiftStep);
    step.shift.y = std::clamp(derivative(Role::shiftY, step.error.shiftPixels.y), -kMaxShiftStep,
                              kMaxShiftStep);
    step.scale =
        std::clamp(derivative(Role::scale, step.error.scale), -kMaxScaleStep, kMaxScaleStep);
    return step;
}

// Rounds to places that pictures usually have, within the errors.
void roundRegistration(Comparison& comparison, bool isPlain, const PlacementError& error) {
    Registration& registration = comparison.registration;
    const double usual = usualScale(comparison);
    const auto isNothing = [](double value, double limit, double deviation) {
        return std::abs(value) < std::max(limit, kSignificantErrors * deviation);
    };
    if (isNothing(registration.scale / usual - 1.0, kMinScale, error.scale))
        registration.scale = usual;
    if (isNothing(registration.scale - 1.0, kMinScale, error.scale)) registration.scale = 1.0;
    for (glm::length_t axis = 0; axis < 2; ++axis) {
        double& shift = registration.shift[axis];
        if (isPlain && isNothing(shift, kMinShiftPixels, error.shiftPixels[axis])) shift = 0.0;
        // Halves of a pixel are conventions, and whole ones need no interpolation.
        const double half = 0.5 * std::round(2.0 * shift);
        if (std::abs(shift - half) < std::max(kMaxFromHalf, 2.0 * error.shiftPixels[axis]) &&
            half != 0.0)
            shift = half;
    }
}

// Where a picture lies as it should, only what is better by much is another place.
void preferPlain(Comparison& comparison, const Registration& before, bool isPlain) {
    Registration& registration = comparison.registration;
    const double usual = usualScale(comparison);
    Registration plain;
    plain.isFlippedX = registration.isFlippedX;
    plain.isFlippedY = registration.isFlippedY;
    plain.scale = usual;
    plain.correlation = registration.correlation;
    if (isPlain && before.scale == usual &&
        (registration.shift != glm::dvec2(0.0) || registration.scale != usual)) {
        const Registration refined = registration;
        const double loss = lossOfPlacement(comparison, kEverything);
        registration = plain;
        if (loss < kMaxLossOfMove * lossOfPlacement(comparison, kEverything))
            registration = refined;
    }
}

// A shift and many mistakes together can do what a shift by half a pixel does alone, where the
// picture is small or its light even: the simpler one is taken.
void preferHalves(Comparison& comparison, bool isPlain) {
    Registration& registration = comparison.registration;
    if (!isPlain || registration.scale != usualScale(comparison)) return;
    const Registration refined = registration;
    const glm::dvec2 halves = 0.5 * glm::round(2.0 * refined.shift);
    if (halves == refined.shift || halves == glm::dvec2(0.0)) return;
    const double best = lossOfPlacement(comparison, kEverything);
    registration.shift = glm::dvec2(0.0);
    const double plain = lossOfPlacement(comparison, kLight);
    registration.shift = halves;
    const double moved = lossOfPlacement(comparison, kLight);
    if (plain - moved < kEqualGain * (plain - best)) registration = refined;
}

}  // namespace

PlacementError refinePlacement(Comparison& comparison) {
    const Registration before = comparison.registration;
    const bool isPlain = before.shift == glm::dvec2(0.0);
    makeColumns(comparison, true);
    PlacementError error;
    for (int round = 0; round < kMaxRounds; ++round) {
        const std::optional<Step> step = stepOf(comparison);
        if (!step) break;
        error = step->error;
        Registration& registration = comparison.registration;
        registration.shift -= registration.scale * step->shift;
        registration.scale *= 1.0 - step->scale;
        if (std::abs(step->shift.x) + std::abs(step->shift.y) < kMinShiftStep &&
            std::abs(step->scale) < kMinScaleStep)
            break;
    }
    roundRegistration(comparison, isPlain, error);
    preferHalves(comparison, isPlain);
    preferPlain(comparison, before, isPlain);
    align(comparison);
    return error;
}

bool isMoved(const Comparison& comparison) {
    return comparison.registration.shift != glm::dvec2(0.0) ||
           comparison.registration.scale != usualScale(comparison);
}

}  // namespace kaustik::judge
