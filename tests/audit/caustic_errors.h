// SPDX-License-Identifier: MIT
// The errors of a frame's caustic against a reference of the same size.
#pragma once

#include "framework/measure/image_errors.h"
#include "framework/reference/reference.h"
#include "tests/audit/shipped_scenes.h"

namespace kaustik::test {

// Over the pixels that see a receiver, each by the area that it sees.
inline measure::ImageErrors causticErrors(const Renderer& renderer,
                                          const reference::Reference& reference) {
    const FrameOutputs& outputs = renderer.outputs();
    const Image image = imageOf(renderer.texture(outputs.caustic.irradiance), 0, 3);
    Image receiver = imageOf(renderer.texture(outputs.eye.receiver), 0, 1);
    Image area = imageOf(renderer.texture(outputs.eye.receiver), 1, 1);
    for (std::size_t i = 0; i < area.values.size(); ++i) {
        const bool sees = receiver.values[i] > 0.0f;
        receiver.values[i] = sees ? 1.0f : 0.0f;
        area.values[i] = sees ? area.values[i] : 0.0f;
    }
    const measure::ImagePair pair({.image = image,
                                   .reference = reference.irradiance,
                                   .mask = &receiver,
                                   .standardError = &reference.irradianceError,
                                   .area = &area});
    return measure::measureErrors(pair);
}

}  // namespace kaustik::test
