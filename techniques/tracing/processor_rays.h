// SPDX-License-Identifier: MIT
// Photons traced by Embree on all cores of the processor; there in builds with Embree alone.
#pragma once

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// The exact first hit of every photon, as a pass "trace.raytraced". The list is read back, and what
// was found is written to the device.
[[nodiscard]] Hits hitsByProcessor(FrameBuilder& frame, const Photons& photons,
                                   const Geometry& geometry);

}  // namespace kaustik
