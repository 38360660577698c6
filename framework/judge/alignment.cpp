// SPDX-License-Identifier: MIT
#include "framework/judge/alignment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/core/error.h"
#include "framework/judge/fitting.h"
#include "framework/judge/pictures.h"
#include "framework/judge/primaries.h"
#include "framework/judge/weights.h"

namespace kaustik::judge {
namespace {

// Below this the two pictures have nothing in common: the best of some thousand placements of other
// scenes' pictures on `concave-glass` has 0.28. What is above it may still be refused once it is
// fitted (view.h).
constexpr double kMinCorrelation = 0.4;
// Another registration must correlate by this much more: with a cause's light, or without the
// direct light, and then by this much at least.
constexpr double kMinGainOfCause = 0.01;
constexpr double kMinGainWithoutDirect = 0.15;
constexpr double kMinCausticCorrelation = 0.7;
// Pixels behind glass that differ by less than this share of their light show no glass.
constexpr double kMaxDifferenceBehindGlass = 0.35;
// Less than this share of the direct light that is expected is none.
constexpr double kMinDirectShare = 0.1;

// Has the columns moved by half of what is not a whole pixel, where pixels are as large.
void shareShift(Comparison& comparison) {
    const Registration& registration = comparison.registration;
    glm::dvec2 by(0.0);
    if (registration.scale == 1.0) by = 0.5 * (registration.shift - glm::round(registration.shift));
    if (by != comparison.columnShift) {
        comparison.columnShift = by;
        makeColumns(comparison, comparison.hasCauseColumns);
    }
    if (by == glm::dvec2(0.0)) return;
    // A pixel counts where both do that it lies between.
    const Image counted = comparison.counted;
    const int dx = by.x > 0.0 ? -1 : by.x < 0.0 ? 1 : 0;
    const int dy = by.y > 0.0 ? -1 : by.y < 0.0 ? 1 : 0;
    for (int y = 0; y < counted.height; ++y) {
        for (int x = 0; x < counted.width; ++x) {
            const int column = std::clamp(x + dx, 0, counted.width - 1);
            const int row = std::clamp(y + dy, 0, counted.height - 1);
            if (counted.at(column, y, 0) < 0.5f || counted.at(x, row, 0) < 0.5f ||
                counted.at(column, row, 0) < 0.5f)
                comparison.counted.at(x, y, 0) = 0.0f;
        }
    }
}

}  // namespace

void align(Comparison& comparison) {
    comparison.counted = comparison.glassIsHidden || comparison.options.glass == Glass::automatic
                             ? comparison.subject.mask
                             : comparison.clear;
    if (comparison.isGlassDecided && !comparison.glassIsHidden)
        comparison.counted = comparison.clear;
    const glm::dmat3 primaries = toRec709(comparison.primaries);
    const Image linear = transformed(decoded(comparison.theirs, comparison.encoding), primaries);
    shareShift(comparison);
    Registration registration = comparison.registration;
    registration.shift -= comparison.columnShift;
    comparison.picture =
        resampled(linear, registration, comparison.columns.front().image, comparison.counted);
    // Near to the reference's units, so that coefficients are near 1.
    const double ours = total(comparison.columns.front().image, comparison.counted);
    const double light = total(comparison.picture, comparison.counted);
    comparison.firstExposure = light > 0.0 && ours > 0.0 ? light / ours : 1.0;
    for (float& value : comparison.picture.values)
        value = static_cast<float>(static_cast<double>(value) / comparison.firstExposure);
    comparison.theirsError = Image();
    if (!isEmpty(comparison.subject.theirsError)) {
        Image ignored = comparison.counted;
        comparison.theirsError =
            resampled(transformedError(threeChannels(comparison.subject.theirsError), primaries),
                      registration, comparison.columns.front().image, ignored);
        for (float& value : comparison.theirsError.values)
            value = static_cast<float>(static_cast<double>(value) / comparison.firstExposure);
    }
}

Image registerPictures(Comparison& comparison) {
    makeColumns(comparison, false);
    Image model = modelOf(comparison, comparison.hasDirect);
    comparison.registration = findRegistration(comparison.theirs, model, comparison.counted);
    // A mistake that changes all of a caustic is no other way up.
    for (const Cause& cause : comparison.subject.causes) {
        if (cause.kind != CauseKind::whole) continue;
        const Registration other =
            findRegistration(comparison.theirs, sum({&model, &cause.radiance}), comparison.counted);
        if (other.correlation > comparison.registration.correlation + kMinGainOfCause)
            comparison.registration = other;
    }
    // Without the direct light that was thought to be there they may be the same.
    if (comparison.hasDirect && comparison.options.direct == DirectLight::automatic) {
        const Image caustics = modelOf(comparison, false);
        const Registration other =
            findRegistration(comparison.theirs, caustics, comparison.counted);
        if (other.correlation > kMinCausticCorrelation &&
            other.correlation > comparison.registration.correlation + kMinGainWithoutDirect) {
            comparison.registration = other;
            comparison.hasDirect = false;
            model = caustics;
            makeColumns(comparison, false);
        }
    }
    if (comparison.registration.correlation < kMinCorrelation) {
        throw ConfigError(fmt::format(
            "{} does not show {} from its camera: however it is turned, moved and scaled, it "
            "is no more like the reference than a correlation of {:.2f}.",
            comparison.subject.theirsName, comparison.subject.scene,
            comparison.registration.correlation));
    }
    return model;
}

void decideGlass(Comparison& comparison) {
    const double glass = pixelCount(comparison.counted) - pixelCount(comparison.clear);
    comparison.isGlassDecided = true;
    comparison.glassIsHidden = true;
    if (glass > 0.0) {
        weighByLight(comparison);
        makeEquations(comparison);
        const Image prediction = predictionOf(
            comparison, fit(comparison, columnsOf(comparison, {Role::direct, Role::lightClass,
                                                               Role::shiftX, Role::shiftY})));
        double difference = 0.0;
        double light = 0.0;
        for (std::size_t i = 0; i < comparison.picture.values.size(); ++i) {
            if (comparison.counted.values[i / 3] < 0.5f || comparison.clear.values[i / 3] > 0.5f)
                continue;
            difference +=
                std::abs(static_cast<double>(comparison.picture.values[i] - prediction.values[i]));
            light += static_cast<double>(prediction.values[i]);
        }
        comparison.glassIsHidden = difference < kMaxDifferenceBehindGlass * light;
    }
    align(comparison);
}

void decideDirect(Comparison& comparison) {
    if (!comparison.hasDirect || comparison.options.direct != DirectLight::automatic) return;
    weighByLight(comparison);
    makeEquations(comparison);
    const LinearFit fitted =
        fit(comparison, columnsOf(comparison, {Role::direct, Role::lightClass}));
    const double direct = coefficientOf(fitted, columnsOf(comparison, {Role::direct}).front());
    // Classes of little light may have any coefficient: what counts is the light.
    const double there = direct * total(comparison.subject.direct, comparison.counted) /
                         total(comparison.picture, comparison.counted);
    const double expected = total(comparison.subject.direct, comparison.counted) /
                            total(comparison.columns.front().image, comparison.counted);
    if (there > kMinDirectShare * expected) return;
    comparison.hasDirect = false;
    makeColumns(comparison, false);
    align(comparison);
}

}  // namespace kaustik::judge
