// SPDX-License-Identifier: MIT
#include "framework/judge/fitting.h"

#include <algorithm>
#include <cmath>

#include "framework/judge/pictures.h"

namespace kaustik::judge {
namespace {

// The classes are independent of each other; the whole and all of them have their noise.
void addNoise(const Comparison& comparison, std::size_t i, double weight, Symmetric& noise) {
    for (std::size_t j = 0; j < comparison.columns.size(); ++j) {
        if (isEmpty(comparison.columns[j].error)) continue;
        const double own =
            std::pow(static_cast<double>(comparison.columns[j].error.values[i]), 2.0);
        noise.at(j, j) += weight * own;
        for (std::size_t k = 0; k < j; ++k) {
            const bool isShared = (comparison.columns[k].role == Role::total ||
                                   comparison.columns[k].role == Role::allClasses) &&
                                  (comparison.columns[j].role == Role::lightClass ||
                                   comparison.columns[j].role == Role::allClasses);
            if (isShared) noise.at(j, k) += weight * own;
        }
    }
}

// The noise of a column makes its square too large, and its coefficient too small; of a column that
// is little but noise no more than half is taken off.
void removeNoise(const Symmetric& noise, Symmetric& matrix) {
    const std::size_t n = matrix.size();
    std::vector<double> share(n, 0.0);
    for (std::size_t j = 0; j < n; ++j) {
        if (noise.at(j, j) > 0.0)
            share[j] = std::sqrt(std::min(1.0, 0.5 * matrix.at(j, j) / noise.at(j, j)));
    }
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t k = 0; k <= j; ++k) {
            matrix.at(j, k) -= share[j] * share[k] * noise.at(j, k);
            matrix.at(k, j) = matrix.at(j, k);
        }
    }
}

// Light and causes are not below 0.
std::vector<bool> positiveColumns(const Comparison& comparison) {
    std::vector<bool> isPositive;
    for (const Column& column : comparison.columns) {
        isPositive.push_back(column.role == Role::direct || column.role == Role::lightClass ||
                             column.role == Role::total || column.role == Role::cause);
    }
    return isPositive;
}

}  // namespace

void makeEquations(Comparison& comparison) {
    comparison.equations = NormalEquations(comparison.columns.size());
    const std::size_t n = comparison.columns.size();
    std::vector<double> row(n);
    Symmetric noise(n);
    for (std::size_t i = 0; i < comparison.weight.values.size(); ++i) {
        const auto weight = static_cast<double>(comparison.weight.values[i]);
        if (!(weight > 0.0)) continue;
        const auto y = static_cast<double>(comparison.picture.values[i]);
        ++comparison.equations.rows;
        comparison.equations.squares += weight * y * y;
        for (std::size_t j = 0; j < n; ++j) {
            row[j] = static_cast<double>(comparison.columns[j].image.values[i]);
            comparison.equations.right[j] += weight * row[j] * y;
            for (std::size_t k = 0; k <= j; ++k)
                comparison.equations.matrix.at(j, k) += weight * row[j] * row[k];
        }
        addNoise(comparison, i, weight, noise);
    }
    removeNoise(noise, comparison.equations.matrix);
}

LinearFit fit(const Comparison& comparison, const std::vector<std::size_t>& columns) {
    return fitColumns(comparison.equations, columns, positiveColumns(comparison));
}

LinearFit fitBeside(const Comparison& comparison, const std::vector<std::size_t>& columns,
                    std::size_t known, double coefficient) {
    // Of the picture without it.
    NormalEquations equations = comparison.equations;
    const double right = equations.right[known];
    for (std::size_t j = 0; j < equations.right.size(); ++j)
        equations.right[j] -= coefficient * equations.matrix.at(j, known);
    equations.squares -=
        coefficient * (2.0 * right - coefficient * equations.matrix.at(known, known));
    LinearFit fitted = fitColumns(equations, columns, positiveColumns(comparison));
    fitted.columns.push_back(known);
    fitted.values.push_back(coefficient);
    fitted.isHeld.push_back(true);
    fitted.isDropped.push_back(false);
    return fitted;
}

std::size_t placeOf(const LinearFit& fitted, std::size_t column) {
    return static_cast<std::size_t>(
        std::find(fitted.columns.begin(), fitted.columns.end(), column) - fitted.columns.begin());
}

double coefficientOf(const LinearFit& fitted, std::size_t column) {
    for (std::size_t i = 0; i < fitted.columns.size(); ++i) {
        if (fitted.columns[i] == column) return fitted.values[i];
    }
    return 0.0;
}

double lightOf(const Comparison& comparison, const LinearFit& fitted) {
    if (comparison.hasDirect)
        return coefficientOf(fitted, columnsOf(comparison, {Role::direct}).front());
    return coefficientOf(fitted, brightestColumn(comparison));
}

Image predictionOf(const Comparison& comparison, const LinearFit& fitted) {
    Image result(comparison.picture.width, comparison.picture.height, 3);
    for (std::size_t j = 0; j < fitted.columns.size(); ++j) {
        const Image& image = comparison.columns[fitted.columns[j]].image;
        const auto value = static_cast<float>(fitted.values[j]);
        for (std::size_t i = 0; i < result.values.size(); ++i)
            result.values[i] += value * image.values[i];
    }
    return result;
}

}  // namespace kaustik::judge
