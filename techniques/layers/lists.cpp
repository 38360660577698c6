// SPDX-License-Identifier: MIT
// layers.lists: a layered depth image from one drawing of the surfaces, whose fragments are sorted
// by pixel (layered_depth/fragment_lists.cpp). Out: bit for bit what layers.peel gives.
#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/stage_params.h"
#include "techniques/layered_depth/fragment_lists.h"
#include "techniques/layered_depth/pyramid.h"

namespace kaustik {
namespace {

LayeredDepth listLayers(FrameBuilder& frame, const ListsParams& params, Geometry geometry) {
    const int layers = frame.params<LayersParams>("layers").count;
    return addPyramid(
        frame, listFragments(frame, geometry,
                             {.name = "layers", .layers = layers, .tile = frame.tile()}, params));
}

}  // namespace

void registerLayersLists(Registry& registry) {
    registry.node<LayersStage>(
        "lists",
        {"A layered depth image from lists of every pixel's fragments, in "
         "one drawing; what does not fit into their memory is peeled.",
         "Yang et al. 2010",
         "It shows the same surfaces as layers.peel and shares its limits. A view with more "
         "fragments than fit into layers.lists.memory, or with a list longer than a thread can "
         "walk, is peeled instead, and the report says so."},
        {.tiles = true}, &listLayers);
}

}  // namespace kaustik
