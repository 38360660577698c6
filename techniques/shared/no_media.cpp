// SPDX-License-Identifier: MIT
// media.none, blur.none: the choice to leave in-scattered light out, or as it is.
#include "framework/pipeline/frame_builder.h"
#include "techniques/shared/nodes.h"

namespace kaustik {
namespace {

InScattered leaveOutScattering(FrameBuilder& frame, const params::NoParams&, Hits /*hits*/,
                               EyeBuffer /*eye*/, InScattered before) {
    frame.skip("media.none", "the settings leave in-scattered light out");
    return before;
}

InScattered leaveUnblurred(FrameBuilder& frame, const params::NoParams&, InScattered sharp) {
    frame.skip("blur.none", "the settings leave in-scattered light as it is");
    return sharp;
}

}  // namespace

void registerNoMedia(Registry& registry) {
    registry.node<MediaStage>("none", {"Leaves in-scattered light out.", ""}, &leaveOutScattering);
}

void registerNoBlur(Registry& registry) {
    registry.node<BlurStage>("none", {"Leaves in-scattered light as it is.", ""}, &leaveUnblurred);
}

}  // namespace kaustik
