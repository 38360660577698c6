// SPDX-License-Identifier: MIT
// Functions of the place in a cell with their derivatives, in intervals. A cell is the triangle of
// (x, y) with x, y >= 0 and x + y <= 1. Jet<false>: value and gradient, for a point of it;
// Jet<true>: with the second derivatives, over all of it. Both together enclose a function to
// second order (TaylorModel).
#pragma once

#include <array>

#include "framework/certify/interval.h"

namespace kaustik::certify {

template <bool second>
struct Jet {
    Interval value;
    std::array<Interval, 2> gradient;
    std::array<Interval, second ? 3 : 0> hessian;  // xx, xy, yy

    Jet() = default;
    Jet(const Interval& constant) : value(constant) {}  // NOLINT: a constant is a function
    Jet(double constant) : value(constant) {}           // NOLINT
};

template <bool s>
[[nodiscard]] Jet<s> operator-(const Jet<s>& a) {
    Jet<s> r;
    r.value = -a.value;
    for (std::size_t i = 0; i < 2; ++i)
        r.gradient[i] = -a.gradient[i];
    for (std::size_t i = 0; i < r.hessian.size(); ++i)
        r.hessian[i] = -a.hessian[i];
    return r;
}
template <bool s>
[[nodiscard]] Jet<s> operator+(const Jet<s>& a, const Jet<s>& b) {
    Jet<s> r;
    r.value = a.value + b.value;
    for (std::size_t i = 0; i < 2; ++i)
        r.gradient[i] = a.gradient[i] + b.gradient[i];
    for (std::size_t i = 0; i < r.hessian.size(); ++i)
        r.hessian[i] = a.hessian[i] + b.hessian[i];
    return r;
}
template <bool s>
[[nodiscard]] Jet<s> operator-(const Jet<s>& a, const Jet<s>& b) {
    Jet<s> r;
    r.value = a.value - b.value;
    for (std::size_t i = 0; i < 2; ++i)
        r.gradient[i] = a.gradient[i] - b.gradient[i];
    for (std::size_t i = 0; i < r.hessian.size(); ++i)
        r.hessian[i] = a.hessian[i] - b.hessian[i];
    return r;
}
template <bool s>
[[nodiscard]] Jet<s> operator+(const Jet<s>& a, const Interval& b) {
    Jet<s> r = a;
    r.value = a.value + b;
    return r;
}
template <bool s>
[[nodiscard]] Jet<s> operator+(const Interval& a, const Jet<s>& b) {
    return b + a;
}
template <bool s>
[[nodiscard]] Jet<s> operator-(const Jet<s>& a, const Interval& b) {
    Jet<s> r = a;
    r.value = a.value - b;
    return r;
}
template <bool s>
[[nodiscard]] Jet<s> operator-(const Interval& a, const Jet<s>& b) {
    return -b + a;
}
template <bool s>
[[nodiscard]] Jet<s> operator*(const Jet<s>& a, const Jet<s>& b) {
    Jet<s> r;
    r.value = a.value * b.value;
    for (std::size_t i = 0; i < 2; ++i)
        r.gradient[i] = a.gradient[i] * b.value + a.value * b.gradient[i];
    if constexpr (s) {
        r.hessian[0] =
            a.hessian[0] * b.value + 2.0 * (a.gradient[0] * b.gradient[0]) + a.value * b.hessian[0];
        r.hessian[1] = a.hessian[1] * b.value + a.gradient[0] * b.gradient[1] +
                       a.gradient[1] * b.gradient[0] + a.value * b.hessian[1];
        r.hessian[2] =
            a.hessian[2] * b.value + 2.0 * (a.gradient[1] * b.gradient[1]) + a.value * b.hessian[2];
    }
    return r;
}
template <bool s>
[[nodiscard]] Jet<s> operator*(const Interval& a, const Jet<s>& b) {
    Jet<s> r;
    r.value = a * b.value;
    for (std::size_t i = 0; i < 2; ++i)
        r.gradient[i] = a * b.gradient[i];
    for (std::size_t i = 0; i < r.hessian.size(); ++i)
        r.hessian[i] = a * b.hessian[i];
    return r;
}

// f(a) by the value and the derivatives of f over the values of a.
template <bool s>
[[nodiscard]] Jet<s> chain(const Jet<s>& a, const Interval& value, const Interval& first,
                           const Interval& secondDerivative) {
    Jet<s> r;
    r.value = value;
    for (std::size_t i = 0; i < 2; ++i)
        r.gradient[i] = first * a.gradient[i];
    if constexpr (s) {
        r.hessian[0] = first * a.hessian[0] + secondDerivative * square(a.gradient[0]);
        r.hessian[1] = first * a.hessian[1] + secondDerivative * (a.gradient[0] * a.gradient[1]);
        r.hessian[2] = first * a.hessian[2] + secondDerivative * square(a.gradient[1]);
    }
    return r;
}
template <bool s>
[[nodiscard]] Jet<s> square(const Jet<s>& a) {
    return chain(a, square(a.value), 2.0 * a.value, Interval(2.0));
}
template <bool s>
[[nodiscard]] Jet<s> inverse(const Jet<s>& a) {
    const Interval value = inverse(a.value);
    const Interval squared = square(value);
    return chain(a, value, -squared, 2.0 * (squared * value));
}
template <bool s>
[[nodiscard]] Jet<s> sqrt(const Jet<s>& a) {
    const Interval value = sqrt(a.value);
    const Interval first = 0.5 * inverse(value);
    return chain(a, value, first, -0.5 * (first / a.value));
}
template <bool s>
[[nodiscard]] Jet<s> exp(const Jet<s>& a) {
    const Interval value = exp(a.value);
    return chain(a, value, value, value);
}

template <class T>
struct Vector {
    T x{};
    T y{};
    T z{};
};
template <class A, class B>
[[nodiscard]] auto dot(const Vector<A>& a, const Vector<B>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class A, class B>
[[nodiscard]] auto cross(const Vector<A>& a, const Vector<B>& b) {
    return Vector<decltype(a.x * b.x)>{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                                       a.x * b.y - a.y * b.x};
}
template <class A, class B>
[[nodiscard]] auto operator+(const Vector<A>& a, const Vector<B>& b) {
    return Vector<decltype(a.x + b.x)>{a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class A, class B>
[[nodiscard]] auto operator-(const Vector<A>& a, const Vector<B>& b) {
    return Vector<decltype(a.x - b.x)>{a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class A, class B>
[[nodiscard]] auto scaled(const A& factor, const Vector<B>& b) {
    return Vector<decltype(factor * b.x)>{factor * b.x, factor * b.y, factor * b.z};
}
template <bool s>
[[nodiscard]] Jet<s> operator*(const Jet<s>& a, const Interval& b) {
    return b * a;
}

template <bool s>
[[nodiscard]] Jet<s> squaredLength(const Vector<Jet<s>>& a) {
    return square(a.x) + square(a.y) + square(a.z);
}

// value + slopes (x, y) + anything in rest, over all of the cell.
struct TaylorModel {
    double value = 0.0;  // at x = y = 0
    std::array<double, 2> slope{};
    Interval rest;
    // The mean of the rest over the cell, which cancels in part.
    Interval restMean;

    [[nodiscard]] double at(double x, double y) const {
        return value + slope[0] * x + slope[1] * y;
    }
    [[nodiscard]] Interval range() const;
    [[nodiscard]] bool isFinite() const {
        return std::isfinite(value) && std::isfinite(slope[0]) && std::isfinite(slope[1]) &&
               rest.isFinite() && restMean.isFinite();
    }
};

// From the jet at the middle of the cell, (1/3, 1/3), and that over the cell's square.
[[nodiscard]] TaylorModel modelOf(const Jet<false>& middle, const Jet<true>& square);

// Narrows value and gradient over the cell to what the next derivatives leave of them on the way
// from the middle. What is computed of it is then known better, too.
void narrow(const Jet<false>& middle, Jet<true>& cell);
inline void narrow(const Vector<Jet<false>>& middle, Vector<Jet<true>>& cell) {
    narrow(middle.x, cell.x);
    narrow(middle.y, cell.y);
    narrow(middle.z, cell.z);
}

}  // namespace kaustik::certify
