// SPDX-License-Identifier: MIT
// Convolution with one-dimensional kernels that are symmetric about their centre: along the rows,
// then along the columns. Beyond the border the nearest pixel goes on.
#pragma once

#include <vector>

#include "framework/measure/plane.h"

namespace kaustik::measure {

// The weights of distance 0 to the radius; those on the other side follow.
struct Kernel {
    enum class Kind {
        even,         // w(-k) = w(k)
        odd,          // w(-k) = -w(k), w(0) = 0
        evenZeroSum,  // even, all weights add up to 0: a constant gives 0 without rounding
    };
    Kind kind = Kind::even;
    std::vector<double> weights;

    [[nodiscard]] int radius() const { return static_cast<int>(weights.size()) - 1; }
};

// exp(-k²/2σ²) for k up to the radius, with all weights, both sides, adding up to 1.
[[nodiscard]] Kernel gaussianKernel(double sigma, int radius);

template <class T>
[[nodiscard]] Plane<T> convolveRows(const Plane<T>& in, const Kernel& kernel);
template <class T>
[[nodiscard]] Plane<T> convolveColumns(const Plane<T>& in, const Kernel& kernel);
template <class T>
[[nodiscard]] Plane<T> convolve(const Plane<T>& in, const Kernel& rows, const Kernel& columns) {
    return convolveColumns(convolveRows(in, rows), columns);
}

extern template Plane<float> convolveRows(const Plane<float>&, const Kernel&);
extern template Plane<float> convolveColumns(const Plane<float>&, const Kernel&);
extern template Plane<double> convolveRows(const Plane<double>&, const Kernel&);
extern template Plane<double> convolveColumns(const Plane<double>&, const Kernel&);

}  // namespace kaustik::measure
