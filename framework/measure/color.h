// SPDX-License-Identifier: MIT
// Colour spaces that the measures and the heat map need, between linear Rec.709 RGB (white 1,1,1),
// CIE XYZ, CIELAB, and YCxCz, its linear relative in which FLIP filters. White is D65 throughout.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "framework/image/image.h"
#include "framework/measure/plane.h"

namespace kaustik::measure {

// Rows of the matrix from linear Rec.709 to XYZ, from the primaries and the white of ITU-R BT.709.
inline constexpr std::array<std::array<double, 3>, 3> kXyzFromRgb{{
    {0.4123907993, 0.3575843394, 0.1804807884},
    {0.2126390059, 0.7151686788, 0.0721923154},
    {0.0193308187, 0.1191947798, 0.9505321522},
}};
inline constexpr std::array<std::array<double, 3>, 3> kRgbFromXyz{{
    {3.2409699419, -1.5373831776, -0.4986107603},
    {-0.9692436363, 1.8759675015, 0.0415550574},
    {0.0556300797, -0.2039769589, 1.0569715142},
}};
inline constexpr std::array<double, 3> kWhiteXyz{0.9504559270, 1.0, 1.0890577507};

[[nodiscard]] inline double luminance(double red, double green, double blue) {
    return kXyzFromRgb[1][0] * red + kXyzFromRgb[1][1] * green + kXyzFromRgb[1][2] * blue;
}

// The luminance of an RGB image. A negative one, which no light has, becomes 0.
[[nodiscard]] Plane<double> luminancePlane(const Image& rgb);

// The sRGB transfer function (IEC 61966-2-1); `encode` takes [0,1] to [0,1], and clamps to it.
[[nodiscard]] double encodeSrgb(double linear);
[[nodiscard]] double decodeSrgb(double encoded);
// Makes linear light of a picture for a display: decodes every value but those of alpha.
[[nodiscard]] Image decodeSrgb(Image image);

// The cube root of a number from 1e-30 to 1e30, to 2e-7 relative: a guess from the exponent, good
// to 4 %, and two steps of Halley's method, each of which cubes the error. std::cbrt took a quarter
// of FLIP's time.
[[nodiscard]] inline float cubeRoot(float value) {
    float root = std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) / 3u + 709921077u);
    for (int step = 0; step < 2; ++step) {
        const float cube = root * root * root;
        root *= (cube + 2.0f * value) / (2.0f * cube + value);
    }
    return root;
}

// CIELAB's cube root with a straight beginning, and its inverse; of X/Xn, Y/Yn or Z/Zn.
[[nodiscard]] inline float labCurve(float ratio) {
    constexpr float kDelta = 6.0f / 29.0f;
    return ratio > kDelta * kDelta * kDelta ? cubeRoot(ratio)
                                            : ratio / (3.0f * kDelta * kDelta) + 4.0f / 29.0f;
}
[[nodiscard]] inline double inverseLabCurve(double value) {
    constexpr double kDelta = 6.0 / 29.0;
    return value > kDelta ? value * value * value : 3.0 * kDelta * kDelta * (value - 4.0 / 29.0);
}

}  // namespace kaustik::measure
