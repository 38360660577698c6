// SPDX-License-Identifier: MIT
// media.none: the choice to leave in-scattered light out.
#include "framework/pipeline/frame_builder.h"

namespace kaustik {
namespace {

InScattered skipScattering(FrameBuilder& frame, const params::NoParams&, Hits /*hits*/,
                           EyeBuffer /*eye*/, InScattered before) {
    frame.skip("media.none", "the settings leave in-scattered light out");
    return before;
}

}  // namespace

void registerMediaNone(Registry& registry) {
    registry.node<MediaStage>("none",
                              {"Leaves in-scattered light out.", "",
                               "Light that a medium scatters is not in the picture; what the "
                               "medium takes from photons is lost to them all the same."},
                              &skipScattering);
}

}  // namespace kaustik
