// SPDX-License-Identifier: MIT
#include "framework/measure/image_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "framework/core/json_schema.h"
#include "framework/measure/ssim.h"

namespace kaustik::measure {
namespace {

using nlohmann::json;

constexpr const char* kMean = "mean over counted pixels and RGB channels";

json orNull(const std::optional<double>& value) {
    return value ? json(*value) : json(nullptr);
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
        {"smape",
         {{"text",
           "mean(|I - R| / (|I| + |R|)) over RGB channels of the counted pixels in which the "
           "luminance of R is more than three times that of its standard error, or, without one, "
           "more than 0"},
          {"lit_pixels", errors.litPixels}}},
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
    const std::vector<unsigned char> lit = litPixels(pair);
    errors.litPixels = static_cast<std::size_t>(std::count(lit.begin(), lit.end(), 1));
    if (errors.litPixels > 0) errors.smape = symmetricRelativeError(pair, lit);
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
    errors.referenceFlux = totalFlux(pair, pair.reference()) / 3.0;
    if (errors.referenceFlux != 0.0) errors.energyRatio = energyRatio(pair);
    errors.encircledEnergy = compareEncircledEnergy(pair, params.encircledEnergy);
    if (pair.hasStandardError())
        errors.referenceNoise = referenceNoise(pair, errors.relMseEpsilon, lit);
    return errors;
}

std::string absenceReason(const ImageErrors& errors, std::string_view key) {
    const char* const black = "the reference is black, which gives no scale to judge by";
    if (key == "rel_mse" && !errors.relMse) return black;
    if (key == "smape" && !errors.smape) {
        return errors.scale.isBlack() ? black
                                      : "no pixel of the reference is brighter than its noise";
    }
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

struct RadiiTable {
    EncircledEnergyComparison radii;
};
template <class F>
void reflect(F& f, const RadiiTable& table) {
    const EncircledEnergyComparison& radii = table.radii;
    f.field("image_px", radii.image.radiusPixels, "The image's radius");
    f.field("reference_px", radii.reference.radiusPixels, "The reference's radius");
    f.field("image_centre_px", std::array{radii.image.centreX, radii.image.centreY},
            "From the upper left corner");
    f.field("reference_centre_px", std::array{radii.reference.centreX, radii.reference.centreY},
            "From the upper left corner");
    f.field("image_m", radii.imageRadiusMeters, "Where the size of a pixel is known");
    f.field("reference_m", radii.referenceRadiusMeters, "Where the size of a pixel is known");
}

struct NoiseTable {
    ReferenceNoise noise;
    bool hasRelMse = false;
    bool hasSmape = false;
    bool hasEnergyRatio = false;
};
template <class F>
void reflect(F& f, const NoiseTable& table) {
    const auto where = [](bool isThere, double value) {
        return isThere ? std::optional(value) : std::nullopt;
    };
    f.field("rmse", table.noise.rmse, "");
    f.field("mae", table.noise.mae, "");
    f.fieldOrNull("rel_mse", where(table.hasRelMse, table.noise.relMse), "", "");
    f.fieldOrNull("smape", where(table.hasSmape, table.noise.smape), "", "");
    f.fieldOrNull("energy_ratio", where(table.hasEnergyRatio, table.noise.energyRatio), "",
                  "One standard deviation");
}

template <class F>
void reflect(F& f, const ImageErrors& errors) {
    const auto orNull = [&](const char* key, const std::optional<double>& value,
                            const char* sentence) {
        f.fieldOrNull(key, value, absenceReason(errors, key), sentence);
    };
    std::optional<double> radiusRatio;
    std::optional<RadiiTable> radii;
    std::optional<NoiseTable> noise;
    if (errors.encircledEnergy) {
        radiusRatio = errors.encircledEnergy->radiusRatio;
        radii = {*errors.encircledEnergy};
    }
    if (errors.referenceNoise) {
        noise = {*errors.referenceNoise, errors.relMse.has_value(), errors.smape.has_value(),
                 errors.energyRatio.has_value()};
    }
    f.field("rmse", errors.rmse, "Root mean square error");
    orNull("rel_mse", errors.relMse, "Mean square error relative to the reference");
    orNull("smape", errors.smape,
           "Symmetric relative error of lit pixels, 0 to 1, weak light as much as bright");
    f.field("mae", errors.mae, "Mean absolute error");
    orNull("ssim", errors.ssim, "Structural similarity");
    orNull("flip_ldr", errors.flipLdr, "FLIP of the images as a display shows them");
    orNull("flip_hdr", errors.flipHdr, "The largest FLIP over exposures");
    orNull("energy_ratio", errors.energyRatio, "Flux over the reference's");
    f.field("reference_flux", errors.referenceFlux,
            "The reference's, mean of the channels: W where areas of pixels are known, else a sum");
    orNull("encircled_energy_radius_ratio", radiusRatio,
           "Radius that holds a share of the flux, over the reference's");
    f.field("encircled_energy_radius", radii, "These radii");
    f.field("truth_noise", noise, "What the reference's own error makes of each measure");
    f.field("counted_pixels", errors.countedPixels, "That were compared");
    f.field("formulas", formulasJson(errors), "By measure: its formula and parameters");
}

json toJson(const ImageErrors& errors) {
    return jsonOf(errors);
}

json imageErrorsSchema() {
    return jsonSchemaOf<ImageErrors>();
}

double heatMapScale(const ImageErrors& errors, const Plane<float>& absoluteErrors) {
    if (errors.scale.typical > 0.0) return errors.scale.typical;
    const float largest =
        *std::max_element(absoluteErrors.values.begin(), absoluteErrors.values.end());
    return largest > 0.0f ? static_cast<double>(largest) : 1.0;
}

}  // namespace kaustik::measure
