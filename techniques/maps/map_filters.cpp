// SPDX-License-Identifier: MIT
#include "techniques/maps/map_filters.h"

#include <fmt/format.h>

#include <utility>

#include "techniques/generators/generators.h"

namespace kaustik {
namespace {

std::string suffixOf(const FluxMap& map) {
    if (map.light >= 0) {
        return (map.light > 0 ? fmt::format(".light_{}", map.light + 1) : "") +
               (map.cascade > 0 ? fmt::format(".cascade_{}", map.cascade + 1) : "");
    }
    return map.generator > 0 ? suffixOfGenerator(static_cast<std::size_t>(map.generator)) : "";
}

}  // namespace

graph::Texture<FilteredTexel> createLike(graph::PassSetup& setup, const std::string& name,
                                         const FluxMap& map, int layersPerView) {
    const Views& views = map.on.views;
    return setup.create<FilteredTexel>(name + suffixOf(map), views->width(), views->height(),
                                       views->count() * layersPerView);
}

// Adds a pass for each map of the frame.
CausticMap filterMaps(FrameBuilder& frame, const std::string& node, const std::string& reason,
                      CausticMap map, const ExtraSetup& more, const FilterCommands& commands) {
    for (FluxMap& one : map.maps) {
        one = frame
                  .pass<Filtered>(
                      node, reason,
                      [&](graph::PassSetup& setup, Filtered& data) {
                          data.map = one;
                          setup.sample("fluxSums", one.flux);
                          data.map.filtered = setup.image(
                              "filteredFlux",
                              createLike(setup, "caustic.filtered", one, one.filteredPerView()));
                          more(setup, data);
                      },
                      [commands](const Filtered& data, gl::PassContext& context) {
                          commands(data, context);
                      })
                  .map;
    }
    return map;
}

gl::Command filterCommand(gl::PassContext& context, const std::string& shader, const FluxMap& map) {
    gl::Command command = context.compute(shader);
    command.set("setsBefore", map.sets.perView())
        .set("setsAfter", map.filteredPerView())
        .set("fluxSets", map.sets.flux())
        .set("holdsIntensity", map.sets.hasIntensity() ? 1 : 0)
        .set("views", map.on.views->count());
    return command;
}

void dispatchOverMap(gl::Command& command, const FluxMap& map) {
    command.dispatchOver(map.on.views->width(), 8, map.on.views->height(), 8);
}

CausticMap inFloats(FrameBuilder& frame, CausticMap map) {
    if (map.maps.front().filtered.valid()) return map;
    // Of the frame's one map, for whoever asks first.
    return *frame.once<CausticMap>("map.in_floats", [&] {
        return std::make_shared<CausticMap>(filterMaps(
            frame, "gather.unpack", "a texel of the map is looked up more than once",
            std::move(map), [](graph::PassSetup&, Filtered&) {},
            [](const Filtered& data, gl::PassContext& context) {
                gl::Command command = filterCommand(context, "maps/unpack.comp", data.map);
                dispatchOverMap(command, data.map);
            }));
    });
}

}  // namespace kaustik
