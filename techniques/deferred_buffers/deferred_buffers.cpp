// SPDX-License-Identifier: MIT
#include "techniques/deferred_buffers/deferred_buffers.h"

#include <fmt/format.h>

#include <algorithm>

#include "techniques/deferred_buffers/body_buffers.h"
#include "techniques/raster_views/light_sight.h"

namespace kaustik {
namespace {

struct Drawing {
    DeferredBuffers buffers;
    graph::Texture<DepthBuffer> depthBuffer;
    Geometry geometry;
};

// A light in the middle of a body sees it from within, by its back faces.
bool mayBeInside(const scene::Scene& scene, const scene::Light& light) {
    if (light.kind == scene::LightKind::directional) return false;
    for (const scene::Object& object : scene.objects) {
        if (scene.materials[object.material].kind != scene::MaterialKind::dielectric) continue;
        const scene::Bounds bounds = objectBounds(scene, object);
        if (glm::all(glm::greaterThanEqual(light.position, bounds.minimum)) &&
            glm::all(glm::lessThanEqual(light.position, bounds.maximum)))
            return true;
    }
    return false;
}

void draw(const FrameInputs& inputs, gl::PassContext& context, const Drawing& data, bool isOnce,
          int layer, bool seesBacksFirst) {
    const DeferredBuffers& buffers = data.buffers;
    const render::RasterViews& views = *buffers.views;
    gl::Command command =
        isOnce
            ? context.shaders({"deferred_buffers/deferred.vert", "deferred_buffers/deferred.geom",
                               "deferred_buffers/deferred.frag"})
            : context.shaders({"deferred_buffers/deferred.vert", "deferred_buffers/deferred.frag"});
    command.define("TRIANGLES");
    if (isOnce) {
        command.define("ONCE").set("firstLayer", 0);
    } else {
        command.set("layer", layer);
    }
    if (seesBacksFirst) command.define("BACKS_FIRST");
    views.bindTo(command).set("projection", views.view(0).projection());
    command.target(buffers.depth, layer).clear();
    command.target(buffers.surface, layer).clear();
    if (buffers.shape.valid()) command.define("SHAPES").target(buffers.shape, layer).clear();
    command.target(buffers.triangle, layer).clear();
    command.depth(data.depthBuffer, gl::DepthTest::nearerReversed, layer).clear();
    inputs.gpuScene.draw(
        command, context, data.geometry, views.instances(0),
        layer == DeferredBuffers::kBacks ? render::DrawSet::dielectrics : render::DrawSet::all);
}

// So many texels along the longer side, as square as whole numbers of them allow.
glm::ivec2 texelsOf(const render::RasterView& view, int size) {
    const glm::dvec2 share =
        view.halfExtent / std::max(view.halfExtent.x, view.halfExtent.y) * double(size);
    return glm::max(glm::ivec2(glm::round(share)), glm::ivec2(16));
}

DeferredBuffers drawBuffers(FrameBuilder& frame, const Geometry& geometry,
                            const DeferredParams& params, const scene::Light& light,
                            const render::RasterView& view, bool hasBackFaces,
                            const std::string& suffix) {
    const glm::ivec2 size = texelsOf(view, params.size);
    const Views views =
        frame.makeViews(render::Space::light, {render::inPixels(view, size.x, size.y)});
    const int layers = hasBackFaces ? 2 : 1;
    const bool seesBacksFirst = mayBeInside(frame.scene(), light);
    return frame
        .pass<Drawing>(
            "emit.deferred_buffers",
            fmt::format("{} as light '{}' sees them{}",
                        hasBackFaces ? "first surfaces and backs" : "first surfaces", light.name,
                        !hasBackFaces                               ? ""
                        : params.geometry == DeferredGeometry::once ? ", in one drawing"
                                                                    : ", in two drawings"),
            [&](graph::PassSetup& setup, Drawing& data) {
                data.geometry = geometry;
                if (geometry.heightFields.valid()) setup.read(geometry.heightFields);
                DeferredBuffers& made = data.buffers;
                made.views = views;
                made.hasBackFaces = hasBackFaces;
                made.cells = view.halfExtent / views->view(0).halfExtent;
                made.triangle = setup.create<TriangleTexel>("deferred.triangle" + suffix, size.x,
                                                            size.y, layers);
                made.depth =
                    setup.create<ViewDepth>("deferred.depth" + suffix, size.x, size.y, layers);
                made.surface =
                    setup.create<SurfaceTexel>("deferred.surface" + suffix, size.x, size.y, layers);
                if (hasBackFaces && frame.usesBeams()) {
                    made.shape =
                        setup.create<HitShape>("deferred.shape" + suffix, size.x, size.y, layers);
                }
                data.depthBuffer = setup.create<DepthBuffer>("deferred.depth_buffer" + suffix,
                                                             size.x, size.y, layers);
            },
            [&inputs = frame.inputs(), params, seesBacksFirst](const Drawing& data,
                                                               gl::PassContext& context) {
                const bool drawsBacks = data.buffers.hasBackFaces;
                if (drawsBacks && params.geometry == DeferredGeometry::once) {
                    draw(inputs, context, data, true, gl::Command::kAllLayers, seesBacksFirst);
                    return;
                }
                draw(inputs, context, data, false, DeferredBuffers::kFirst, seesBacksFirst);
                if (drawsBacks)
                    draw(inputs, context, data, false, DeferredBuffers::kBacks, seesBacksFirst);
            })
        .buffers;
}

std::vector<DeferredBuffers> drawAll(FrameBuilder& frame, const Geometry& geometry) {
    const auto& params = frame.params<DeferredParams>("emit.deferred");
    const std::vector<scene::Light>& lights = frame.scene().lights;
    const std::vector<LightSight> sights = sightsOfSpecular(frame);
    const bool hasBackFaces = sharesBackFaces(frame);
    std::vector<DeferredBuffers> buffers;
    for (std::size_t i = 0; i < sights.size(); ++i) {
        const scene::Bounds whole = sceneBounds(frame.scene());
        const render::RasterView view = params.frame == DeferredFrame::tight
                                            ? sights[i].view
                                            : render::makeLightView(lights[i], whole, whole);
        buffers.push_back(drawBuffers(frame, geometry, params, lights[i], view, hasBackFaces,
                                      i == 0 ? "" : fmt::format(".{}", i + 1)));
    }
    return buffers;
}

}  // namespace

void DeferredBuffers::read(graph::PassSetup& setup) const {
    setup.read(triangle);
    setup.read(depth);
    setup.read(surface);
    if (shape.valid()) setup.read(shape);
}

void DeferredBuffers::bindTo(gl::Command& command) const {
    command.texture("deferredTriangle", triangle)
        .texture("deferredDepth", depth)
        .texture("deferredSurface", surface)
        .offer("cellsOfView", glm::vec2(cells));
}

bool sharesBackFaces(const FrameBuilder& frame) {
    const params::ParamSet& params = frame.inputs().params;
    return params.choice(EmitStage::name) == "deferred" &&
           params.choice(SpecularStage::name) == "deferred" && bodiesOf(frame).size() == 1;
}

const std::vector<DeferredBuffers>& deferredBuffers(FrameBuilder& frame, const Geometry& geometry) {
    return *frame.once<std::vector<DeferredBuffers>>("emit.deferred_buffers", [&] {
        return std::make_shared<std::vector<DeferredBuffers>>(drawAll(frame, geometry));
    });
}

}  // namespace kaustik
