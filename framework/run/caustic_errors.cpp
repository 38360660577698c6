// SPDX-License-Identifier: MIT
#ifdef KAUSTIK_HAS_EMBREE

#include "framework/run/caustic_errors.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "framework/audit/shadow_audit.h"
#include "framework/audit/view_audit.h"
#include "framework/core/error.h"
#include "framework/core/json_schema.h"
#include "framework/measure/bias.h"
#include "framework/measure/flicker.h"
#include "framework/measure/heat_map.h"
#include "framework/measure/image_errors.h"
#include "framework/report/seen_receivers.h"
#include "framework/run/output.h"

namespace kaustik::run {

using nlohmann::json;
using reference::Reference;

namespace {

constexpr const char* kNoReceiver = "no pixel of this view sees a receiver";

}  // namespace

Outputs readOutputs(const Renderer& renderer) {
    const FrameOutputs& frame = renderer.outputs();
    Outputs outputs;
    outputs.images.push_back({"caustic_irradiance",
                              readTexture(renderer.texture(frame.caustic.irradiance), 0, 3),
                              &Reference::irradiance, &Reference::irradianceError});
    if (frame.caustic.radiance.valid()) {
        outputs.images.push_back({"caustic_radiance",
                                  readTexture(renderer.texture(frame.caustic.radiance), 0, 3),
                                  &Reference::causticRadiance, &Reference::causticRadianceError});
    }
    if (frame.inScattered.radiance.valid()) {
        outputs.images.push_back({"in_scattered",
                                  readTexture(renderer.texture(frame.inScattered.radiance), 0, 3),
                                  &Reference::inScattered, &Reference::inScatteredError, false});
    }
    const Image samples = readTexture(renderer.texture(frame.eye.receiver), 0, 2);
    const std::vector<float> receiver =
        report::seenReceivers(samples.values, samples.width, renderer.samplesPerSide());
    const Image& picture = outputs.images.front().image;
    outputs.receiver = Image(picture.width, picture.height, 1);
    outputs.area = Image(picture.width, picture.height, 1);
    for (std::size_t i = 0; i < outputs.area.values.size(); ++i) {
        const bool sees = receiver[2 * i] > 0.0f;
        outputs.seesReceivers = outputs.seesReceivers || sees;
        outputs.receiver.values[i] = sees ? 1.0f : 0.0f;
        outputs.area.values[i] = receiver[2 * i + 1];
    }
    return outputs;
}

measure::ImagePair pairOf(const Outputs& outputs, const Output& output,
                          const Reference& reference) {
    return measure::ImagePair({.image = output.image,
                               .reference = reference.*output.groundTruth,
                               .mask = output.isOfReceivers ? &outputs.receiver : nullptr,
                               .standardError = &(reference.*output.groundTruthError),
                               .area = output.isOfReceivers ? &outputs.area : nullptr,
                               .imageName = output.name});
}

// What the errors are against.
struct ReferenceTable {
    bool isLightTracing = true;
    std::uint64_t photons = 0;
    std::string key;
    std::optional<double> relativeError;
};
template <class F>
void reflect(F& f, const ReferenceTable& table) {
    f.choice("reference_estimator", table.isLightTracing ? "light" : "sppm", {"light", "sppm"},
             "By which the reference was computed");
    f.field("reference_photons", table.photons, "That it was computed with");
    f.field("reference_key", table.key, "Made of all that it depends on");
    f.fieldOrNull("reference_relative_stderr", table.relativeError,
                  "no pixel of the reference is lit", "Its standard error over a lit pixel's mean");
}

struct FlickerTable {
    measure::Flicker flicker;
    std::array<double, 2> times{};
};
template <class F>
void reflect(F& f, const FlickerTable& table) {
    const measure::Flicker& flicker = table.flicker;
    f.field("rms_w_m2", flicker.rms, "Root mean square of the change of caustic irradiance");
    f.field("truth_rms_w_m2", flicker.truthRms, "The same of the reference");
    f.field("difference_w_m2", flicker.difference(), "The first less the second");
    f.field("truth_stderr_w_m2", flicker.truthStandardError, "Standard deviation of the second");
    f.field("counted_pixels", flicker.countedPixels, "That were compared");
    f.field("of_times_s", table.times, "Between which it changed");
}

json flickerBetween(const Outputs& outputs, const Moment& earlier, const Moment& later,
                    const Reference& earlierReference, const Reference& laterReference,
                    std::string& reason) {
    if (!outputs.seesReceivers) {
        reason = kNoReceiver;
        return nullptr;
    }
    const auto pairAt = [&](const Moment& moment, const Reference& reference) {
        return measure::ImagePair(
            {.image = moment.irradiance,
             .reference = reference.irradiance,
             .mask = &outputs.receiver,
             .standardError = &reference.irradianceError,
             .imageName = fmt::format("caustic_irradiance at {:g} s", moment.seconds)});
    };
    try {
        const measure::Flicker flicker = measure::measureFlicker(pairAt(earlier, earlierReference),
                                                                 pairAt(later, laterReference));
        return jsonOf(FlickerTable{flicker, {earlier.seconds, later.seconds}});
    } catch (const IoError& error) {
        reason = error.what();
        return nullptr;
    }
}

json errorsAgainst(const Outputs& outputs, const Reference& reference) {
    json result = jsonOf(ReferenceTable{reference.request.estimator == reference::Estimator::light,
                                        reference.photons, reference.key,
                                        std::isfinite(reference.relativeError)
                                            ? std::optional<double>(reference.relativeError)
                                            : std::nullopt});
    for (const Output& output : outputs.images) {
        if ((reference.*output.groundTruth).values.empty()) continue;
        if (output.isOfReceivers && !outputs.seesReceivers) {
            result[output.name] = nullptr;
            result["reasons"][output.name] = kNoReceiver;
            continue;
        }
        try {
            const measure::ImageErrors errors = measureErrors(pairOf(outputs, output, reference));
            result[output.name] = measure::toJson(errors);
            if (&output == &outputs.images.front())
                result["reference_stderr"] =
                    errors.referenceNoise ? errors.referenceNoise->rmse : 0.0;
        } catch (const IoError& error) {
            result[output.name] = nullptr;
            result["reasons"][output.name] = error.what();
        }
    }
    return result;
}

struct BiasTable {
    measure::Bias bias;
    bool isOfModelledPaths = false;
};
template <class F>
void reflect(F& f, const BiasTable& table) {
    f.choice("against", table.isOfModelledPaths ? "modelled_paths" : "all_paths",
             {"modelled_paths", "all_paths"}, "The reference's paths");
    f.field("judged_pixels", table.bias.judgedPixels,
            "All that count; none where the reference has no noise");
    f.field("too_bright", table.bias.tooBright, "Share of them, beyond the reference's noise");
    f.field("too_dark", table.bias.tooDark, "Share of them, beyond the reference's noise");
    f.field("by_chance", measure::Bias::kByChance, "What both shares are together of the truth");
}

json biasJson(const measure::ImagePair& pair, bool isOfModelledPaths) {
    return jsonOf(BiasTable{measure::findBias(pair), isOfModelledPaths});
}

json errorsSchema() {
    const auto against = [] {
        JsonFieldsSchema fields;
        reflect(fields, ReferenceTable());
        const json errors = JsonFieldsSchema::orNull(measure::imageErrorsSchema());
        fields.add("caustic_irradiance", errors,
                   "Of light that arrives by way of specular surfaces", false);
        fields.add("caustic_radiance", errors, "Of the same light towards the eye", false);
        fields.add("in_scattered", errors, "Of caustic light that a medium scatters", false);
        fields.add("reference_stderr", jsonSchemaOf<double>(),
                   "Root mean square of the reference's standard error, W/m²", false);
        return fields;
    };
    JsonFieldsSchema modelled = against();
    modelled.field("transmission_only", false, "Whether only refracted branches count");
    modelled.field("reflection_only", false, "Whether only reflected branches count");
    modelled.field("maximum_interactions", 0, "Most specular interactions of a photon");
    json view = audit::viewSchema();
    // Of a node that follows no rays only the picture is judged.
    view["required"] = {"radiance"};
    view["properties"]["radiance"] = JsonFieldsSchema::orNull(measure::imageErrorsSchema());
    view["properties"]["reasons"] = jsonSchemaOf<std::map<std::string, std::string>>();

    JsonFieldsSchema error = against();
    error.field("reference", std::string(), "auto, or a file");
    error.add("modelled_paths", modelled.take(),
              "Against the reference of the paths that the technique follows", false);
    error.add("bias", jsonSchemaOf<BiasTable>(),
              "Where the caustic is wrong by more than the reference's noise explains", false);
    error.add("flicker", JsonFieldsSchema::orNull(jsonSchemaOf<FlickerTable>()),
              "How much the caustic changes from frame to frame", false);
    error.add("shadow", audit::shadowSchema(), "Receivers on the wrong side of a shadow", false);
    error.add("view", JsonFieldsSchema::orNull(std::move(view)),
              "What the eye sees in and through specular surfaces", false);
    return error.take();
}

Image errorPicture(const measure::ImagePair& pair) {
    const measure::Plane<float> differences = measure::absoluteErrorPlane(pair);
    measure::ImageErrors errors;
    errors.scale = measure::referenceScale(pair);
    return measure::heatMap(pair, differences, measure::heatMapScale(errors, differences));
}

}  // namespace kaustik::run

#endif
