// SPDX-License-Identifier: MIT
// The caustic outputs of a frame, read back once, and how wrong each is against a reference. Needs
// Embree's part of the build: KAUSTIK_HAS_EMBREE.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/image/image.h"
#include "framework/measure/image_pair.h"
#include "framework/pipeline/renderer.h"
#include "framework/reference/reference.h"

namespace kaustik::run {

// An output of the frame next to the same of a reference.
struct Output {
    const char* name;  // in the report
    Image image;
    Image reference::Reference::*groundTruth;
    Image reference::Reference::*groundTruthError;
    // Whether it is of receivers: pixels that see none do not count then, and the others by the
    // area that they see.
    bool isOfReceivers = true;
};

// What the frame is judged by, read back once.
struct Outputs {
    std::vector<Output> images;  // the first is the caustic irradiance
    Image receiver;              // 1 where the pixel sees one, else 0
    Image area;                  // of the receiver that the pixel sees, m²
    bool seesReceivers = false;
};

// Reads the outputs of the frame that was rendered last; waits for the device. eye.receiver must
// have been kept.
[[nodiscard]] Outputs readOutputs(const Renderer& renderer);

[[nodiscard]] measure::ImagePair pairOf(const Outputs& outputs, const Output& output,
                                        const reference::Reference& reference);

// Every output's errors against one reference; what that does not have is left out. An output that
// holds values that are no numbers has no errors, but a reason.
[[nodiscard]] nlohmann::json errorsAgainst(const Outputs& outputs,
                                           const reference::Reference& reference);

// The JSON Schema of a report's `error`: of these errors, and of what RunReference adds to them.
[[nodiscard]] nlohmann::json errorsSchema();

// The caustic irradiance of a frame, and when that was.
struct Moment {
    double seconds = 0.0;
    Image irradiance;
};

// How much the caustic changes between two moments of which the references are; `outputs` say which
// pixels count. Null where a value is no number or no pixel counts, with a sentence in `reason`.
[[nodiscard]] nlohmann::json flickerBetween(const Outputs& outputs, const Moment& earlier,
                                            const Moment& later,
                                            const reference::Reference& earlierReference,
                                            const reference::Reference& laterReference,
                                            std::string& reason);

// How many pixels are wrong by more than the reference's noise (measure/bias.h), for the report.
[[nodiscard]] nlohmann::json biasJson(const measure::ImagePair& pair, bool isOfModelledPaths);

// Shows where the image is wrong, as heat colours.
[[nodiscard]] Image errorPicture(const measure::ImagePair& pair);

}  // namespace kaustik::run
