// SPDX-License-Identifier: MIT
// The reference about the paths that a frame models.
#pragma once

#include <cstdint>

#include "framework/pipeline/photons.h"
#include "framework/reference/reference.h"

namespace kaustik::test {

// `photons`: how many are traced for it, of seed 1.
inline reference::Reference modelledReference(const reference::EmbreeScene& scene,
                                              const ModelledPaths& paths, int width, int height,
                                              std::uint64_t photons) {
    reference::ReferenceRequest request;
    request.width = width;
    request.height = height;
    request.filter.transmissionOnly = paths.transmissionOnly;
    request.filter.maximumInteractions = paths.interactions;
    reference::RunOptions options;
    options.stop.photons = photons;
    reference::PixelSums sums = makeSums(scene, request);
    addBatches(scene, request, options, sums);
    return makeReference(scene.scene(), request, sums, 0.0);
}

}  // namespace kaustik::test
