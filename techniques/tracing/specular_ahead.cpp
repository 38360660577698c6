// SPDX-License-Identifier: MIT
#include "techniques/tracing/specular_ahead.h"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "framework/pipeline/stage_params.h"
#include "techniques/layered_depth/depth_peeling.h"
#include "techniques/raster_views/light_sight.h"
#include "techniques/tracing/hit_testing.h"

namespace kaustik {
namespace {

// Surfaces behind one another in a light's view. Of two bodies that are not convex a light sees
// rarely more.
constexpr int kLayers = 6;

// By light; drawn once a frame.
const std::vector<LayeredDepth>& specularLayers(FrameBuilder& frame, int side,
                                                const Geometry& geometry) {
    return *frame.once<std::vector<LayeredDepth>>("trace.specular_layers", [&] {
        const std::vector<LightSight> sights = *frame.once<std::vector<LightSight>>(
            "specular.sights",
            [&] { return std::make_shared<std::vector<LightSight>>(sightsOfSpecular(frame)); });
        auto all = std::make_shared<std::vector<LayeredDepth>>();
        const FrameBuilder::PassScope within(frame, TraceStage::name);
        for (std::size_t light = 0; light < sights.size(); ++light) {
            all->push_back(peel(
                frame, geometry,
                {.name = fmt::format("trace.specular_{}", light + 1),
                 .set = render::DrawSet::specular,
                 .layers = kLayers,
                 .reader = "light on its way to a receiver may be stopped by",
                 .views = frame.makeViews(render::Space::light,
                                          {render::inPixels(sights[light].view, side, side)})}));
        }
        return all;
    });
}

bool mayMeetMore(const FrameBuilder& frame, const ModelledPaths& paths) {
    const scene::RepeatedHits& again = frame.needs().repeatedHits;
    return again.outside && (paths.transmissionOnly ? again.transmitted : again.reflected);
}

void warnUnstopped(FrameBuilder& frame) {
    frame.once<bool>("trace.blockers", [&] {
        frame.warn(fmt::format(
            "trace={} finds receivers alone: light that comes to a further specular surface goes "
            "straight through it (trace.blockers = 0).",
            frame.inputs().params.choice(TraceStage::name)));
        return std::make_shared<bool>(true);
    });
}

}  // namespace

void SpecularAhead::sample(graph::PassSetup& setup) const {
    if (!valid()) return;
    setup.define("SPECULAR_AHEAD");
    setup.sample("aheadSurface", surface);
    setup.sample("aheadTriangle", triangle);
    if (shape.valid()) setup.sample("aheadShape", shape);
}

SpecularAhead findSpecularAhead(FrameBuilder& frame, const Photons& photons,
                                const Geometry& geometry) {
    if (!mayMeetMore(frame, photons.paths)) return {};
    const int side = frame.params<TraceParams>("trace").blockers;
    if (side == 0) {
        warnUnstopped(frame);
        return {};
    }
    HitTesting testing = hitTesting(frame);
    testing.params.test = HitTest::crossing;
    SpecularAhead ahead;
    const std::vector<LayeredDepth>& lights = specularLayers(frame, side, geometry);
    for (std::size_t light = 0; light < lights.size(); ++light) {
        const LayeredDepth& layers = lights[light];
        ahead = frame.pass<SpecularAhead>(
            "trace.blockers", "light that comes to another specular surface is stopped there",
            [&](graph::PassSetup& setup, SpecularAhead& data) {
                photons.sample(setup);
                readLayers(setup, layers);
                const auto store = [&]<class T>(graph::Texture<T>& made, const char* image,
                                                const graph::Texture<T>& before, const char* name) {
                    made = light > 0 ? setup.write(before)
                                     : setup.create<T>(name + photons.suffix, photons.width,
                                                       photons.height);
                    setup.image(image, made);
                };
                store(data.surface, "nextSurface", ahead.surface, "hits.ahead_surface");
                store(data.triangle, "nextTriangle", ahead.triangle, "hits.ahead_triangle");
                if (photons.hasBeams())
                    store(data.shape, "nextShape", ahead.shape, "hits.ahead_shape");
            },
            [photons, layers, light, testing](const SpecularAhead&, gl::PassContext& context) {
                gl::Command command = context.compute("tracing/specular_ahead.comp");
                setHitTesting(command, testing, layers).set("lightIndex", static_cast<int>(light));
                dispatchOver(command, photons);
            });
    }
    return ahead;
}

}  // namespace kaustik
