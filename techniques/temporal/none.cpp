// SPDX-License-Identifier: MIT
// temporal.none: irradiance as this frame's photons alone make it.
#include "framework/pipeline/frame_builder.h"
#include "techniques/shared/nodes.h"

namespace kaustik {
namespace {

IrradianceMap leaveFrameAlone(FrameBuilder& /*frame*/, const params::NoParams&,
                              IrradianceMap irradiance, EyeBuffer /*eye*/) {
    return irradiance;
}

}  // namespace

void registerNoTemporal(Registry& registry) {
    registry.node<TemporalStage>("none", {"Irradiance as this frame's photons alone make it.", ""},
                                 &leaveFrameAlone);
}

}  // namespace kaustik
