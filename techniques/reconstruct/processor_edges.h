// SPDX-License-Identifier: MIT
// What is seen at the places of pixels at an edge, found by Embree on all cores; there in builds
// with Embree alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "framework/reference/embree_scene.h"
#include "framework/render/view.h"
#include "techniques/reconstruct/edge_samples.h"

namespace kaustik {

// kEdgeSamples a pixel, x + 65536 y, in their order.
[[nodiscard]] std::vector<SeenAtPlace> seenAtPlaces(const reference::EmbreeScene& scene,
                                                    const render::RasterView& eye,
                                                    std::span<const std::uint32_t> pixels);

}  // namespace kaustik
