// SPDX-License-Identifier: MIT
// blur.none: the choice to leave in-scattered light as it is.
#include "framework/pipeline/frame_builder.h"

namespace kaustik {
namespace {

InScattered skipBlur(FrameBuilder& frame, const params::NoParams&, InScattered sharp) {
    frame.skip("blur.none", "the settings leave in-scattered light as it is");
    return sharp;
}

}  // namespace

void registerBlurNone(Registry& registry) {
    registry.node<BlurStage>(
        "none",
        {"Leaves in-scattered light as it is.", "", "Stripes of few photons stay as they are."},
        &skipBlur);
}

}  // namespace kaustik
