// SPDX-License-Identifier: MIT
// Weighted least squares with few columns and many rows, some coefficients not below 0, by its
// normal equations: any subset of the columns is then fitted without another look at the rows.
#pragma once

#include <cstddef>
#include <vector>

namespace kaustik::judge {

// A square, symmetric matrix.
class Symmetric {
  public:
    Symmetric() = default;
    explicit Symmetric(std::size_t size) : size_(size), values_(size * size, 0.0) {}
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] double& at(std::size_t row, std::size_t column) {
        return values_[row * size_ + column];
    }
    [[nodiscard]] double at(std::size_t row, std::size_t column) const {
        return values_[row * size_ + column];
    }

  private:
    std::size_t size_ = 0;
    std::vector<double> values_;
};

struct NormalEquations {
    Symmetric matrix;           // sum over rows of weight x_j x_k
    std::vector<double> right;  // of weight x_j y
    double squares = 0.0;       // of weight y²
    std::size_t rows = 0;

    NormalEquations() = default;
    explicit NormalEquations(std::size_t columns) : matrix(columns), right(columns, 0.0) {}
};

struct LinearFit {
    std::vector<std::size_t> columns;  // that were fitted
    std::vector<double> values;        // one each
    Symmetric inverse;                 // of the matrix of those that are not held at 0
    std::vector<bool> isHeld;          // at 0, since it would be negative, or as the next
    // Those that 64 bits do not tell from the ones before them, and those that are 0.
    std::vector<bool> isDropped;
    double chiSquared = 0.0;

    [[nodiscard]] bool isSolved() const;  // nothing was dropped
};

// Minimises the weighted squares over the columns; those of which `isPositive` (by column of the
// whole) are not below 0, by an active set (Lawson and Hanson 1974, chapter 23).
[[nodiscard]] LinearFit fitColumns(const NormalEquations& equations,
                                   const std::vector<std::size_t>& columns,
                                   const std::vector<bool>& isPositive);

}  // namespace kaustik::judge
