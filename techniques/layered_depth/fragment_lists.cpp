// SPDX-License-Identifier: MIT
// A layered depth image from one drawing of the surfaces. Every fragment joins the
// linked list of its pixel (Yang, Hensley, Grün, Thibieroz 2010, "Real-Time Concurrent Linked List
// Construction on the GPU"), whose nearest `layers.count` a thread a pixel then sorts. Of fragments
// at equal depth the one drawn first stays, as in peeling: each knows its triangle's number, so
// that the order in which threads ran leaves no trace. A view whose fragments do not fit is peeled
// (K06, section 2.2): slower, and the same picture. Out: bit for bit what layers.peel gives.
#include "techniques/layered_depth/fragment_lists.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/stage_params.h"
#include "techniques/layered_depth/peel_resources.h"

namespace kaustik {
namespace {

// Words of a fragment as fragment_lists.frag stores them.
struct FragmentDepth {  // view depth, octahedral normal of the triangle, next of the list
    GLuint words[4];
};
struct FragmentSurface {  // shading normal, material
    GLuint words[4];
};
struct FragmentTriangle {  // its number in the order of drawing
    GLuint number;
};
constexpr std::size_t kFragmentBytes =
    sizeof(FragmentDepth) + sizeof(FragmentSurface) + sizeof(FragmentTriangle);
struct ListHead {  // the pixel's first fragment + 1, 0 none
    static constexpr Format format = Format::r32ui;
};
struct FragmentCount {  // of a view
    GLuint count;
};

// What every device of OpenGL 4.5 has in a storage block.
constexpr std::size_t kMaxFragments = (std::size_t{1} << 27) / sizeof(FragmentDepth);
// A few pixels may all be full.
constexpr std::size_t kMinFragments = 65536;

// Mesa's software rasteriser ends all loops of a thread after 65,535 turns together; a fragment
// takes one turn a layer and two of its own.
constexpr std::uint32_t kMaxIterations = 65000;

// So few are peeled in less time than lists take (the dielectrics of `pool`, one layer: 0.6 of it;
// of `cornell-bunny`, four: the same).
constexpr int kFewLayers = 3;
// Where triangles, drawn once for each layer, are at least this share of the pixels, lists take
// less time on llvmpipe at 400x300 and at 1600x1200 (results/layers.md, "Layers in one pass").
constexpr double kTrianglesPerPixel = 0.25;

struct FragmentCapacity {
    std::size_t fragments;
    bool isMemoryLimited;  // else by layers.lists.fragments_per_pixel
};

FragmentCapacity fragmentCapacity(const render::RasterViews& views, const ListsParams& params) {
    const std::size_t affordable = std::min(
        (static_cast<std::size_t>(params.memoryMebibytes) << 20) / kFragmentBytes, kMaxFragments);
    const std::size_t pixels =
        static_cast<std::size_t>(views.width()) * static_cast<std::size_t>(views.height());
    const std::size_t wanted =
        std::max(pixels * static_cast<std::size_t>(params.fragmentsPerPixel), kMinFragments);
    return {std::min(affordable, wanted), affordable < wanted};
}

struct Lists {
    Peeling peeling;
    graph::Texture<CountTexel> counts;
    graph::Texture<ListHead> heads;
    graph::Buffer<FragmentCount> fragmentCounts;  // by view
};

void reportLimits(FrameBuilder& frame, const Lists& lists, const LayersRequest& request,
                  const ListsParams& params, const FragmentCapacity& capacity) {
    const LayeredDepth& layers = lists.peeling.layers;
    frame.reportLimit(
        {"layers.lists",
         {lists.fragmentCounts},
         [=, counts = lists.fragmentCounts,
          pixels = static_cast<double>(layers.views->width()) *
                   static_cast<double>(layers.views->height())](
             const gl::Executor& executor) -> std::optional<ReachedLimit> {
             std::size_t maximum = 0;
             for (const FragmentCount& view : executor.buffer(counts).read<FragmentCount>())
                 maximum = std::max(maximum, static_cast<std::size_t>(view.count));
             if (maximum <= capacity.fragments) return {};
             const std::string sentence = fmt::format(
                 "{} of the {} fragments of a view of {} do not fit: it is peeled instead, which "
                 "takes longer; no layer is lost to it",
                 maximum - capacity.fragments, maximum, request.name);
             const auto needed = static_cast<double>(maximum);
             if (capacity.isMemoryLimited) {
                 return ReachedLimit{"layers.lists.memory",
                                     "MiB",
                                     static_cast<double>(params.memoryMebibytes),
                                     std::ceil(needed * kFragmentBytes / 1048576.0),
                                     sentence,
                                     0.0};
             }
             return ReachedLimit{"layers.lists.fragments_per_pixel",
                                 "fragments a pixel",
                                 static_cast<double>(params.fragmentsPerPixel),
                                 std::ceil(needed / pixels),
                                 sentence,
                                 0.0};
         }});
    frame.reportLimit(
        {"layers.lists",
         {layers.statistics},
         [=, statistics =
                 layers.statistics](const gl::Executor& executor) -> std::optional<ReachedLimit> {
             const std::uint32_t longest =
                 executor.buffer(statistics).read<transport::LayerStatistics>().front().complexity;
             const std::uint32_t maximum =
                 kMaxIterations / static_cast<std::uint32_t>(request.layers + 2);
             if (longest <= maximum) return {};
             return ReachedLimit{"layers.lists.longest",
                                 "fragments",
                                 static_cast<double>(maximum),
                                 static_cast<double>(longest),
                                 fmt::format("a pixel of {} has more: its view is peeled instead, "
                                             "which takes longer; no layer is lost to it",
                                             request.name),
                                 0.0};
         }});
}

// Both commands ask alike whether the lists hold all of the view.
void setListCapacity(gl::Command& command, const Lists& lists, const FragmentCapacity& capacity,
                     int face) {
    command.storage("Statistics", lists.peeling.layers.statistics)
        .set("face", face)
        .set("capacity", static_cast<unsigned>(capacity.fragments))
        .set("maxIterations", kMaxIterations)
        .set("layerCount", lists.peeling.layers.layers);
}

// Where a pixel has no layer nothing is stored but what says so (LayeredDepth). What is kept, for
// pictures and scans, is whole; around a tile's pixels there is nothing.
void clearLayers(const Lists& data, gl::PassContext& context, const LayersRequest& request) {
    const LayeredDepth& layers = data.peeling.layers;
    const graph::ClearValue none{0, 0, 0, 0};
    if (request.tile || context.isKept(layers.depth)) context.texture(layers.depth).clear(none);
    if (context.isKept(layers.surface)) context.texture(layers.surface).clear(none);
    context.texture(data.peeling.depth).clear({1, 0, 0, 0});
}

void listView(const FrameInputs& inputs, const Lists& data, gl::PassContext& context,
              const LayersRequest& request, const FragmentCapacity& capacity, int face) {
    const Peeling& peeling = data.peeling;
    const render::RasterViews& views = *peeling.layers.views;
    context.texture(data.heads).clear({0, 0, 0, 0});
    gl::Command list =
        context.shaders({"layered_depth/fragment_lists.vert", "layered_depth/fragment_lists.frag"});
    views.bindTo(list)
        .set("projection", views.view(face).projection())
        .set("face", face)
        .set("capacity", static_cast<unsigned>(capacity.fragments))
        .target(data.counts)
        .clear()
        .blend(gl::Blend::add);
    drawTo(list, request);
    inputs.gpuScene.draw(list, context, peeling.geometry, views.instances(face), request.set);
    const PixelRegion pixels = request.pixels(views);
    const glm::ivec2 extent = pixels.end - pixels.first;
    context.compute("layered_depth/peel_statistics.comp")
        .texture("counts", data.counts)
        .storage("Statistics", peeling.layers.statistics)
        .set("layerCount", request.layers)
        .set("firstPixel", pixels.first)
        .dispatchOver(extent.x, 8, extent.y, 8);

    const auto commandCount = static_cast<int>(inputs.gpuScene.commandCount());
    gl::Command commands = context.compute("layered_depth/peel_commands.comp");
    setListCapacity(commands, data, capacity, face);
    commands.define("AFTER_LISTS")
        .storage("SceneCommands", inputs.gpuScene.commands())
        .storage("LayerCommands", peeling.commands)
        .set("commandCount", commandCount)
        .dispatchOver(commandCount * request.layers + 1, 64);
    peelView(inputs, peeling, context, request, face);

    gl::Command sort = context.compute("layered_depth/fragment_lists.comp");
    setListCapacity(sort, data, capacity, face);
    sort.image("layerDepths", peeling.layers.depth)
        .image("layerSurfaces", peeling.layers.surface)
        .set("firstPixel", pixels.first)
        .dispatchOver(extent.x, 8, extent.y, 8);
}

}  // namespace

LayeredDepth listFragments(FrameBuilder& frame, Geometry geometry, const LayersRequest& request,
                           const ListsParams& params) {
    const FragmentCapacity capacity =
        fragmentCapacity(request.views ? *request.views : *frame.eyeViews(), params);
    const Lists& lists = frame.pass<Lists>(
        "layers.lists",
        fmt::format("{} hidden surfaces; at most {} layer{} of {} fragments", request.reader,
                    request.layers, request.layers == 1 ? "" : "s", capacity.fragments),
        [&](graph::PassSetup& setup, Lists& data) {
            data.peeling = Peeling::create(frame, setup, geometry, request);
            data.peeling.isConditional = true;
            const render::RasterViews& views = *data.peeling.layers.views;
            const std::string& name = request.name;
            data.peeling.layers.statistics =
                setup.createBuffer<transport::LayerStatistics>(name + ".statistics", 1);
            data.counts = setup.create<CountTexel>(name + ".counts", views.width(), views.height());
            data.heads = setup.image(
                "heads", setup.create<ListHead>(name + ".heads", views.width(), views.height()));
            data.fragmentCounts = setup.storage(
                "FragmentCounts",
                setup.createBuffer<FragmentCount>(name + ".fragment_counts",
                                                  static_cast<std::size_t>(views.count())));
            setup.storage("FragmentDepths", setup.createBuffer<FragmentDepth>(
                                                name + ".fragment_depths", capacity.fragments));
            setup.storage("FragmentSurfaces", setup.createBuffer<FragmentSurface>(
                                                  name + ".fragment_surfaces", capacity.fragments));
            setup.storage("FragmentTriangles",
                          setup.createBuffer<FragmentTriangle>(name + ".fragment_triangles",
                                                               capacity.fragments));
        },
        [&inputs = frame.inputs(), request, capacity](const Lists& data, gl::PassContext& context) {
            context.buffer(data.fragmentCounts).clear();
            context.buffer(data.peeling.layers.statistics).clear();
            clearLayers(data, context, request);
            for (int face = 0; face < data.peeling.layers.views->count(); ++face)
                listView(inputs, data, context, request, capacity, face);
        });
    reportLimits(frame, lists, request, params, capacity);
    return lists.peeling.layers;
}

std::size_t triangleCount(const scene::Scene& scene, render::DrawSet set) {
    std::size_t triangles = 0;
    for (const scene::Object& object : scene.objects) {
        const bool isDielectric =
            scene.materials[object.material].kind == scene::MaterialKind::dielectric;
        if (set == render::DrawSet::dielectrics && !isDielectric) continue;
        triangles += scene.meshes[object.mesh].triangles.size();
    }
    return triangles;
}

bool prefersLists(FrameBuilder& frame, const LayersRequest& request) {
    const render::RasterViews& views = request.views ? *request.views : *frame.eyeViews();
    const double pixels = double(views.width()) * double(views.height());
    const double triangles =
        static_cast<double>(triangleCount(frame.scene(), request.set)) * request.layers;
    return request.layers > kFewLayers && triangles >= kTrianglesPerPixel * pixels;
}

LayeredDepth makeLayers(FrameBuilder& frame, Geometry geometry, const LayersRequest& request) {
    const std::string node = frame.inputs().params.choice(LayersStage::name);
    const bool lists = node == "lists" ? request.layers > kFewLayers
                                       : node == "auto" && prefersLists(frame, request);
    if (!lists) return peel(frame, geometry, request);
    return listFragments(frame, geometry, request, frame.params<ListsParams>("layers.lists"));
}

}  // namespace kaustik
