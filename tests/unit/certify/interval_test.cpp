// SPDX-License-Identifier: MIT
// Intervals hold the exact results. What is exact is told by residuals that doubles hold without
// rounding: of a sum by Knuth's two-sum, of a product, a quotient and a root by a fused
// multiply-add.
#include "framework/certify/interval.h"

#include <gtest/gtest.h>

#include <random>

namespace kaustik::certify {
namespace {

constexpr int kTries = 200000;

class Numbers {
  public:
    double operator()() {
        const double mantissa = std::uniform_real_distribution<double>(-2.0, 2.0)(generator_);
        return std::ldexp(mantissa, std::uniform_int_distribution<int>(-60, 60)(generator_));
    }

  private:
    std::mt19937_64 generator_{7};
};

TEST(Interval, HoldsTheExactSum) {
    Numbers next;
    for (int i = 0; i < kTries; ++i) {
        const double a = next();
        const double b = next();
        const double sum = a + b;
        const double t = sum - a;
        const double residual = (a - (sum - t)) + (b - t);  // a + b = sum + residual
        const Interval found = Interval(a) + Interval(b);
        ASSERT_LE(found.lo, sum);
        ASSERT_GE(found.hi, sum);
        ASSERT_LE(found.lo - sum, residual);
        ASSERT_GE(found.hi - sum, residual);
        ASSERT_LE(found.width(), 0x1p-50 * std::fabs(sum) + 1e-300);
    }
}

TEST(Interval, HoldsTheExactProductAndQuotient) {
    Numbers next;
    for (int i = 0; i < kTries; ++i) {
        const double a = next();
        const double b = next();
        const double product = a * b;
        const double residual = std::fma(a, b, -product);
        const Interval found = Interval(a) * Interval(b);
        ASSERT_LE(found.lo - product, residual);
        ASSERT_GE(found.hi - product, residual);
        // lo b <= a <= hi b, for b > 0.
        const double c = std::fabs(b);
        const Interval ratio = Interval(a) / Interval(c);
        ASSERT_LE(std::fma(ratio.lo, c, -a), 0.0);
        ASSERT_GE(std::fma(ratio.hi, c, -a), 0.0);
        ASSERT_LE(ratio.width(), 0x1p-49 * std::fabs(a / c));
    }
}

TEST(Interval, HoldsTheExactRootAndSquare) {
    Numbers next;
    for (int i = 0; i < kTries; ++i) {
        const double a = std::fabs(next());
        const Interval root = sqrt(Interval(a));
        ASSERT_LE(std::fma(root.lo, root.lo, -a), 0.0);
        ASSERT_GE(std::fma(root.hi, root.hi, -a), 0.0);
        const Interval squared = square(Interval(a));
        ASSERT_LE(squared.lo - a * a, std::fma(a, a, -(a * a)));
        ASSERT_GE(squared.hi - a * a, std::fma(a, a, -(a * a)));
    }
}

TEST(Interval, HoldsWhatAnyOfItsNumbersGive) {
    Numbers next;
    std::mt19937_64 generator(3);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int i = 0; i < kTries; ++i) {
        const double a = next();
        const double b = next();
        const double c = next();
        const double d = next();
        const Interval one(std::min(a, b), std::max(a, b));
        const Interval two(std::min(c, d), std::max(c, d));
        const double p = std::clamp(one.lo + share(generator) * (one.hi - one.lo), one.lo, one.hi);
        const double q = std::clamp(two.lo + share(generator) * (two.hi - two.lo), two.lo, two.hi);
        ASSERT_TRUE((one + two).holds(p + q));
        ASSERT_TRUE((one - two).holds(p - q));
        ASSERT_TRUE((one * two).holds(p * q));
        ASSERT_TRUE(square(one).holds(p * p));
        if (two.lo > 0.0 || two.hi < 0.0) {
            ASSERT_TRUE((one / two).holds(p / q));
        }
    }
}

// e is between the sums 1/0! + ... + 1/18! and that plus 2/19!, to less than 1e-15 in doubles.
TEST(Interval, HoldsTheExponential) {
    const Interval e = exp(Interval(1.0));
    EXPECT_TRUE(e.holds(2.718281828459045));
    EXPECT_LT(e.width(), 1e-11);
    std::mt19937_64 generator(5);
    std::uniform_real_distribution<double> number(-30.0, 5.0);
    for (int i = 0; i < 20000; ++i) {
        const double a = number(generator);
        const Interval found = exp(Interval(a));
        // Long doubles have eleven bits more than what is asked of them.
        const long double truth = std::exp(static_cast<long double>(a));
        ASSERT_LE(static_cast<long double>(found.lo), truth);
        ASSERT_GE(static_cast<long double>(found.hi), truth);
        ASSERT_LT(found.width(), 1e-11 * found.hi);
        // exp(a) exp(-a) is 1.
        ASSERT_TRUE((found * exp(Interval(-a))).holds(1.0));
    }
}

TEST(Interval, NeverHidesWhatIsNoNumber) {
    const Interval bad = inverse(Interval(-1.0, 1.0));
    EXPECT_FALSE(bad.isFinite());
    EXPECT_FALSE((bad * Interval(0.0)).isFinite());
    EXPECT_FALSE((Interval(1.0, 2.0) * bad).isFinite());
    EXPECT_FALSE((bad + Interval(1.0)).isFinite());
    EXPECT_FALSE(square(bad).isFinite());
    EXPECT_FALSE(hull(Interval(1.0), bad).isFinite());
    EXPECT_FALSE(sqrt(Interval(-1.0, 4.0)).isFinite());
}

}  // namespace
}  // namespace kaustik::certify
