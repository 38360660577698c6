// SPDX-License-Identifier: MIT
#include "framework/judge/comparison.h"

#include <algorithm>
#include <cmath>

#include "framework/judge/acceptance.h"
#include "framework/judge/pictures.h"

namespace kaustik::judge {
namespace {

// Blurred as irradiance, so that the colours of receivers stay sharp. `power` is 1 of radiance, and
// 2 of its variance, which falls by the blur: what is not taken off it would speak for any blur.
Image blurredLight(const Comparison& comparison, const Image& radiance, int power) {
    if (!(comparison.blurPixels > 0.0) || isEmpty(radiance)) return radiance;
    Image irradiance(radiance.width, radiance.height, 3);
    Image weight(radiance.width, radiance.height, 3);
    const auto fillAt = [&](std::size_t i) {
        const float fill = comparison.subject.fill.values[i];
        return power == 2 ? fill * fill : fill;
    };
    for (std::size_t i = 0; i < radiance.values.size(); ++i) {
        if (!(fillAt(i) > 0.0f) || comparison.subject.mask.values[i / 3] < 0.5f) continue;
        irradiance.values[i] = radiance.values[i] / fillAt(i);
        weight.values[i] = 1.0f;
    }
    irradiance = power == 2 ? blurredVariance(irradiance, comparison.blurPixels)
                            : blurred(irradiance, comparison.blurPixels);
    weight = blurred(weight, comparison.blurPixels);
    Image result(radiance.width, radiance.height, 3);
    for (std::size_t i = 0; i < radiance.values.size(); ++i) {
        const float whole = power == 2 ? weight.values[i] * weight.values[i] : weight.values[i];
        if (whole > 0.0f) result.values[i] = fillAt(i) * irradiance.values[i] / whole;
    }
    return result;
}

Image blurredError(const Comparison& comparison, const Image& error) {
    if (!(comparison.blurPixels > 0.0)) return error;
    Image variance = error;
    for (float& value : variance.values)
        value *= value;
    variance = blurredLight(comparison, variance, 2);
    for (float& value : variance.values)
        value = std::sqrt(value);
    return variance;
}

Image quadraticSum(const std::vector<Image>& errors) {
    Image result;
    for (const Image& error : errors) {
        if (isEmpty(error)) continue;
        if (isEmpty(result)) result = Image(error.width, error.height, error.channels);
        for (std::size_t i = 0; i < result.values.size(); ++i)
            result.values[i] = std::hypot(result.values[i], error.values[i]);
    }
    return result;
}

}  // namespace

Comparison comparisonOf(Subject subject, const JudgeOptions& options) {
    Comparison comparison;
    comparison.theirs = threeChannels(subject.theirs);
    comparison.options = options;
    requireNumbers(comparison.theirs, subject.theirsName);
    requireCaustic(subject, subject.mask);
    joinFaintClasses(subject);
    comparison.clear = subject.mask;
    for (std::size_t i = 0; i < comparison.clear.values.size(); ++i) {
        if (subject.hasGlass.values[i] > 0.5f) comparison.clear.values[i] = 0.0f;
    }
    comparison.hasDirect = options.direct != DirectLight::without && !isEmpty(subject.direct);
    comparison.counted = options.glass == Glass::seen ? comparison.clear : subject.mask;
    comparison.glassIsHidden = options.glass == Glass::hidden;
    comparison.subject = std::move(subject);
    return comparison;
}

void makeColumns(Comparison& comparison, bool withCauses) {
    comparison.columns.clear();
    comparison.hasCauseColumns = withCauses;
    const glm::dvec2 by = comparison.columnShift;
    std::vector<Image> classes;
    std::vector<Image> errors;
    for (const Light& light : comparison.subject.classes) {
        classes.push_back(movedBy(blurredLight(comparison, light.radiance, 1), by));
        errors.push_back(blurredError(comparison, light.error));
    }
    std::vector<const Image*> parts;
    for (const Image& image : classes)
        parts.push_back(&image);
    Image all = sum(parts);
    Image allError = quadraticSum(errors);
    Image direct = comparison.hasDirect ? movedBy(comparison.subject.direct, by) : Image();
    Image model = comparison.hasDirect ? sum({&direct, &all}) : all;
    Image dx = derivativeX(model);
    Image dy = derivativeY(model);
    Image scale = derivativeScale(model);
    comparison.columns.push_back({Role::total, 0, std::move(model), allError});
    if (comparison.hasDirect) {
        comparison.columns.push_back({Role::direct, 0, std::move(direct), {}});
        comparison.columns.push_back({Role::allClasses, 0, std::move(all), std::move(allError)});
    }
    for (std::size_t k = 0; k < classes.size(); ++k) {
        comparison.columns.push_back(
            {Role::lightClass, k, std::move(classes[k]), std::move(errors[k])});
    }
    comparison.columns.push_back({Role::shiftX, 0, std::move(dx), {}});
    comparison.columns.push_back({Role::shiftY, 0, std::move(dy), {}});
    comparison.columns.push_back({Role::scale, 0, std::move(scale), {}});
    comparison.columns.push_back({Role::fill, 0, movedBy(comparison.subject.fill, by), {}});
    for (std::size_t k = 0; withCauses && k < comparison.subject.causes.size(); ++k) {
        comparison.columns.push_back(
            {Role::cause, k,
             movedBy(blurredLight(comparison, comparison.subject.causes[k].radiance, 1), by),
             blurredError(comparison, comparison.subject.causes[k].error)});
    }
}

std::vector<std::size_t> columnsOf(const Comparison& comparison,
                                   std::initializer_list<Role> roles) {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < comparison.columns.size(); ++i) {
        if (std::find(roles.begin(), roles.end(), comparison.columns[i].role) != roles.end())
            result.push_back(i);
    }
    return result;
}

std::size_t brightestColumn(const Comparison& comparison) {
    std::size_t brightest = columnsOf(comparison, {Role::lightClass}).front();
    double greatest = -1.0;
    for (const std::size_t column : columnsOf(comparison, {Role::lightClass})) {
        const double light = total(comparison.columns[column].image, comparison.counted);
        if (light > greatest) brightest = column;
        greatest = std::max(greatest, light);
    }
    return brightest;
}

Image modelOf(const Comparison& comparison, bool withDirect) {
    std::vector<const Image*> parts;
    if (withDirect) parts.push_back(&comparison.subject.direct);
    for (const Light& light : comparison.subject.classes)
        parts.push_back(&light.radiance);
    return sum(parts);
}

double usualScale(const Comparison& comparison) {
    return static_cast<double>(comparison.theirs.height) / comparison.columns.front().image.height;
}

}  // namespace kaustik::judge
