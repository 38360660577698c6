// SPDX-License-Identifier: MIT
// How far the light is spread: the radius around a centre that holds a share of an image's flux. It
// tells a blurred focus from a displaced one, where squared errors depend on the resolution.
#pragma once

#include <optional>

#include "framework/measure/image_pair.h"

namespace kaustik::measure {

enum class EnergyCentre {
    centroid,  // of the flux
    brightest  // the middle of the pixel with the most irradiance; the first of equals
};

struct EncircledEnergyParams {
    double share = 0.5;  // of the flux, in (0, 1)
    EnergyCentre centre = EnergyCentre::centroid;
    // Side of a pixel on the receiver; 0 where it is not known and the pair has no areas. Otherwise
    // the root of the mean area of the pixels, each weighted with its flux in the reference.
    double metersPerPixel = 0.0;
};

struct EncircledEnergy {
    double centreX = 0.0;  // pixels; the first pixel's middle is at 0.5
    double centreY = 0.0;
    double radiusPixels = 0.0;
};

struct EncircledEnergyComparison {
    EncircledEnergy image;
    EncircledEnergy reference;
    double radiusRatio = 1.0;                 // the image's over the reference's
    std::optional<double> imageRadiusMeters;  // where the size of a pixel is known
    std::optional<double> referenceRadiusMeters;
};

// Measures one of the pair's two images. Flux is the sum of the channels, 0 where that is negative,
// times the pixel's area, evenly spread over the pixel's square. There is no result where there is
// no flux.
[[nodiscard]] std::optional<EncircledEnergy> encircledEnergy(const ImagePair& pair,
                                                             const Image& imageOfPair,
                                                             const EncircledEnergyParams& params);

// Measures each image around its own centre. There is no result where one of the two holds no flux.
[[nodiscard]] std::optional<EncircledEnergyComparison> compareEncircledEnergy(
    const ImagePair& pair, const EncircledEnergyParams& params);

}  // namespace kaustik::measure
