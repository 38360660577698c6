// SPDX-License-Identifier: MIT
#include "framework/measure/encircled_energy.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace kaustik::measure {
namespace {

constexpr double kBinsPerPixel = 16.0;
// A pixel near the centre is seen under many distances; far away they hardly differ.
constexpr double kNearPixels = 8.0;
constexpr int kSamplesNear = 16;  // along each side of a pixel
constexpr int kSamplesFar = 4;

double irradianceOf(const Image& image, std::size_t pixel) {
    const float* const color = image.values.data() + 3 * pixel;
    return std::max(0.0, static_cast<double>(color[0]) + static_cast<double>(color[1]) +
                             static_cast<double>(color[2]));
}

template <class Body>
void forEachLitPixel(const ImagePair& pair, const Image& image, const Body& body) {
    std::size_t pixel = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x, ++pixel) {
            const double irradiance = irradianceOf(image, pixel);
            const double flux = irradiance * pair.area(pixel);
            if (flux > 0.0) body(x + 0.5, y + 0.5, flux, irradiance);
        }
    }
}

// The radius at which the sum of the bins, which are `1 / kBinsPerPixel` wide, reaches `flux`.
double radiusOf(const std::vector<double>& bins, double flux) {
    double sum = 0.0;
    for (std::size_t bin = 0; bin < bins.size(); ++bin) {
        if (sum + bins[bin] >= flux && bins[bin] > 0.0) {
            // Within the bin the flux grows with the area, as it does for an even light.
            const double inner = static_cast<double>(bin);
            const double outer = inner + 1.0;
            const double part = (flux - sum) / bins[bin];
            return std::sqrt(inner * inner + part * (outer * outer - inner * inner)) /
                   kBinsPerPixel;
        }
        sum += bins[bin];
    }
    return static_cast<double>(bins.size()) / kBinsPerPixel;
}

}  // namespace

std::optional<EncircledEnergy> encircledEnergy(const ImagePair& pair, const Image& imageOfPair,
                                               const EncircledEnergyParams& params) {
    assert(params.share > 0.0 && params.share < 1.0);
    double total = 0.0;
    double sumX = 0.0;
    double sumY = 0.0;
    double brightest = 0.0;
    EncircledEnergy result;
    forEachLitPixel(pair, imageOfPair, [&](double x, double y, double flux, double irradiance) {
        total += flux;
        sumX += flux * x;
        sumY += flux * y;
        if (irradiance > brightest) {
            brightest = irradiance;
            result.centreX = x;
            result.centreY = y;
        }
    });
    if (total <= 0.0) return std::nullopt;
    if (params.centre == EnergyCentre::centroid) {
        result.centreX = sumX / total;
        result.centreY = sumY / total;
    }

    const double largestRadius = std::hypot(pair.width(), pair.height()) + 1.0;
    std::vector<double> bins(static_cast<std::size_t>(std::ceil(largestRadius * kBinsPerPixel)));
    forEachLitPixel(pair, imageOfPair, [&](double x, double y, double flux, double) {
        const double dx = x - result.centreX;
        const double dy = y - result.centreY;
        const bool isNear = dx * dx + dy * dy < kNearPixels * kNearPixels;
        const int samples = isNear ? kSamplesNear : kSamplesFar;
        const double part = flux / (samples * samples);
        for (int j = 0; j < samples; ++j) {
            const double sampleY = dy + (j + 0.5) / samples - 0.5;
            for (int i = 0; i < samples; ++i) {
                const double sampleX = dx + (i + 0.5) / samples - 0.5;
                const double radius = std::sqrt(sampleX * sampleX + sampleY * sampleY);
                bins[static_cast<std::size_t>(radius * kBinsPerPixel)] += part;
            }
        }
    });
    result.radiusPixels = radiusOf(bins, params.share * total);
    return result;
}

std::optional<EncircledEnergyComparison> compareEncircledEnergy(
    const ImagePair& pair, const EncircledEnergyParams& params) {
    const auto image = encircledEnergy(pair, pair.image(), params);
    const auto reference = encircledEnergy(pair, pair.reference(), params);
    if (!image || !reference) return std::nullopt;
    EncircledEnergyComparison comparison;
    comparison.image = *image;
    comparison.reference = *reference;
    comparison.radiusRatio = image->radiusPixels / reference->radiusPixels;

    double metersPerPixel = params.metersPerPixel;
    if (metersPerPixel <= 0.0 && pair.hasArea()) {
        double flux = 0.0;
        double fluxTimesArea = 0.0;
        for (std::size_t pixel = 0; pixel < pair.pixelCount(); ++pixel) {
            const double pixelFlux = irradianceOf(pair.reference(), pixel) * pair.area(pixel);
            flux += pixelFlux;
            fluxTimesArea += pixelFlux * pair.area(pixel);
        }
        metersPerPixel = std::sqrt(fluxTimesArea / flux);
    }
    if (metersPerPixel > 0.0) {
        comparison.imageRadiusMeters = image->radiusPixels * metersPerPixel;
        comparison.referenceRadiusMeters = reference->radiusPixels * metersPerPixel;
    }
    return comparison;
}

}  // namespace kaustik::measure
