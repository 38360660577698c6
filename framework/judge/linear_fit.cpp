// SPDX-License-Identifier: MIT
#include "framework/judge/linear_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

namespace kaustik::judge {
namespace {

// Of a matrix that is positive definite, by its Cholesky factor; where it is not, to rounding, the
// first column that is not. Columns are scaled to the same size first, as their units differ.
std::variant<Symmetric, std::size_t> inverseOf(const Symmetric& matrix) {
    const std::size_t n = matrix.size();
    std::vector<double> scale(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (!(matrix.at(i, i) > 0.0)) return i;
        scale[i] = 1.0 / std::sqrt(matrix.at(i, i));
    }
    constexpr double kSmallest = 1e-11;
    Symmetric lower(n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = matrix.at(i, j) * scale[i] * scale[j];
            for (std::size_t k = 0; k < j; ++k)
                sum -= lower.at(i, k) * lower.at(j, k);
            if (i == j && !(sum > kSmallest)) return i;
            lower.at(i, j) = i == j ? std::sqrt(sum) : sum / lower.at(j, j);
        }
    }
    Symmetric inverse(n);
    std::vector<double> column(n);
    for (std::size_t c = 0; c < n; ++c) {
        for (std::size_t i = 0; i < n; ++i) {
            double sum = i == c ? 1.0 : 0.0;
            for (std::size_t k = 0; k < i; ++k)
                sum -= lower.at(i, k) * column[k];
            column[i] = sum / lower.at(i, i);
        }
        for (std::size_t i = n; i-- > 0;) {
            double sum = column[i];
            for (std::size_t k = i + 1; k < n; ++k)
                sum -= lower.at(k, i) * column[k];
            column[i] = sum / lower.at(i, i);
        }
        for (std::size_t i = 0; i < n; ++i)
            inverse.at(i, c) = column[i] * scale[i] * scale[c];
    }
    return inverse;
}

Symmetric part(const Symmetric& matrix, const std::vector<std::size_t>& columns) {
    Symmetric result(columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i) {
        for (std::size_t j = 0; j < columns.size(); ++j)
            result.at(i, j) = matrix.at(columns[i], columns[j]);
    }
    return result;
}

// Solves for the columns that are not held, and says what of those is most negative.
std::optional<std::size_t> solveFree(const NormalEquations& equations,
                                     const std::vector<bool>& isPositive, LinearFit& fit) {
    std::vector<std::size_t> free;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < fit.columns.size(); ++i) {
        fit.values[i] = 0.0;
        if (fit.isHeld[i]) continue;
        free.push_back(fit.columns[i]);
        places.push_back(i);
    }
    const auto found = inverseOf(part(equations.matrix, free));
    if (const auto* const dropped = std::get_if<std::size_t>(&found)) {
        fit.isDropped[places[*dropped]] = true;
        fit.isHeld[places[*dropped]] = true;
        return solveFree(equations, isPositive, fit);
    }
    const Symmetric* const inverse = std::get_if<Symmetric>(&found);
    fit.inverse = *inverse;
    std::optional<std::size_t> worst;
    for (std::size_t i = 0; i < free.size(); ++i) {
        double value = 0.0;
        for (std::size_t j = 0; j < free.size(); ++j)
            value += inverse->at(i, j) * equations.right[free[j]];
        fit.values[places[i]] = value;
        if (value < 0.0 && isPositive[free[i]] && (!worst || value < fit.values[*worst]))
            worst = places[i];
    }
    return worst;
}

// How the squares fall with a coefficient that is held at 0.
double descentOf(const NormalEquations& equations, const LinearFit& fit, std::size_t held) {
    double descent = equations.right[fit.columns[held]];
    for (std::size_t j = 0; j < fit.columns.size(); ++j)
        descent -= equations.matrix.at(fit.columns[held], fit.columns[j]) * fit.values[j];
    return descent;
}

}  // namespace

bool LinearFit::isSolved() const {
    return std::find(isDropped.begin(), isDropped.end(), true) == isDropped.end();
}

LinearFit fitColumns(const NormalEquations& equations, const std::vector<std::size_t>& columns,
                     const std::vector<bool>& isPositive) {
    LinearFit fit;
    fit.columns = columns;
    fit.values.assign(columns.size(), 0.0);
    fit.isHeld.assign(columns.size(), false);
    fit.isDropped.assign(columns.size(), false);
    for (std::size_t round = 0; round < 8 * columns.size() + 8; ++round) {
        if (const auto worst = solveFree(equations, isPositive, fit)) {
            fit.isHeld[*worst] = true;
            continue;
        }
        std::optional<std::size_t> freed;
        for (std::size_t i = 0; i < columns.size() && round < 4 * columns.size(); ++i) {
            const double unit = std::sqrt(equations.matrix.at(columns[i], columns[i]) *
                                          std::max(equations.squares, 1e-300));
            if (fit.isHeld[i] && !fit.isDropped[i] && descentOf(equations, fit, i) > 1e-12 * unit)
                freed = i;
        }
        if (!freed) break;
        fit.isHeld[*freed] = false;
    }
    fit.chiSquared = equations.squares;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        double product = -2.0 * equations.right[columns[i]];
        for (std::size_t j = 0; j < columns.size(); ++j)
            product += equations.matrix.at(columns[i], columns[j]) * fit.values[j];
        fit.chiSquared += fit.values[i] * product;
    }
    fit.chiSquared = std::max(fit.chiSquared, 0.0);
    return fit;
}

}  // namespace kaustik::judge
