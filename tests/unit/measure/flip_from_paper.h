// SPDX-License-Identifier: MIT
// FLIP once more, as its papers put it and without any thought of speed: in double, with whole
// two-dimensional kernels, matrices from the primaries of Rec.709, and the sRGB and CIELAB formulas
// written out. The reference for the tests of the fast one, with which it shares no code.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace kaustik::measure::test {

using Vec3 = std::array<double, 3>;
using Matrix = std::array<Vec3, 3>;

inline Vec3 times(const Matrix& m, const Vec3& v) {
    Vec3 result{};
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return result;
}

inline Matrix inverse(const Matrix& m) {
    const auto minorOf = [&](std::size_t i, std::size_t j) {
        const std::size_t r1 = (i + 1) % 3, r2 = (i + 2) % 3, c1 = (j + 1) % 3, c2 = (j + 2) % 3;
        return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
    };
    const double determinant =
        m[0][0] * minorOf(0, 0) + m[0][1] * minorOf(0, 1) + m[0][2] * minorOf(0, 2);
    Matrix result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            result[j][i] = minorOf(i, j) / determinant;
    }
    return result;
}

inline Vec3 whiteXyz() {
    return {0.3127 / 0.3290, 1.0, (1.0 - 0.3127 - 0.3290) / 0.3290};
}

// From the chromaticities of red, green and blue, such that (1,1,1) is the white.
inline Matrix xyzFromRgb() {
    const Matrix primaries{{{0.64 / 0.33, 0.30 / 0.60, 0.15 / 0.06},
                            {1.0, 1.0, 1.0},
                            {0.03 / 0.33, 0.10 / 0.60, 0.79 / 0.06}}};
    const Vec3 amounts = times(inverse(primaries), whiteXyz());
    Matrix result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            result[i][j] = primaries[i][j] * amounts[j];
    }
    return result;
}

inline Vec3 ycxcz(const Vec3& rgb) {
    const Vec3 xyz = times(xyzFromRgb(), rgb);
    const Vec3 white = whiteXyz();
    const double x = xyz[0] / white[0], y = xyz[1] / white[1], z = xyz[2] / white[2];
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

// Opponent colour back to RGB, clamped to what can be shown, then to CIELAB with Hunt's adjustment.
inline Vec3 huntLab(const Vec3& opponent) {
    const Vec3 white = whiteXyz();
    const double y = (opponent[0] + 16.0) / 116.0;
    Vec3 rgb = times(inverse(xyzFromRgb()), {white[0] * (y + opponent[1] / 500.0), white[1] * y,
                                             white[2] * (y - opponent[2] / 200.0)});
    for (double& value : rgb)
        value = std::clamp(value, 0.0, 1.0);
    const Vec3 xyz = times(xyzFromRgb(), rgb);
    const auto f = [](double t) {
        return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
    };
    const double fx = f(xyz[0] / white[0]), fy = f(xyz[1] / white[1]), fz = f(xyz[2] / white[2]);
    const double lightness = 116.0 * fy - 16.0;
    return {lightness, 0.01 * lightness * 500.0 * (fx - fy), 0.01 * lightness * 200.0 * (fy - fz)};
}

inline double hyab(const Vec3& a, const Vec3& b) {
    return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// The colour difference of two filtered colours, redistributed to [0,1].
inline double colorDifference(const Vec3& labA, const Vec3& labB) {
    const double largest =
        std::pow(hyab(huntLab(ycxcz({0, 1, 0})), huntLab(ycxcz({0, 0, 1}))), 0.7);
    const double difference = std::pow(hyab(labA, labB), 0.7);
    const double knee = 0.4 * largest;
    return difference < knee ? 0.95 / knee * difference
                             : 0.95 + (difference - knee) / (largest - knee) * 0.05;
}

struct PaperImage {
    int width = 0;
    int height = 0;
    std::vector<Vec3> rgb;  // linear, in [0,1]

    [[nodiscard]] const Vec3& at(int x, int y) const {
        x = std::clamp(x, 0, width - 1);
        y = std::clamp(y, 0, height - 1);
        return rgb[static_cast<std::size_t>(y * width + x)];
    }
};

struct Kernel2d {
    int radius = 0;
    std::vector<double> weights;

    Kernel2d(int r, const std::function<double(int, int)>& weight) : radius(r) {
        for (int y = -r; y <= r; ++y) {
            for (int x = -r; x <= r; ++x)
                weights.push_back(weight(x, y));
        }
    }
    // Positive weights made to sum to 1, and negative ones to -1.
    void normalise() {
        double positive = 0.0, negative = 0.0;
        for (const double weight : weights)
            (weight > 0.0 ? positive : negative) += weight;
        for (double& weight : weights)
            weight /= weight > 0.0 ? positive : -negative;
    }
    [[nodiscard]] double at(const PaperImage& image, int x, int y, std::size_t channel) const {
        double sum = 0.0;
        std::size_t next = 0;
        for (int j = -radius; j <= radius; ++j) {
            for (int i = -radius; i <= radius; ++i, ++next) {
                if (weights[next] == 0.0) continue;
                sum += weights[next] * ycxcz(image.at(x + i, y + j))[channel];
            }
        }
        return sum;
    }
};

// FLIP at one pixel.
inline double flipFromPaper(const PaperImage& a, const PaperImage& b, int x, int y, double ppd) {
    constexpr double kPi = std::numbers::pi;
    const int csfRadius =
        static_cast<int>(std::ceil(3.0 * std::sqrt(0.04 / (2 * kPi * kPi)) * ppd));
    const auto csf = [&](double a1, double b1, double a2, double b2) {
        Kernel2d kernel(csfRadius, [&](int i, int j) {
            const double degrees2 = (i * i + j * j) / (ppd * ppd);
            return a1 * std::sqrt(kPi / b1) * std::exp(-kPi * kPi * degrees2 / b1) +
                   a2 * std::sqrt(kPi / b2) * std::exp(-kPi * kPi * degrees2 / b2);
        });
        kernel.normalise();
        return kernel;
    };
    const Kernel2d sensitivities[3] = {csf(1.0, 0.0047, 0.0, 1e-5), csf(1.0, 0.0053, 0.0, 1e-5),
                                       csf(34.1, 0.04, 13.5, 0.025)};
    const auto filtered = [&](const PaperImage& image) {
        Vec3 opponent{};
        for (std::size_t c = 0; c < 3; ++c)
            opponent[c] = sensitivities[c].at(image, x, y, c);
        return huntLab(opponent);
    };

    const double sigma = 0.5 * 0.082 * ppd;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    const auto gaussian = [&](int i, int j) {
        return std::exp(-(i * i + j * j) / (2.0 * sigma * sigma));
    };
    Kernel2d edgeX(radius, [&](int i, int j) { return -i * gaussian(i, j); });
    Kernel2d edgeY(radius, [&](int i, int j) { return -j * gaussian(i, j); });
    Kernel2d pointX(radius,
                    [&](int i, int j) { return (i * i / (sigma * sigma) - 1.0) * gaussian(i, j); });
    Kernel2d pointY(radius,
                    [&](int i, int j) { return (j * j / (sigma * sigma) - 1.0) * gaussian(i, j); });
    for (Kernel2d* kernel : {&edgeX, &edgeY, &pointX, &pointY})
        kernel->normalise();
    // Y of YCxCz brought to [0,1]: its offset has no part in sums of weights that are 0.
    const auto strength = [&](const PaperImage& image, const Kernel2d& kx, const Kernel2d& ky) {
        return std::hypot(kx.at(image, x, y, 0), ky.at(image, x, y, 0)) / 116.0;
    };
    const double edge = std::abs(strength(a, edgeX, edgeY) - strength(b, edgeX, edgeY));
    const double point = std::abs(strength(a, pointX, pointY) - strength(b, pointX, pointY));
    const double feature = std::pow(std::max(edge, point) / std::numbers::sqrt2, 0.5);
    return std::pow(colorDifference(filtered(a), filtered(b)), 1.0 - feature);
}

// Without edges and points, and unchanged by filters, which all have the sum 1.
inline double flipOfConstants(const Vec3& rgbA, const Vec3& rgbB) {
    return colorDifference(huntLab(ycxcz(rgbA)), huntLab(ycxcz(rgbB)));
}

}  // namespace kaustik::measure::test
