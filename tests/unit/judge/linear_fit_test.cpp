// SPDX-License-Identifier: MIT
#include "framework/judge/linear_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace kaustik::judge {
namespace {

NormalEquations equationsOf(const std::vector<std::vector<double>>& rows,
                            const std::vector<double>& right) {
    NormalEquations equations(rows.front().size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        ++equations.rows;
        equations.squares += right[i] * right[i];
        for (std::size_t j = 0; j < rows[i].size(); ++j) {
            equations.right[j] += rows[i][j] * right[i];
            for (std::size_t k = 0; k < rows[i].size(); ++k)
                equations.matrix.at(j, k) += rows[i][j] * rows[i][k];
        }
    }
    return equations;
}

TEST(LinearFit, GivesBackWhatRowsAreMadeOf) {
    const auto equations =
        equationsOf({{1, 2, 0}, {0, 1, 1}, {3, 0, 1}, {1, 1, 1}}, {1 + 4, 2 - 1, 3 - 1, 1 + 2 - 1});
    const LinearFit fit = fitColumns(equations, {0, 1, 2}, {false, false, false});
    ASSERT_TRUE(fit.isSolved());
    EXPECT_NEAR(fit.values[0], 1.0, 1e-12);
    EXPECT_NEAR(fit.values[1], 2.0, 1e-12);
    EXPECT_NEAR(fit.values[2], -1.0, 1e-12);
    EXPECT_NEAR(fit.chiSquared, 0.0, 1e-10);
    // The last one is not to be negative: the best of the others is that without it.
    const LinearFit held = fitColumns(equations, {0, 1, 2}, {true, true, true});
    const LinearFit without = fitColumns(equations, {0, 1}, {true, true, true});
    EXPECT_TRUE(held.isHeld[2]);
    EXPECT_NEAR(held.values[0], without.values[0], 1e-12);
    EXPECT_NEAR(held.values[1], without.values[1], 1e-12);
}

TEST(LinearFit, IsTheBestOfAllSubsetsWhereNothingMayBeNegative) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (int trial = 0; trial < 60; ++trial) {
        std::vector<std::vector<double>> rows(12, std::vector<double>(4));
        std::vector<double> right(12);
        for (auto& row : rows) {
            for (double& value : row)
                value = normal(random);
        }
        for (double& value : right)
            value = normal(random);
        const NormalEquations equations = equationsOf(rows, right);
        const LinearFit fit = fitColumns(equations, {0, 1, 2, 3}, {true, true, true, true});
        double best = equations.squares;
        for (unsigned subset = 1; subset < 16; ++subset) {
            std::vector<std::size_t> columns;
            for (std::size_t j = 0; j < 4; ++j) {
                if ((subset >> j & 1u) != 0) columns.push_back(j);
            }
            const LinearFit free = fitColumns(equations, columns, {false, false, false, false});
            bool isAllowed = true;
            for (const double value : free.values)
                isAllowed = isAllowed && value >= 0.0;
            if (isAllowed) best = std::min(best, free.chiSquared);
        }
        for (const double value : fit.values)
            EXPECT_GE(value, 0.0);
        EXPECT_NEAR(fit.chiSquared, best, 1e-9 * equations.squares);
    }
}

TEST(LinearFit, DropsWhatIsTheSameAsAColumnBefore) {
    const auto equations = equationsOf({{1, 1}, {2, 2}, {3, 3}}, {1, 2, 3});
    EXPECT_FALSE(fitColumns(equations, {0, 1}, {false, false}).isSolved());
    const LinearFit fit = fitColumns(equations, {0, 1}, {false, false});
    EXPECT_FALSE(fit.isDropped[0]);
    EXPECT_TRUE(fit.isDropped[1]);
    EXPECT_NEAR(fit.values[0], 1.0, 1e-12);
    EXPECT_TRUE(fitColumns(equations, {1}, {false, false}).isSolved());
}

}  // namespace
}  // namespace kaustik::judge
