// SPDX-License-Identifier: MIT
// By how much a light that has a size spreads a photon: the light that comes to the photon's place
// from all of the disc that its point stands for (scene::Light::radius) is wider than from the
// point, in two more directions than the next cells' light is. Both go on to first order, as beams
// do (shaders/include/photons/beam.glsl).
#pragma once

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// The same hits, whose photons carry it where a node uses it (FrameFacts::widensByLights).
[[nodiscard]] Hits spreadByLights(FrameBuilder& frame, Hits emitted);

}  // namespace kaustik
