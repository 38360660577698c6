// SPDX-License-Identifier: MIT
// temporal.none: irradiance as this frame's photons alone make it.
#include "framework/pipeline/frame_builder.h"

namespace kaustik {
namespace {

IrradianceMap skipTemporal(FrameBuilder& /*frame*/, const params::NoParams&,
                           IrradianceMap irradiance, EyeBuffer /*eye*/) {
    return irradiance;
}

}  // namespace

void registerTemporalNone(Registry& registry) {
    registry.node<TemporalStage>("none",
                                 {"Irradiance as this frame's photons alone make it.", "",
                                  "Noise of single frames stays as it is."},
                                 &skipTemporal);
}

}  // namespace kaustik
