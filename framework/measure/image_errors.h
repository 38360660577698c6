// SPDX-License-Identifier: MIT
// All measures of one image, and the same as the JSON of report.json's `error` entries.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "framework/measure/encircled_energy.h"
#include "framework/measure/flip_hdr.h"
#include "framework/measure/image_pair.h"
#include "framework/measure/pointwise.h"
#include "framework/measure/reference_scale.h"

namespace kaustik::measure {

struct MeasureParams {
    double pixelsPerDegree = kFlipPixelsPerDegree;
    // The luminance that SSIM and LDR-FLIP show as the display's 1: for images made for a display,
    // 1. Otherwise referenceScale().white.
    std::optional<double> displayWhite;
    std::optional<ExposureRange> exposures;  // of HDR-FLIP; otherwise defaultExposures()
    EncircledEnergyParams encircledEnergy;
};

// A value that does not exist is absent, and `absenceReason` says why: a black reference has no
// scale.
struct ImageErrors {
    double rmse = 0.0;
    double mae = 0.0;
    std::optional<double> relMse;
    std::optional<double> smape;
    std::optional<double> ssim;
    std::optional<double> flipLdr;
    std::optional<double> flipHdr;
    std::optional<double> energyRatio;
    double referenceFlux = 0.0;  // mean of the channels; W where areas are known
    std::optional<EncircledEnergyComparison> encircledEnergy;
    std::optional<ReferenceNoise> referenceNoise;  // where the pair has a standard error

    // What they were measured with.
    std::size_t countedPixels = 0;
    std::size_t litPixels = 0;  // of them
    double relMseEpsilon = 0.0;
    std::optional<double> displayWhite;
    std::optional<ExposureRange> exposures;
    MeasureParams params;
    ReferenceScale scale;
};

[[nodiscard]] ImageErrors measureErrors(const ImagePair& pair, const MeasureParams& params = {});

// rmse, rel_mse, smape, mae, ssim, flip_ldr, flip_hdr, energy_ratio and
// encircled_energy_radius_ratio (null, with a sentence under `reasons`, where absent); the radii;
// `truth_noise` where known; and `formulas`, each with its text and the numbers that went into it.
[[nodiscard]] nlohmann::json toJson(const ImageErrors& errors);
[[nodiscard]] nlohmann::json imageErrorsSchema();

// Why the value under that key of the JSON is absent, or "" where it is there.
[[nodiscard]] std::string absenceReason(const ImageErrors& errors, std::string_view key);

// The full scale of a heat map of |I - R| which is the same for all images with this reference:
// its typical luminance; the largest error where the reference is black. Never 0.
[[nodiscard]] double heatMapScale(const ImageErrors& errors, const Plane<float>& absoluteErrors);

}  // namespace kaustik::measure
