// SPDX-License-Identifier: MIT
// What a filter or a gather needs of the map of flux that it is given, checked by what the map
// declares of itself (FluxSets, FluxMap) when the graph is built.
#pragma once

#include <optional>
#include <string>

#include "framework/pipeline/light.h"
#include "techniques/raster_views/map_params.h"

namespace kaustik {

struct MapNeeds {
    SetLayout layout = SetLayout::one;     // `one`: or what a filter has made one map of
    std::optional<StoreSpace> space = {};  // where light is to be stored; none: anywhere
};

// ConfigError, with the settings that help, where the map is another. `node`: "filter.blend".
void needsMap(const std::string& node, const CausticMap& map, const MapNeeds& needs);

}  // namespace kaustik
