// SPDX-License-Identifier: MIT
#include "framework/judge/significance.h"

#include <cmath>
#include <functional>

namespace kaustik::judge {
namespace {

// Where a tail falls below the chance, by bisection; the tail falls from 1 at 0.
double critical(double chance, double high, const std::function<double(double)>& tail) {
    double low = 0.0;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (tail(middle) > chance ? low : high) = middle;
    }
    return high;
}

}  // namespace

double chanceOfEach(double chance, double count) {
    return -std::expm1(std::log1p(-chance) / count);
}

double criticalZ(double chance) {
    return critical(chance, 40.0, [](double z) { return std::erfc(z / std::sqrt(2.0)); });
}

// Two degrees more add a term (Abramowitz and Stegun, 26.4.4 and 26.4.5).
double chiSquaredTail(double value, std::size_t degrees) {
    const double half = 0.5 * value;
    const bool isOdd = degrees % 2 == 1;
    double tail = isOdd ? std::erfc(std::sqrt(half)) : std::exp(-half);
    for (double k = isOdd ? 1.0 : 2.0; k + 1.0 < static_cast<double>(degrees); k += 2.0)
        tail += std::exp(0.5 * k * std::log(half) - half - std::lgamma(0.5 * k + 1.0));
    return tail;
}

double criticalChiSquared(double chance, std::size_t degrees) {
    return critical(chance, 1000.0 + 10.0 * static_cast<double>(degrees),
                    [degrees](double value) { return chiSquaredTail(value, degrees); });
}

}  // namespace kaustik::judge
