// SPDX-License-Identifier: MIT
// kaustik compare: how wrong an image is against a reference, for people or as JSON, and where.
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/core/json_text.h"
#include "framework/image/image.h"
#include "framework/measure/heat_map.h"
#include "framework/measure/image_errors.h"
#include "framework/measure/image_file.h"

namespace kaustik::app {
namespace {

namespace fs = std::filesystem;
using measure::ImageErrors;
using nlohmann::json;

void checkRequest(const CompareOptions& options) {
    if (measure::isDisplayPicture(options.image) != measure::isDisplayPicture(options.reference)) {
        throw ConfigError(fmt::format(
            "{} and {} cannot be compared: one was made for a display and the other holds linear "
            "light.",
            options.image, options.reference));
    }
    if (const auto& ppd = options.pixelsPerDegree; ppd && !(*ppd > 0.0 && *ppd <= 1e4)) {
        throw ConfigError(fmt::format("--ppd: {} is not above 0 and at most 10000.", *ppd));
    }
    if (options.heatMapFile.empty()) return;
    const std::string extension = measure::lowerExtension(options.heatMapFile);
    if (extension != ".png" && extension != ".ppm") {
        throw ConfigError(fmt::format("--heatmap: {} is no picture's name; use .png or .ppm.",
                                      options.heatMapFile));
    }
    for (const std::string& input : {options.image, options.reference, options.maskFile,
                                     options.standardErrorFile, options.areaFile}) {
        std::error_code ignored;
        if (!input.empty() && fs::equivalent(input, options.heatMapFile, ignored)) {
            throw ConfigError(
                fmt::format("--heatmap: {} is one of the images to be compared; "
                            "choose another name.",
                            options.heatMapFile));
        }
    }
}

std::optional<Image> readOptional(const std::string& file) {
    if (file.empty()) return std::nullopt;
    return readImage(file);
}

// The value of a key, and next to it what a perfect image would get because of the reference's
// noise.
void printRow(const json& errors, const char* key, const char* name) {
    const json& value = errors.at(key);
    std::string text = fmt::format("{:<32}", name);
    if (value.is_null()) {
        text += fmt::format("none: {}", errors.at("reasons").at(key).get<std::string>());
    } else {
        text += fmt::format("{:<14.6g}", value.get<double>());
        const json noise = errors.value("truth_noise", json::object()).value(key, json());
        const char* const around = std::string_view(key) == "energy_ratio" ? "1 ± " : "";
        if (!noise.is_null()) text += fmt::format("{}{:.3g}", around, noise.get<double>());
    }
    text.erase(text.find_last_not_of(' ') + 1);
    fmt::print("{}\n", text);
}

void printTable(const CompareOptions& options, const measure::ImagePair& pair, const json& errors) {
    fmt::print("{} against {}: {}x{} pixels, {} counted\n\n", options.image, options.reference,
               pair.width(), pair.height(), pair.countedPixels());
    if (errors.contains("truth_noise")) {
        fmt::print("{:<32}{:<14}{}\n", "", "measured", "from the reference's noise alone");
    }
    constexpr std::array<std::array<const char*, 2>, 9> kRows{{
        {"rmse", "RMSE"},
        {"mae", "MAE"},
        {"rel_mse", "relMSE"},
        {"smape", "SMAPE of lit pixels"},
        {"ssim", "SSIM"},
        {"flip_ldr", "FLIP, one exposure"},
        {"flip_hdr", "FLIP, HDR"},
        {"energy_ratio", "energy ratio"},
        {"encircled_energy_radius_ratio", "encircled-energy radius ratio"},
    }};
    for (const auto& [key, name] : kRows)
        printRow(errors, key, name);

    const json& formulas = errors.at("formulas");
    fmt::print("\n");
    if (errors.at("rel_mse").is_null()) return;
    fmt::print("relMSE with epsilon {:.4g}", formulas.at("rel_mse").at("epsilon").get<double>());
    if (const json& white = formulas.at("flip_ldr").at("white"); !white.is_null()) {
        fmt::print("; SSIM and FLIP with {:.4g} as white", white.get<double>());
    }
    if (formulas.at("flip_hdr").contains("exposures")) {
        const json& exposures = formulas.at("flip_hdr").at("exposures");
        fmt::print("; HDR with {} exposures from {:.2f} to {:.2f} stops",
                   exposures.at("count").get<int>(), exposures.at("start_stops").get<double>(),
                   exposures.at("stop_stops").get<double>());
    }
    fmt::print("; formulas with --json.\n");
}

}  // namespace

void compareCommand(const CompareOptions& options) {
    checkRequest(options);
    const Image image = measure::readLinear(options.image);
    const Image reference = measure::readLinear(options.reference);
    const std::optional<Image> mask = readOptional(options.maskFile);
    const std::optional<Image> standardError = readOptional(options.standardErrorFile);
    const std::optional<Image> area = readOptional(options.areaFile);
    const measure::ImagePair pair({.image = image,
                                   .reference = reference,
                                   .mask = mask ? &*mask : nullptr,
                                   .standardError = standardError ? &*standardError : nullptr,
                                   .area = area ? &*area : nullptr,
                                   .imageName = options.image,
                                   .referenceName = options.reference,
                                   .maskName = options.maskFile,
                                   .standardErrorName = options.standardErrorFile,
                                   .areaName = options.areaFile});
    measure::MeasureParams params;
    params.pixelsPerDegree = options.pixelsPerDegree.value_or(params.pixelsPerDegree);
    if (measure::isDisplayPicture(options.reference)) params.displayWhite = 1.0;
    const ImageErrors errors = measure::measureErrors(pair, params);

    json result{{"schema", "kaustik.compare/1"},
                {"image", options.image},
                {"reference", options.reference},
                {"size", {pair.width(), pair.height()}},
                {"error", measure::toJson(errors)}};
    if (!options.heatMapFile.empty()) {
        const measure::Plane<float> differences = measure::absoluteErrorPlane(pair);
        const double scale = measure::heatMapScale(errors, differences);
        writeImage(options.heatMapFile, measure::heatMap(pair, differences, scale));
        result["heat_map"] = {{"file", options.heatMapFile},
                              {"quantity", "mean over RGB of |I - R|"},
                              {"black_at", 0.0},
                              {"brightest_at", scale}};
    }
    if (options.json) {
        fmt::print("{}\n", jsonText(result, 2));
        return;
    }
    printTable(options, pair, result.at("error"));
    if (result.contains("heat_map")) {
        fmt::print("{}: |I - R| from 0 (black) to {:.4g} (brightest).\n", options.heatMapFile,
                   result.at("heat_map").at("brightest_at").get<double>());
    }
}

}  // namespace kaustik::app
