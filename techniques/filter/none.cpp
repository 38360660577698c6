// SPDX-License-Identifier: MIT
// filter.none: the map of flux as it was stored.
#include "framework/pipeline/frame_builder.h"

namespace kaustik {
namespace {

CausticMap skipFilter(FrameBuilder& /*frame*/, const params::NoParams&, CausticMap map) {
    return map;
}

}  // namespace

void registerFilterNone(Registry& registry) {
    registry.node<FilterStage>("none",
                               {"Leaves the map of flux as it was stored.", "",
                                "It takes what one map holds; where light is stored in several "
                                "sizes or levels the gather refuses it."},
                               &skipFilter);
}

}  // namespace kaustik
