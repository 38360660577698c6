// SPDX-License-Identifier: MIT
// layers.peel: a layered depth image by depth peeling, no deeper than the picture is (K06, section
// 2.2; layered_depth/depth_peeling.cpp). Out: arrays of view depth (m) with the triangles' normals,
// and of outward shading normals with materials, front to back.
#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/stage_params.h"
#include "techniques/layered_depth/depth_peeling.h"
#include "techniques/layered_depth/pyramid.h"

namespace kaustik {
namespace {

// How the fragments of all pixels become their maximum and sums (K06, section 2.2).
enum class Counting : int { atomics, reduce };

struct PeelParams {
    Counting counting = Counting::atomics;
    template <class R>
    void reflect(R& r) {
        r.choice(counting, "counting",
                 "atomics: each pixel adds to shared numbers; reduce: the paper's texture reduce, "
                 "exact to 16 million fragments",
                 {"atomics", "reduce"});
    }
};

LayeredDepth peelLayers(FrameBuilder& frame, const PeelParams& params, Geometry geometry) {
    const int layers = frame.params<LayersParams>("layers").count;
    return addPyramid(frame, peel(frame, geometry,
                                  {.name = "layers",
                                   .layers = layers,
                                   .reducesCounts = params.counting == Counting::reduce,
                                   .tile = frame.tile()}));
}

}  // namespace

void registerLayersPeel(Registry& registry) {
    registry.node<LayersStage>(
        "peel",
        {"Depth peeling into a layered depth image, no deeper than the "
         "picture's measured depth complexity.",
         "K06, section 2.2",
         "Surfaces that the view does not show are not in the layers: those edge-on, smaller than "
         "a pixel or off the screen, and those beyond layers.count, which are counted. All "
         "geometry is drawn once for each layer."},
        {.tiles = true}, &peelLayers);
}

}  // namespace kaustik
