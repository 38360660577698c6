// SPDX-License-Identifier: MIT
// Intervals of doubles that hold the exact result of every operation. Each bound is computed to the
// nearest double and then moved outwards by two units in the last place, so that nothing depends on
// the rounding mode of the processor, on the compiler's order of operations or on the C library;
// of the operations used, IEEE 754 demands that they are rounded correctly (Moore 1966; Rump 2010,
// section 3). The source is compiled without contraction of products and sums.
//
// An operation never hides a failure: what is no number or infinite stays so to the end, where
// whoever relies on an enclosure asks isFinite(). Divisors and arguments of roots are for the
// caller to check first (staysAwayFromZero).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace kaustik::certify {

namespace rounding {
inline constexpr double kRelative = 0x1p-52;
inline constexpr double kAbsolute = 0x1p-1000;  // above what underflow loses
// The next doubles below and above the exact value of which `nearest` is the rounded one.
[[nodiscard]] inline double down(double nearest) {
    return nearest - (std::fabs(nearest) * kRelative + kAbsolute);
}
[[nodiscard]] inline double up(double nearest) {
    return nearest + (std::fabs(nearest) * kRelative + kAbsolute);
}
}  // namespace rounding

struct Interval {
    double lo = 0.0;
    double hi = 0.0;

    constexpr Interval() = default;
    constexpr Interval(double value) : lo(value), hi(value) {}  // NOLINT: a number is an interval
    constexpr Interval(double low, double high) : lo(low), hi(high) {}

    [[nodiscard]] double middle() const { return 0.5 * (lo + hi); }
    [[nodiscard]] double width() const { return rounding::up(hi - lo); }
    // The largest absolute value.
    [[nodiscard]] double magnitude() const { return std::max(std::fabs(lo), std::fabs(hi)); }
    [[nodiscard]] bool holds(double value) const { return lo <= value && value <= hi; }
    [[nodiscard]] bool isFinite() const { return std::isfinite(lo) && std::isfinite(hi); }
    [[nodiscard]] bool isAbove(double value) const { return lo > value; }
    [[nodiscard]] bool isBelow(double value) const { return hi < value; }
};

// What is farther from 0 than this may be divided by, or have its root taken: derivatives of the
// result are then far from overflow.
inline constexpr double kSmallestDivisor = 1e-20;
[[nodiscard]] inline bool staysAwayFromZero(const Interval& a) {
    return a.lo > kSmallestDivisor || a.hi < -kSmallestDivisor;
}

[[nodiscard]] inline Interval operator-(const Interval& a) {
    return {-a.hi, -a.lo};
}
[[nodiscard]] inline Interval operator+(const Interval& a, const Interval& b) {
    return {rounding::down(a.lo + b.lo), rounding::up(a.hi + b.hi)};
}
[[nodiscard]] inline Interval operator-(const Interval& a, const Interval& b) {
    return {rounding::down(a.lo - b.hi), rounding::up(a.hi - b.lo)};
}
[[nodiscard]] inline Interval operator*(const Interval& a, const Interval& b) {
    const double p = a.lo * b.lo;
    const double q = a.lo * b.hi;
    const double r = a.hi * b.lo;
    const double s = a.hi * b.hi;
    // The comparisons drop what is no number; the sum that is added keeps it.
    const double failure = (p + q + r + s) * 0.0;
    return {rounding::down(std::min(std::min(p, q), std::min(r, s))) + failure,
            rounding::up(std::max(std::max(p, q), std::max(r, s))) + failure};
}
[[nodiscard]] inline Interval operator*(double a, const Interval& b) {
    const double p = a * b.lo;
    const double q = a * b.hi;
    return a >= 0.0 ? Interval{rounding::down(p), rounding::up(q)}
                    : Interval{rounding::down(q), rounding::up(p)};
}
[[nodiscard]] inline Interval operator*(const Interval& a, double b) {
    return b * a;
}
// Of an interval without 0; else it is no number.
[[nodiscard]] inline Interval inverse(const Interval& a) {
    if (!(a.lo > 0.0 || a.hi < 0.0)) {
        return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
    }
    return {rounding::down(1.0 / a.hi), rounding::up(1.0 / a.lo)};
}
[[nodiscard]] inline Interval operator/(const Interval& a, const Interval& b) {
    return a * inverse(b);
}
[[nodiscard]] inline Interval square(const Interval& a) {
    const double p = a.lo * a.lo;
    const double q = a.hi * a.hi;
    const double failure = (p + q) * 0.0;
    if (a.lo <= 0.0 && a.hi >= 0.0) return {failure, rounding::up(std::max(p, q)) + failure};
    return {std::max(rounding::down(std::min(p, q)), 0.0) + failure,
            rounding::up(std::max(p, q)) + failure};
}
// Of what is not negative; else it is no number.
[[nodiscard]] inline Interval sqrt(const Interval& a) {
    return {std::max(rounding::down(std::sqrt(a.lo)), 0.0) + std::sqrt(a.lo) * 0.0,
            rounding::up(std::sqrt(a.hi))};
}
[[nodiscard]] inline Interval hull(const Interval& a, const Interval& b) {
    const double failure = (a.lo + a.hi + b.lo + b.hi) * 0.0;
    return {std::min(a.lo, b.lo) + failure, std::max(a.hi, b.hi) + failure};
}
// Of two that hold the same value.
[[nodiscard]] inline Interval intersection(const Interval& a, const Interval& b) {
    return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
}

// e to the power of a number, by its series and repeated squares.
[[nodiscard]] inline Interval exp(double a) {
    constexpr int kSquares = 10;
    constexpr int kTerms = 8;
    if (!(std::fabs(a) < 700.0)) {
        if (a <= -700.0) return {0.0, 0x1p-1000};
        return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
    }
    const Interval small = Interval(std::ldexp(a, -kSquares));  // exact, below 0.7
    Interval sum(1.0);
    for (int i = kTerms; i > 0; --i)
        sum = Interval(1.0) + small * sum / Interval(static_cast<double>(i));
    // What is left of the series is below twice its next term: 0.7⁹/9! 2.
    const double x = std::fabs(small.lo);
    const double rest = rounding::up(std::pow(x, kTerms + 1) * (2.1 / 362880.0));
    sum = sum + Interval(-rest, rest);
    for (int i = 0; i < kSquares; ++i)
        sum = square(sum);
    return sum;
}
[[nodiscard]] inline Interval exp(const Interval& a) {
    return {exp(a.lo).lo, exp(a.hi).hi};
}

}  // namespace kaustik::certify
