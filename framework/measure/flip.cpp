// SPDX-License-Identifier: MIT
#include "framework/measure/flip.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "framework/measure/color.h"
#include "framework/measure/convolution.h"

namespace kaustik::measure {
namespace {

constexpr double kPi = std::numbers::pi;

// Table 1: the contrast sensitivity of each opponent channel is a sum of Gaussians over x in
// degrees, a sqrt(π/b) exp(-π² x²/b), with the sum of all weights in two dimensions made 1.
struct Sensitivity {
    double a, b;
};
constexpr Sensitivity kAchromatic{1.0, 0.0047};
constexpr Sensitivity kRedGreen{1.0, 0.0053};
constexpr Sensitivity kBlueYellow1{34.1, 0.04};
constexpr Sensitivity kBlueYellow2{13.5, 0.025};
constexpr double kFeatureWidthDegrees = 0.082;  // sec. 4.2: w
constexpr double kColorExponent = 0.7;          // sec. 4.3: q_c
constexpr double kColorKnee = 0.4;              // p_c
constexpr double kColorAtKnee = 0.95;           // p_t; the exponent q_f of the features is 1/2

double sigmaPixels(const Sensitivity& sensitivity, double pixelsPerDegree) {
    return std::sqrt(sensitivity.b / 2.0) / kPi * pixelsPerDegree;
}

// The radius that the paper cuts all of its filters at: three widths of the widest.
int sensitivityRadius(double pixelsPerDegree) {
    return static_cast<int>(std::ceil(3.0 * sigmaPixels(kBlueYellow1, pixelsPerDegree)));
}

// The narrow ones end earlier, where their weights are below a float's precision.
Kernel sensitivityKernel(const Sensitivity& sensitivity, double pixelsPerDegree) {
    const double sigma = sigmaPixels(sensitivity, pixelsPerDegree);
    return gaussianKernel(sigma, std::min(sensitivityRadius(pixelsPerDegree),
                                          static_cast<int>(std::ceil(6.0 * sigma))));
}

// A Gaussian's weight in the sum, before it was normalised: its height times the sum of its shape.
double massOf(const Sensitivity& sensitivity, const Kernel& normalised) {
    const double shapeSum = 1.0 / normalised.weights[0];
    return sensitivity.a * std::sqrt(kPi / sensitivity.b) * shapeSum * shapeSum;
}

// The two sides each sum to 1 where positive and to -1 where negative (sec. 4.2).
Kernel derivativeKernel(double sigma, int radius, Kernel::Kind kind) {
    Kernel kernel;
    kernel.kind = kind;
    double positive = 0.0;
    double negative = 0.0;
    for (int k = 0; k <= radius; ++k) {
        const double gaussian = std::exp(-0.5 * k * k / (sigma * sigma));
        const double weight =
            kind == Kernel::Kind::odd ? k * gaussian : (k * k / (sigma * sigma) - 1.0) * gaussian;
        kernel.weights.push_back(weight);
        // An odd kernel has one of each sign at every distance, an even one twice the same.
        const double both = k == 0 || kind == Kernel::Kind::odd ? weight : 2.0 * weight;
        (weight > 0.0 ? positive : negative) += both;
    }
    for (double& weight : kernel.weights)
        weight /= weight > 0.0 ? positive : -negative;
    if (kind == Kernel::Kind::odd) kernel.weights[0] = 0.0;
    return kernel;
}

struct Filters {
    Kernel achromatic, redGreen, blueYellow1, blueYellow2;
    float blueYellowShare1 = 0.0f;
    Kernel gaussian, edge, point;

    explicit Filters(double pixelsPerDegree)
        : achromatic(sensitivityKernel(kAchromatic, pixelsPerDegree)),
          redGreen(sensitivityKernel(kRedGreen, pixelsPerDegree)),
          blueYellow1(sensitivityKernel(kBlueYellow1, pixelsPerDegree)),
          blueYellow2(sensitivityKernel(kBlueYellow2, pixelsPerDegree)) {
        const double mass1 = massOf(kBlueYellow1, blueYellow1);
        const double mass2 = massOf(kBlueYellow2, blueYellow2);
        blueYellowShare1 = static_cast<float>(mass1 / (mass1 + mass2));
        const double sigma = 0.5 * kFeatureWidthDegrees * pixelsPerDegree;
        const int radius = static_cast<int>(std::ceil(3.0 * sigma));
        gaussian = gaussianKernel(sigma, radius);
        edge = derivativeKernel(sigma, radius, Kernel::Kind::odd);
        point = derivativeKernel(sigma, radius, Kernel::Kind::evenZeroSum);
    }
};

// What the eye sees of one picture.
struct Seen {
    Plane<float> lightness, a, b;  // CIELAB, with Hunt's adjustment
    Plane<float> edge, point;      // strengths
};

constexpr float ratioFromRgb(std::size_t row, std::size_t column) {
    return static_cast<float>(kXyzFromRgb[row][column] / kWhiteXyz[row]);
}
constexpr float rgbFromRatio(std::size_t row, std::size_t column) {
    return static_cast<float>(kRgbFromXyz[row][column] * kWhiteXyz[column]);
}

// X/Xn, Y/Yn or Z/Zn.
float ratio(std::size_t row, const float* rgb) {
    return ratioFromRgb(row, 0) * rgb[0] + ratioFromRgb(row, 1) * rgb[1] +
           ratioFromRgb(row, 2) * rgb[2];
}

Plane<float> strength(const Plane<float>& horizontal, const Plane<float>& vertical) {
    Plane<float> result(horizontal.width, horizontal.height);
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        const float x = horizontal.values[i];
        const float y = vertical.values[i];
        result.values[i] = std::sqrt(x * x + y * y);
    }
    return result;
}

// Filtered opponent channels to what is seen of them, in place.
void toHuntLab(Plane<float>& luminances, Plane<float>& redGreen, Plane<float>& blueYellow) {
    for (std::size_t i = 0; i < luminances.values.size(); ++i) {
        const float xyz[3] = {luminances.values[i] + redGreen.values[i], luminances.values[i],
                              luminances.values[i] - blueYellow.values[i]};
        float rgb[3];
        for (std::size_t row = 0; row < 3; ++row) {
            rgb[row] = std::clamp(rgbFromRatio(row, 0) * xyz[0] + rgbFromRatio(row, 1) * xyz[1] +
                                      rgbFromRatio(row, 2) * xyz[2],
                                  0.0f, 1.0f);
        }
        const float x = labCurve(ratio(0, rgb));
        const float y = labCurve(ratio(1, rgb));
        const float z = labCurve(ratio(2, rgb));
        const float lightness = 116.0f * y - 16.0f;
        luminances.values[i] = lightness;
        redGreen.values[i] = 0.01f * lightness * 500.0f * (x - y);
        blueYellow.values[i] = 0.01f * lightness * 200.0f * (y - z);
    }
}

Seen see(const RgbPlanes& picture, const Filters& filters) {
    const int width = picture[0].width;
    const int height = picture[0].height;
    // YCxCz without its scales and its offset: the filters are linear and keep the mean, so that
    // these would only be undone after them. Y of YCxCz from 0 to 1, as the features want it, too.
    Plane<float> luminances(width, height);
    Plane<float> redGreen(width, height);
    Plane<float> blueYellow(width, height);
    for (std::size_t i = 0; i < luminances.values.size(); ++i) {
        const float rgb[3] = {picture[0].values[i], picture[1].values[i], picture[2].values[i]};
        const float y = ratio(1, rgb);
        luminances.values[i] = y;
        redGreen.values[i] = ratio(0, rgb) - y;
        blueYellow.values[i] = y - ratio(2, rgb);
    }

    Seen seen;
    const Plane<float> smoothRows = convolveRows(luminances, filters.gaussian);
    seen.edge = strength(convolve(luminances, filters.edge, filters.gaussian),
                         convolveColumns(smoothRows, filters.edge));
    seen.point = strength(convolve(luminances, filters.point, filters.gaussian),
                          convolveColumns(smoothRows, filters.point));

    seen.lightness = convolve(luminances, filters.achromatic, filters.achromatic);
    seen.a = convolve(redGreen, filters.redGreen, filters.redGreen);
    seen.b = convolve(blueYellow, filters.blueYellow1, filters.blueYellow1);
    const Plane<float> second = convolve(blueYellow, filters.blueYellow2, filters.blueYellow2);
    for (std::size_t i = 0; i < second.values.size(); ++i) {
        seen.b.values[i] =
            second.values[i] + filters.blueYellowShare1 * (seen.b.values[i] - second.values[i]);
    }
    toHuntLab(seen.lightness, seen.a, seen.b);
    return seen;
}

float hyabDistance(const float* a, const float* b) {
    const float deltaA = a[1] - b[1];
    const float deltaB = a[2] - b[2];
    return std::abs(a[0] - b[0]) + std::sqrt(deltaA * deltaA + deltaB * deltaB);
}

// The largest distance there is: from green to blue, to the power q_c.
float largestColorDifference() {
    RgbPlanes primaries{Plane<float>(2, 1), Plane<float>(2, 1), Plane<float>(2, 1)};
    Plane<float> lab[3] = {Plane<float>(2, 1), Plane<float>(2, 1), Plane<float>(2, 1)};
    for (std::size_t i = 0; i < 2; ++i) {
        const float rgb[3] = {0.0f, i == 0 ? 1.0f : 0.0f, i == 0 ? 0.0f : 1.0f};
        lab[0].values[i] = ratio(1, rgb);
        lab[1].values[i] = ratio(0, rgb) - ratio(1, rgb);
        lab[2].values[i] = ratio(1, rgb) - ratio(2, rgb);
    }
    toHuntLab(lab[0], lab[1], lab[2]);
    const float green[3] = {lab[0].values[0], lab[1].values[0], lab[2].values[0]};
    const float blue[3] = {lab[0].values[1], lab[1].values[1], lab[2].values[1]};
    return std::pow(hyabDistance(green, blue), static_cast<float>(kColorExponent));
}

}  // namespace

Plane<float> flipMap(const RgbPlanes& image, const RgbPlanes& reference, double pixelsPerDegree) {
    assert(pixelsPerDegree >= 1.0 && pixelsPerDegree <= 1000.0);
    const Filters filters(pixelsPerDegree);
    const Seen first = see(image, filters);
    const Seen second = see(reference, filters);
    static const float largest = largestColorDifference();
    const float knee = static_cast<float>(kColorKnee) * largest;
    const float atKnee = static_cast<float>(kColorAtKnee);
    Plane<float> map(image[0].width, image[0].height);
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        const float labFirst[3] = {first.lightness.values[i], first.a.values[i], first.b.values[i]};
        const float labSecond[3] = {second.lightness.values[i], second.a.values[i],
                                    second.b.values[i]};
        const float distance = hyabDistance(labFirst, labSecond);
        if (distance == 0.0f) continue;  // 0 already, and most of a caustic layer is black
        const float power = std::pow(distance, static_cast<float>(kColorExponent));
        const float color = power < knee
                                ? atKnee / knee * power
                                : atKnee + (power - knee) / (largest - knee) * (1.0f - atKnee);
        const float feature = std::max(std::abs(first.edge.values[i] - second.edge.values[i]),
                                       std::abs(first.point.values[i] - second.point.values[i])) /
                              std::numbers::sqrt2_v<float>;
        map.values[i] = std::pow(std::min(color, 1.0f), 1.0f - std::sqrt(std::min(feature, 1.0f)));
    }
    return map;
}

Plane<float> ldrFlipMap(const ImagePair& pair, double white, double pixelsPerDegree) {
    const auto shown = [&](const Image& rgb) {
        RgbPlanes planes;
        for (std::size_t c = 0; c < 3; ++c) {
            planes[c] = Plane<float>(rgb.width, rgb.height);
            for (std::size_t i = 0; i < planes[c].values.size(); ++i) {
                const double value = static_cast<double>(rgb.values[3 * i + c]) / white;
                planes[c].values[i] = static_cast<float>(std::clamp(value, 0.0, 1.0));
            }
        }
        return planes;
    };
    return flipMap(shown(pair.image()), shown(pair.reference()), pixelsPerDegree);
}

double pooledMean(const ImagePair& pair, const Plane<float>& map) {
    double sum = 0.0;
    for (std::size_t pixel = 0; pixel < map.values.size(); ++pixel) {
        if (pair.counts(pixel)) sum += static_cast<double>(map.values[pixel]);
    }
    return sum / static_cast<double>(pair.countedPixels());
}

}  // namespace kaustik::measure
