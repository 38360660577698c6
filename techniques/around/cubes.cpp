// SPDX-License-Identifier: MIT
// around.cubes: all surfaces around each caustic generator, on the six faces of a cube around its
// reference point, in several layers (U08, section 3). Layers are peeled or listed front to back,
// as stage `layers` is set; a texture of slots then says which layer a slot has at a texel, so that
// "correct depth order is not required": what faces the same way on the same material is in the
// same slot everywhere, unless there are more of these at once than layers. Slots are colours of
// the graph of what is ever seen behind one another. Out: by generator, depth in m, normals and
// materials by layer, and the slots.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "framework/pipeline/frame_builder.h"
#include "techniques/generators/around_stage.h"
#include "techniques/generators/generators.h"
#include "techniques/layered_depth/fragment_lists.h"

namespace kaustik {
namespace {

// A texel of slots has four bits for each.
constexpr int kMaxLayers = 8;

enum class LayerOrder : int { smooth, depth };

struct CubesParams {
    int size = 256;
    int layers = 4;
    LayerOrder order = LayerOrder::smooth;
    int memoryMebibytes = 2048;
    template <class R>
    void reflect(R& r) {
        r.field(size, "size", "Side of a face of the cube around a generator", "texels",
                params::range(16, 4096));
        r.field(layers, "layers", "Most surfaces that are kept in a direction, nearest first", "",
                params::range(1, kMaxLayers));
        r.choice(order, "order",
                 "smooth: what faces the same way on the same material is one layer; depth: the "
                 "nearest is the first",
                 {"smooth", "depth"})
            .when(layers > 1, "with around.cubes.layers=1");
        r.field(memoryMebibytes, "memory",
                "Most memory of all layers together; larger faces are halved until they fit, and "
                "the report says so",
                "MiB", params::range(1, 1048576));
    }
};

// Of what a layer has of a texel: depth, normal, material.
constexpr double kBytesPerTexel = 32.0;

int sideOfFaces(FrameBuilder& frame, const CubesParams& params, std::size_t generators) {
    int side = params.size;
    const double maximum = static_cast<double>(params.memoryMebibytes) * 1048576.0;
    const double faces = static_cast<double>(transport::kMaxViews * generators) * params.layers;
    while (side > 16 && kBytesPerTexel * side * side * faces > maximum)
        side /= 2;
    if (side < params.size) {
        frame.warn(
            fmt::format("Layers around {} generators with faces of {} texels a side do not "
                        "fit into around.cubes.memory = {} MiB; they have {}.",
                        generators, params.size, params.memoryMebibytes, side));
    }
    return side;
}

// As shaders/around/cubes_order.glsl has it.
constexpr std::size_t kKinds = 256;
struct KindConflicts {  // bits: the kinds that are seen behind or before it; its own: it is seen
    std::uint32_t words[kKinds / 32];
};

graph::Texture<LayerOrderTexel> orderLayers(FrameBuilder& frame, const LayeredDepth& layers,
                                            LayerOrder order, const std::string& suffix) {
    struct Data {
        graph::Texture<LayerOrderTexel> order;
        graph::Buffer<KindConflicts> conflicts;
        graph::Buffer<std::uint32_t> slots;  // by kind
    };
    const bool isSmooth = order == LayerOrder::smooth;
    return frame
        .pass<Data>(
            "around.order",
            isSmooth ? "layers are ordered for smoothness, not by depth" : "layers are as peeled",
            [&](graph::PassSetup& setup, Data& data) {
                setup.sample("layerDepths", layers.depth);
                data.order = setup.image(
                    "layerOrder",
                    setup.create<LayerOrderTexel>("around.order" + suffix, layers.views->width(),
                                                  layers.views->height(), layers.views->count()));
                data.conflicts = setup.storage(
                    "KindConflicts",
                    setup.createBuffer<KindConflicts>("around.conflicts" + suffix, kKinds));
                data.slots = setup.storage("KindSlots", setup.createBuffer<std::uint32_t>(
                                                            "around.slots" + suffix, kKinds));
            },
            [layers, isSmooth](const Data& data, gl::PassContext& context) {
                const auto shader = [&](const char* name) {
                    gl::Command command = context.compute(name);
                    layers.views->bindTo(command)
                        .offer("layerCount", layers.layers)
                        .offer("isSmooth", isSmooth ? 1 : 0);
                    return command;
                };
                const int width = layers.views->width();
                const int rows = layers.views->height() * layers.views->count();
                context.buffer(data.conflicts).clear();
                if (isSmooth) {
                    shader("around/cubes_order_kinds.comp").dispatchOver(width, 8, rows, 8);
                    shader("around/cubes_order_slots.comp").dispatch(1);
                }
                shader("around/cubes_order_place.comp").dispatchOver(width, 8, rows, 8);
            })
        .order;
}

std::vector<SurfacesAround> sampleAround(FrameBuilder& frame, const CubesParams& params,
                                         Geometry geometry) {
    const std::vector<Generator>& generators = causticGenerators(frame);
    const int side = sideOfFaces(frame, params, generators.size());
    std::vector<SurfacesAround> all;
    for (std::size_t i = 0; i < generators.size(); ++i) {
        const std::string suffix = suffixOfGenerator(i);
        SurfacesAround around;
        {
            const FrameBuilder::PassScope within(frame, "around");
            around.layers = makeLayers(
                frame, geometry,
                {.name = "around" + suffix,
                 .layers = params.layers,
                 .reader = fmt::format("rays that leave '{}' need", generators[i].name),
                 .views = frame.makeViews(render::Space::cube, facesAround(generators[i], side))});
        }
        frame.reportLimit(
            {"around.order",
             {around.layers.statistics},
             [=, statistics = around.layers.statistics, name = generators[i].name](
                 const gl::Executor& executor) -> std::optional<ReachedLimit> {
                 const transport::LayerStatistics found =
                     executor.buffer(statistics).read<transport::LayerStatistics>().front();
                 if (found.skipped == 0) return {};
                 return ReachedLimit{
                     "around.cubes.layers",
                     "layers",
                     static_cast<double>(params.layers),
                     static_cast<double>(found.complexity),
                     fmt::format(
                         "{} of {} fragments around '{}', in {} texels, lie beyond the last "
                         "layer",
                         found.skipped, found.fragments, name, found.pixelsSkipped),
                     0.0};
             }});
        around.order = orderLayers(frame, around.layers, params.order, suffix);
        all.push_back(std::move(around));
    }
    return all;
}

}  // namespace

void registerAroundCubes(Registry& registry) {
    registry.sharedParams<AroundStage, GeneratorParams>();
    registry.node<AroundStage>(
        "cubes",
        {"Layers of distance, normal and material on the faces of a cube around each specular "
         "object.",
         "U08, section 3",
         "It samples what each generator's reference point sees, in no more than "
         "around.cubes.layers layers and no finer than a texel of a face. Larger faces than "
         "around.cubes.memory allows are halved, and a warning says so.",
         {"layers.lists"}},
        &sampleAround);
}

}  // namespace kaustik
