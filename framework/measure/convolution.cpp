// SPDX-License-Identifier: MIT
#include "framework/measure/convolution.h"

#include <algorithm>
#include <cmath>

namespace kaustik::measure {
namespace {

// Calls body(before, after, weight) for each distance from 1 on; the two pixels of a distance
// together, because sums and differences of equals are exact.
template <class T, class PixelsAt>
void accumulate(const Kernel& kernel, int count, T* out, const PixelsAt& pixelsAt) {
    const T* const centre = pixelsAt(0);
    const T centreWeight =
        kernel.kind == Kernel::Kind::even ? static_cast<T>(kernel.weights[0]) : T{};
    for (int i = 0; i < count; ++i)
        out[i] = centreWeight * centre[i];
    for (int k = 1; k <= kernel.radius(); ++k) {
        const T weight = static_cast<T>(kernel.weights[static_cast<std::size_t>(k)]);
        const T* const before = pixelsAt(-k);
        const T* const after = pixelsAt(k);
        switch (kernel.kind) {
            case Kernel::Kind::even:
                for (int i = 0; i < count; ++i)
                    out[i] += weight * (after[i] + before[i]);
                break;
            case Kernel::Kind::odd:
                for (int i = 0; i < count; ++i)
                    out[i] += weight * (after[i] - before[i]);
                break;
            case Kernel::Kind::evenZeroSum:
                for (int i = 0; i < count; ++i)
                    out[i] += weight * ((after[i] - centre[i]) + (before[i] - centre[i]));
                break;
        }
    }
}

}  // namespace

Kernel gaussianKernel(double sigma, int radius) {
    Kernel kernel;
    double sum = 0.0;
    for (int k = 0; k <= radius; ++k) {
        const double weight = std::exp(-0.5 * k * k / (sigma * sigma));
        kernel.weights.push_back(weight);
        sum += k == 0 ? weight : 2.0 * weight;
    }
    for (double& weight : kernel.weights)
        weight /= sum;
    return kernel;
}

template <class T>
Plane<T> convolveRows(const Plane<T>& in, const Kernel& kernel) {
    Plane<T> out(in.width, in.height);
    const int radius = kernel.radius();
    std::vector<T> padded(static_cast<std::size_t>(in.width + 2 * radius));
    T* const first = padded.data() + radius;
    for (int y = 0; y < in.height; ++y) {
        const T* const row = in.row(y);
        std::fill(padded.data(), first, row[0]);
        std::copy(row, row + in.width, first);
        std::fill(first + in.width, first + in.width + radius, row[in.width - 1]);
        accumulate(kernel, in.width, out.row(y), [&](int k) { return first + k; });
    }
    return out;
}

template <class T>
Plane<T> convolveColumns(const Plane<T>& in, const Kernel& kernel) {
    Plane<T> out(in.width, in.height);
    for (int y = 0; y < in.height; ++y) {
        accumulate(kernel, in.width, out.row(y),
                   [&](int k) { return in.row(std::clamp(y + k, 0, in.height - 1)); });
    }
    return out;
}

template Plane<float> convolveRows(const Plane<float>&, const Kernel&);
template Plane<float> convolveColumns(const Plane<float>&, const Kernel&);
template Plane<double> convolveRows(const Plane<double>&, const Kernel&);
template Plane<double> convolveColumns(const Plane<double>&, const Kernel&);

}  // namespace kaustik::measure
