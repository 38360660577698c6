// SPDX-License-Identifier: MIT
// What filters make of maps of flux once all light has been stored. Flux a texel, W, before and
// after; what a map holds besides, for glossy receivers, becomes the same mixture of what belongs
// to each set of flux.
#pragma once

#include <functional>
#include <string>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// The map that a filter's pass makes, FluxMap::filtered, and what else it makes.
struct Filtered {
    FluxMap map;
    graph::Texture<FilteredTexel> scratch;
};
using ExtraSetup = std::function<void(graph::PassSetup&, Filtered&)>;
using FilterCommands = std::function<void(const Filtered&, gl::PassContext&)>;

// A texture like those of the map, of so many layers a view.
[[nodiscard]] graph::Texture<FilteredTexel> createLike(graph::PassSetup& setup,
                                                       const std::string& name, const FluxMap& map,
                                                       int layersPerView);
// Adds a pass for each map of the frame, which reads "fluxSums" and fills the image "filteredFlux".
[[nodiscard]] CausticMap filterMaps(FrameBuilder& frame, const std::string& node,
                                    const std::string& reason, CausticMap map,
                                    const ExtraSetup& more, const FilterCommands& commands);
// A command of such a pass, for shaders that include maps/filtered.glsl, and a thread a texel.
[[nodiscard]] gl::Command filterCommand(gl::PassContext& context, const std::string& shader,
                                        const FluxMap& map);
void dispatchOverMap(gl::Command& command, const FluxMap& map);

// The maps as some filter has left them in FluxMap::filtered, or as they were stored.
[[nodiscard]] CausticMap inFloats(FrameBuilder& frame, CausticMap map);

}  // namespace kaustik
