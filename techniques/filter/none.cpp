// SPDX-License-Identifier: MIT
// filter.none: the map of flux as it was stored.
#include "framework/pipeline/frame_builder.h"
#include "techniques/shared/nodes.h"

namespace kaustik {
namespace {

CausticMap leaveUnfiltered(FrameBuilder& /*frame*/, const params::NoParams&, CausticMap map) {
    return map;
}

}  // namespace

void registerNoFilter(Registry& registry) {
    registry.node<FilterStage>("none", {"Leaves the map of flux as it was stored.", ""},
                               &leaveUnfiltered);
}

}  // namespace kaustik
