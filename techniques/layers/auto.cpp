// SPDX-License-Identifier: MIT
// layers.auto: layers.lists where geometry is much to draw again for each layer, else layers.peel.
// Out: the same layers, whichever makes them.
#include <fmt/format.h>

#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/stage_params.h"
#include "techniques/layered_depth/fragment_lists.h"
#include "techniques/layered_depth/pyramid.h"

namespace kaustik {
namespace {

LayeredDepth chooseLayers(FrameBuilder& frame, const params::NoParams&, Geometry geometry) {
    const LayersRequest request{.name = "layers",
                                .layers = frame.params<LayersParams>("layers").count,
                                .tile = frame.tile()};
    const bool lists = prefersLists(frame, request);
    frame.skip(lists ? "layers.peel" : "layers.lists",
               fmt::format("{} triangles for each of {} layers are {} than a quarter of {} pixels",
                           triangleCount(frame.scene(), request.set), request.layers,
                           lists ? "more" : "fewer", frame.width() * frame.height()));
    return addPyramid(frame, makeLayers(frame, geometry, request));
}

}  // namespace

void registerLayersAuto(Registry& registry) {
    registry.node<LayersStage>(
        "auto",
        {"Lists of fragments where geometry is much to draw again for each layer, else peeling: "
         "the same layers, whichever is faster.",
         "",
         "It decides by the number of triangles, of layers and of pixels alone; no time is "
         "measured on the device.",
         {"layers.lists"}},
        {.tiles = true}, &chooseLayers);
}

}  // namespace kaustik
