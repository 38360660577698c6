// SPDX-License-Identifier: MIT
// Models of second order hold the function in all of the cell, and their rests fall with the square
// of its size.
#include "framework/certify/jet.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/certify/double_double.h"

namespace kaustik::certify {
namespace {

// Jets have no operator of division.
template <bool s>
Jet<s> operator/(const Jet<s>& a, const Jet<s>& b) {
    return a * inverse(b);
}

// Some function with all operations, of (x, y) scaled to a cell of that size.
template <class T>
T function(const T& x, const T& y) {
    using std::exp;
    using std::sqrt;
    const T root = sqrt(x * x + y * y * y + T(2.0));
    return exp(x * y - y) * root + x / (root + y);
}

TaylorModel modelAt(double size) {
    const auto seed = [&](auto& x, auto& y, const Interval& at) {
        x.value = Interval(0.3) + Interval(size) * at;
        y.value = Interval(0.5) + Interval(size) * at;
        x.gradient = {Interval(size), Interval(0.0)};
        y.gradient = {Interval(0.0), Interval(size)};
    };
    Jet<false> x;
    Jet<false> y;
    seed(x, y, Interval(1.0) / Interval(3.0));
    Jet<true> wideX;
    Jet<true> wideY;
    seed(wideX, wideY, Interval(0.0, 1.0));
    return modelOf(function(x, y), function(wideX, wideY));
}

TEST(TaylorModel, HoldsTheFunctionAllOverTheCell) {
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (const double size : {1.0, 0.1, 1e-3}) {
        const TaylorModel model = modelAt(size);
        ASSERT_TRUE(model.isFinite());
        for (int i = 0; i < 20000; ++i) {
            double x = share(generator);
            double y = share(generator);
            if (x + y > 1.0) {
                x = 1.0 - x;
                y = 1.0 - y;
            }
            const double truth = function(0.3 + size * x, 0.5 + size * y);
            // The truth itself is rounded.
            const double off = truth - model.at(x, y);
            ASSERT_GE(off, model.rest.lo - 1e-14);
            ASSERT_LE(off, model.rest.hi + 1e-14);
            ASSERT_TRUE(model.range().holds(truth));
        }
    }
}

// Without a tolerance: against 106 bits, in cells so small that the rest is what is rounded.
TEST(TaylorModel, HoldsTheFunctionWhateverIsRounded) {
    const auto rational = [](const auto& x, const auto& y) {
        using T = std::decay_t<decltype(x)>;
        using std::sqrt;
        const T root = sqrt(x * x + y * y * y + T(2.0));
        return root * (x - y) + x / (root + y);
    };
    std::mt19937_64 generator(9);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int i = 0; i < 20000; ++i) {
        const double size = std::exp2(-60.0 * share(generator));
        const double cornerX = 3.0 * share(generator) - 1.5;
        const double cornerY = share(generator);
        const auto seed = [&](auto& x, auto& y, const Interval& at) {
            x.value = Interval(cornerX) + Interval(size) * at;
            y.value = Interval(cornerY) + Interval(size) * at;
            x.gradient = {Interval(size), Interval(0.0)};
            y.gradient = {Interval(0.0), Interval(size)};
        };
        Jet<false> x;
        Jet<false> y;
        seed(x, y, Interval(1.0) / Interval(3.0));
        Jet<true> wideX;
        Jet<true> wideY;
        seed(wideX, wideY, Interval(0.0, 1.0));
        const TaylorModel model = modelOf(rational(x, y), rational(wideX, wideY));
        double u = share(generator);
        double v = share(generator);
        if (u + v > 1.0) {
            u = 1.0 - u;
            v = 1.0 - v;
        }
        const DoubleDouble truth =
            rational(DoubleDouble(cornerX) + DoubleDouble(size) * DoubleDouble(u),
                     DoubleDouble(cornerY) + DoubleDouble(size) * DoubleDouble(v));
        // As its users evaluate it, in doubles.
        const DoubleDouble off = truth - DoubleDouble(model.at(u, v));
        ASSERT_TRUE(DoubleDouble(model.rest.lo) <= off) << size;
        ASSERT_TRUE(off <= DoubleDouble(model.rest.hi)) << size;
        ASSERT_TRUE(DoubleDouble(model.range().lo) <= truth &&
                    truth <= DoubleDouble(model.range().hi));
        if (size < 1e-9) {
            ASSERT_LT(model.rest.width(), 1e-13);
        }
    }
}

// What is narrowed holds value and slopes all over the cell, and is narrower; and so is what is
// computed of it. Slopes: of the function itself, by differences that are far finer than the cell.
TEST(TaylorModel, HoldsTheFunctionWhenItIsNarrowed) {
    std::mt19937_64 generator(5);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (const double size : {0.1, 0.05}) {
        const auto seed = [&](auto& x, auto& y, const Interval& at) {
            x.value = Interval(0.3) + Interval(size) * at;
            y.value = Interval(0.5) + Interval(size) * at;
            x.gradient = {Interval(size), Interval(0.0)};
            y.gradient = {Interval(0.0), Interval(size)};
        };
        Jet<false> x;
        Jet<false> y;
        seed(x, y, Interval(1.0) / Interval(3.0));
        Jet<true> wideX;
        Jet<true> wideY;
        seed(wideX, wideY, Interval(0.0, 1.0));
        const Jet<false> middle = function(x, y);
        const Jet<true> before = function(wideX, wideY);
        Jet<true> after = before;
        narrow(middle, after);
        EXPECT_LT(after.value.width(), 0.8 * before.value.width());
        const Jet<false> middleSquare = square(middle) * inverse(middle + Interval(9.0));
        const TaylorModel onward =
            modelOf(middleSquare, square(after) * inverse(after + Interval(9.0)));
        const TaylorModel onwardBefore =
            modelOf(middleSquare, square(before) * inverse(before + Interval(9.0)));
        EXPECT_LT(onward.rest.width(), onwardBefore.rest.width());
        for (int i = 0; i < 20000; ++i) {
            double u = share(generator);
            double v = share(generator);
            if (u + v > 1.0) {
                u = 1.0 - u;
                v = 1.0 - v;
            }
            const auto at = [&](double a, double b) {
                return function(0.3 + size * a, 0.5 + size * b);
            };
            const double truth = at(u, v);
            ASSERT_TRUE(after.value.holds(truth));
            const double next = truth * truth / (truth + 9.0);
            ASSERT_GE(next - onward.at(u, v), onward.rest.lo - 1e-14);
            ASSERT_LE(next - onward.at(u, v), onward.rest.hi + 1e-14);
            // Central differences are off by some 1e-9 here.
            constexpr double kStep = 1e-5;
            const double alongU = (at(u + kStep, v) - at(u - kStep, v)) / (2.0 * kStep);
            const double alongV = (at(u, v + kStep) - at(u, v - kStep)) / (2.0 * kStep);
            ASSERT_GE(alongU, after.gradient[0].lo - 1e-8);
            ASSERT_LE(alongU, after.gradient[0].hi + 1e-8);
            ASSERT_GE(alongV, after.gradient[1].lo - 1e-8);
            ASSERT_LE(alongV, after.gradient[1].hi + 1e-8);
        }
    }
}

TEST(TaylorModel, HasTheMeanOfTheCell) {
    const TaylorModel model = modelAt(0.2);
    double sum = 0.0;
    constexpr int kSteps = 400;
    // The middles of equal triangles: off by far less than the rest.
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; i + j < kSteps; ++j) {
            sum += function(0.3 + 0.2 * (i + 1.0 / 3.0) / kSteps,
                            0.5 + 0.2 * (j + 1.0 / 3.0) / kSteps);
            if (i + j < kSteps - 1) {
                sum += function(0.3 + 0.2 * (i + 2.0 / 3.0) / kSteps,
                                0.5 + 0.2 * (j + 2.0 / 3.0) / kSteps);
            }
        }
    }
    const double mean = sum / (kSteps * kSteps);
    const double linear = model.at(1.0 / 3.0, 1.0 / 3.0);
    EXPECT_GE(mean - linear, model.restMean.lo - 1e-9);
    EXPECT_LE(mean - linear, model.restMean.hi + 1e-9);
    EXPECT_LT(model.restMean.width(), model.rest.width());
}

TEST(TaylorModel, HasARestThatFallsWithTheSquare) {
    const double coarse = modelAt(0.02).rest.width();
    const double fine = modelAt(0.01).rest.width();
    EXPECT_NEAR(coarse / fine, 4.0, 0.3);
}

}  // namespace
}  // namespace kaustik::certify
