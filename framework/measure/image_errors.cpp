// SPDX-License-Identifier: MIT
#include "framework/measure/image_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "framework/measure/ssim.h"

namespace kaustik::measure {
namespace {

using nlohmann::json;

constexpr const char* kMean = "mean over counted pixels and RGB channels";

json orNull(const std::optional<double>& value) {
    return value ? json(*value) : json(nullptr);
}

std::optional<double> radiusRatio(const ImageErrors& errors) {
    if (!errors.encircledEnergy) return std::nullopt;
    return errors.encircledEnergy->radiusRatio;
}

json radiiJson(const EncircledEnergyComparison& radii) {
    json entry{{"image_px", radii.image.radiusPixels},
               {"reference_px", radii.reference.radiusPixels},
               {"image_centre_px", {radii.image.centreX, radii.image.centreY}},
               {"reference_centre_px", {radii.reference.centreX, radii.reference.centreY}}};
    if (radii.imageRadiusMeters) {
        entry["image_m"] = *radii.imageRadiusMeters;
        entry["reference_m"] = *radii.referenceRadiusMeters;
    }
    return entry;
}

json formulasJson(const ImageErrors& errors) {
    const EncircledEnergyParams& circle = errors.params.encircledEnergy;
    json flipHdr{{"text",
                  "Andersson et al. 2021: largest FLIP over exposures (ACES-like tone curve), mean "
                  "over counted pixels"},
                 {"pixels_per_degree", errors.params.pixelsPerDegree}};
    if (errors.exposures) {
        flipHdr["exposures"] = {
            {"start_stops", errors.exposures->start},
            {"stop_stops", errors.exposures->stop},
            {"count", errors.exposures->count},
            {"rule", errors.params.exposures ? "given"
                                             : "brightest luminance of the reference, to the one "
                                               "that 90 % of its flux exceeds, shown as 0.85"}};
    }
    const char* const whiteRule =
        errors.params.displayWhite
            ? "given"
            : "pixels of the reference at least this bright hold 10 % of its flux";
    return {
        {"rmse", {{"text", fmt::format("sqrt(mean((I - R)^2)), {}", kMean)}}},
        {"mae", {{"text", fmt::format("mean(|I - R|), {}", kMean)}}},
        {"rel_mse",
         {{"text", fmt::format("mean((I - R)^2 / (R^2 + epsilon)), {}", kMean)},
          {"epsilon", errors.relMseEpsilon},
          {"epsilon_rule",
           "0.01 s^2, where pixels of the reference with luminance of at least s hold 50 % of its "
           "flux"}}},
        {"ssim",
         {{"text",
           "Wang et al. 2004: 11x11 Gaussian, sigma 1.5, K1 0.01, K2 0.03, L 1, of "
           "sRGB(clamp(luminance / white)); mean over counted pixels with the window inside"},
          {"white", orNull(errors.displayWhite)},
          {"white_rule", whiteRule}}},
        {"flip_ldr",
         {{"text",
           "Andersson et al. 2020, of clamp(I / white) and clamp(R / white), mean over counted "
           "pixels"},
          {"pixels_per_degree", errors.params.pixelsPerDegree},
          {"white", orNull(errors.displayWhite)},
          {"white_rule", whiteRule}}},
        {"flip_hdr", std::move(flipHdr)},
        {"energy_ratio", {{"text", "sum(area I) / sum(area R), over counted pixels and channels"}}},
        {"encircled_energy_radius_ratio",
         {{"text",
           "radius that holds the share of the flux, of I over that of R, each around its "
           "own centre"},
          {"share", circle.share},
          {"centre", circle.centre == EnergyCentre::centroid ? "centroid" : "brightest"}}},
    };
}

}  // namespace

ImageErrors measureErrors(const ImagePair& pair, const MeasureParams& params) {
    ImageErrors errors;
    errors.params = params;
    errors.countedPixels = pair.countedPixels();
    errors.scale = referenceScale(pair);
    errors.rmse = rootMeanSquareError(pair);
    errors.mae = meanAbsoluteError(pair);
    errors.relMseEpsilon = relMseEpsilon(errors.scale);
    if (errors.relMseEpsilon > 0.0) {
        errors.relMse = relativeMeanSquareError(pair, errors.relMseEpsilon);
    }
    errors.displayWhite = params.displayWhite;
    errors.exposures = params.exposures;
    if (!errors.scale.isBlack()) {
        if (!errors.displayWhite) errors.displayWhite = errors.scale.white;
        if (!errors.exposures) errors.exposures = defaultExposures(errors.scale);
    }
    if (errors.displayWhite) {
        errors.ssim = ssim(pair, *errors.displayWhite);
        errors.flipLdr =
            pooledMean(pair, ldrFlipMap(pair, *errors.displayWhite, params.pixelsPerDegree));
    }
    if (errors.exposures) {
        errors.flipHdr =
            pooledMean(pair, hdrFlipMap(pair, *errors.exposures, params.pixelsPerDegree));
    }
    if (totalFlux(pair, pair.reference()) != 0.0) errors.energyRatio = energyRatio(pair);
    errors.encircledEnergy = compareEncircledEnergy(pair, params.encircledEnergy);
    if (pair.hasStandardError()) errors.referenceNoise = referenceNoise(pair, errors.relMseEpsilon);
    return errors;
}

std::string whyAbsent(const ImageErrors& errors, std::string_view key) {
    const char* const black = "the reference is black, which gives no scale to judge by";
    if (key == "rel_mse" && !errors.relMse) return black;
    if (key == "flip_ldr" && !errors.flipLdr) return black;
    if (key == "flip_hdr" && !errors.flipHdr) return black;
    if (key == "ssim" && !errors.ssim) {
        return errors.displayWhite
                   ? "no counted pixel is 5 pixels or more from the border, as SSIM's window needs"
                   : black;
    }
    if (key == "energy_ratio" && !errors.energyRatio) return "the reference holds no flux";
    if (key == "encircled_energy_radius_ratio" && !errors.encircledEnergy) {
        return "the image or the reference holds no flux";
    }
    return "";
}

json toJson(const ImageErrors& errors) {
    json result{{"rmse", errors.rmse},
                {"rel_mse", orNull(errors.relMse)},
                {"mae", errors.mae},
                {"ssim", orNull(errors.ssim)},
                {"flip_ldr", orNull(errors.flipLdr)},
                {"flip_hdr", orNull(errors.flipHdr)},
                {"energy_ratio", orNull(errors.energyRatio)},
                {"encircled_energy_radius_ratio", orNull(radiusRatio(errors))},
                {"counted_pixels", errors.countedPixels},
                {"formulas", formulasJson(errors)}};
    json reasons = json::object();
    for (const auto& [key, value] : result.items()) {
        if (value.is_null()) reasons[key] = whyAbsent(errors, key);
    }
    if (!reasons.empty()) result["reasons"] = std::move(reasons);
    if (errors.encircledEnergy) {
        result["encircled_energy_radius"] = radiiJson(*errors.encircledEnergy);
    }
    if (const auto& noise = errors.referenceNoise) {
        result["truth_noise"] = {
            {"rmse", noise->rmse},
            {"mae", noise->mae},
            {"rel_mse", errors.relMse ? json(noise->relMse) : json(nullptr)},
            {"energy_ratio", errors.energyRatio ? json(noise->energyRatio) : json(nullptr)}};
    }
    return result;
}

double heatMapScale(const ImageErrors& errors, const Plane<float>& absoluteErrors) {
    if (errors.scale.typical > 0.0) return errors.scale.typical;
    const float largest =
        *std::max_element(absoluteErrors.values.begin(), absoluteErrors.values.end());
    return largest > 0.0f ? static_cast<double>(largest) : 1.0;
}

}  // namespace kaustik::measure
