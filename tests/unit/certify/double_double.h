// SPDX-License-Identifier: MIT
// Numbers of 106 bits, a sum of two doubles (Dekker 1971), as the truth that bounds of doubles are
// held against: their own rounding is 2^-50 of that of doubles.
#pragma once

#include <cmath>

namespace kaustik::certify {

struct DoubleDouble {
    double high = 0.0;
    double low = 0.0;
    DoubleDouble() = default;
    DoubleDouble(double value) : high(value) {}  // NOLINT: a double is one
    DoubleDouble(double h, double l) : high(h + l), low(l - (high - h)) {}
};

inline DoubleDouble operator-(const DoubleDouble& a) {
    DoubleDouble r;
    r.high = -a.high;
    r.low = -a.low;
    return r;
}
inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const double sum = a.high + b.high;
    const double t = sum - a.high;
    const double rest = (a.high - (sum - t)) + (b.high - t);
    const double lowSum = a.low + b.low;
    const double s = lowSum - a.low;
    const double lowRest = (a.low - (lowSum - s)) + (b.low - s);
    const DoubleDouble first(sum, rest + lowSum);
    return {first.high, first.low + lowRest};
}
inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
    return a + -b;
}
inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const double product = a.high * b.high;
    const double rest = std::fma(a.high, b.high, -product);
    return {product, rest + (a.high * b.low + a.low * b.high)};
}
inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double q = a.high / b.high;
    const DoubleDouble left = a - b * DoubleDouble(q);
    const double r = left.high / b.high;
    const DoubleDouble rest = left - b * DoubleDouble(r);
    return DoubleDouble(q, r) + DoubleDouble(rest.high / b.high);
}
inline DoubleDouble sqrt(const DoubleDouble& a) {
    const double q = std::sqrt(a.high);
    const DoubleDouble left = a - DoubleDouble(q) * DoubleDouble(q);
    const DoubleDouble first(q, left.high / (2.0 * q));
    const DoubleDouble rest = a - first * first;
    return first + DoubleDouble(rest.high / (2.0 * q));
}
inline bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
    return a.high < b.high || (a.high == b.high && a.low < b.low);
}
inline bool operator<=(const DoubleDouble& a, const DoubleDouble& b) {
    return !(b < a);
}

}  // namespace kaustik::certify
