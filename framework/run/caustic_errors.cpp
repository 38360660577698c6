// SPDX-License-Identifier: MIT
#ifdef KAUSTIK_HAS_EMBREE

#include "framework/run/caustic_errors.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/core/error.h"
#include "framework/measure/flicker.h"
#include "framework/measure/heat_map.h"
#include "framework/measure/image_errors.h"
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
    const Image receiver = readTexture(renderer.texture(frame.eye.receiver), 0, 2);
    outputs.receiver = Image(receiver.width, receiver.height, 1);
    outputs.area = Image(receiver.width, receiver.height, 1);
    for (std::size_t i = 0; i < outputs.area.values.size(); ++i) {
        const bool sees = receiver.values[2 * i] > 0.0f;
        outputs.seesReceivers = outputs.seesReceivers || sees;
        outputs.receiver.values[i] = sees ? 1.0f : 0.0f;
        outputs.area.values[i] = sees ? receiver.values[2 * i + 1] : 0.0f;
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
        return {{"rms_w_m2", flicker.rms},
                {"truth_rms_w_m2", flicker.truthRms},
                {"difference_w_m2", flicker.difference()},
                {"truth_stderr_w_m2", flicker.truthStandardError},
                {"counted_pixels", flicker.countedPixels},
                {"of_times_s", {earlier.seconds, later.seconds}}};
    } catch (const IoError& error) {
        reason = error.what();
        return nullptr;
    }
}

json errorsAgainst(const Outputs& outputs, const Reference& reference) {
    json result = {{"reference_estimator",
                    reference.request.estimator == reference::Estimator::light ? "light" : "sppm"},
                   {"reference_photons", reference.photons},
                   {"reference_key", reference.key}};
    if (std::isfinite(reference.relativeError)) {
        result["reference_relative_stderr"] = reference.relativeError;
    } else {
        result["reference_relative_stderr"] = nullptr;
        result["reasons"]["reference_relative_stderr"] = "no pixel of the reference is lit";
    }
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

Image errorPicture(const measure::ImagePair& pair) {
    const measure::Plane<float> differences = measure::absoluteErrorPlane(pair);
    measure::ImageErrors errors;
    errors.scale = measure::referenceScale(pair);
    return measure::heatMap(pair, differences, measure::heatMapScale(errors, differences));
}

}  // namespace kaustik::run

#endif
