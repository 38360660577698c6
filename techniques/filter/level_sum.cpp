// SPDX-License-Identifier: MIT
// filter.level_sum: all levels of a multi-resolution map added up (WN09, section 3.2.2). In: the
// levels of reconstruct.multi_level; out: flux a texel, W, which is kept.
#include <utility>

#include "techniques/maps/levels.h"
#include "techniques/maps/map_filters.h"
#include "techniques/maps/map_needs.h"

namespace kaustik {
namespace {

CausticMap addLevels(FrameBuilder& frame, const params::NoParams&, CausticMap map) {
    needsMap("filter.level_sum", map, {SetLayout::sharedLevels});
    return filterMaps(
        frame, "filter.level_sum", "each place gets what every level holds of it", std::move(map),
        [](graph::PassSetup&, Filtered&) {},
        [](const Filtered& data, gl::PassContext& context) {
            const Views& views = data.map.on.views;
            gl::Command command = filterCommand(context, "filter/level_sum.comp", data.map);
            setLevelLayout(command, data.map);
            command.set("levels", levelsOf(views->width(), views->height()));
            dispatchOverMap(command, data.map);
        });
}

}  // namespace

void registerFilterLevelSum(Registry& registry) {
    registry.node<FilterStage>(
        "level_sum",
        {"Adds up all levels of a multi-resolution map.", "WN09, section 3.2.2",
         "It takes the maps of reconstruct=multi_level and refuses others."},
        &addLevels);
}

}  // namespace kaustik
