// SPDX-License-Identifier: MIT
// view.refraction: screen-space refraction tracing (K06, section 4). The passes "view.layers.…"
// peel the transmitting objects alone; "view.refraction" follows the eye's transmitted ray of every
// pixel through them and looks up what it sees: the receivers that the eye buffer shows (the
// refracted scene, Fig. 10), else what surrounds the scene. The reflection at the first interface
// is looked up the same way; later partial reflections are left out. In: eye buffer, radiance of
// the receivers; out: radiance, W/m²/sr, and where each ray left for good, view space, m.
//
// The paper does not say what happens at total internal reflection (here the ray goes on, between
// the same two layers), nor when a ray leaves through the layer that it has entered by (here it is
// then between that layer and the one before).
#include <fmt/format.h>

#include <algorithm>

#include "framework/pipeline/frame_builder.h"
#include "framework/scene/dielectrics.h"
#include "techniques/screen_space_photons/hit_testing.h"
#include "techniques/screen_space_photons/nodes.h"
#include "techniques/screen_space_photons/view_passes.h"

namespace kaustik {

namespace {

// A path crosses a sheet once: where there is nothing else, no more interfaces are looked for, nor
// peeled, than there are sheets.
RefractionViewParams forScene(const scene::Scene& scene, RefractionViewParams params) {
    int sheets = 0;
    for (const scene::Object& object : scene.objects) {
        if (scene.materials[object.material].kind != scene::MaterialKind::dielectric) continue;
        if (!isSheet(scene.meshes[object.mesh])) return params;
        ++sheets;
    }
    params.interfaces = std::min(params.interfaces, std::max(sheets, 1));
    return params;
}

// A layer more is of use to the monotonic search up to as many as it may meet interfaces.
int usefulLayers(const RefractionViewParams& params) {
    const bool isMonotonic = params.search == RefractionSearch::monotonic;
    return isMonotonic ? std::min(params.layers, params.interfaces) : params.layers;
}

// What rays that end at a cap are told by.
void keepToLimit(FrameBuilder& frame, const View& seen, const std::string& parameter,
                 const std::string& unit, int value, float ending, const std::string& fate) {
    frame.keepsTo({"view.refraction", seen.exitDirection,
                   [=, exits = seen.exitDirection](
                       const gl::Executor& executor) -> std::optional<ReachedLimit> {
                       const std::size_t rays = countExits(executor.texture(exits), ending);
                       if (rays == 0) return {};
                       return ReachedLimit{
                           parameter,
                           unit,
                           static_cast<double>(value),
                           0.0,
                           fmt::format("the eye's rays of {} pixels {}", rays, fate),
                           0.0};
                   }});
}

void keepToLimits(FrameBuilder& frame, const RefractionViewParams& params,
                  const LayeredDepth& layers, const View& seen) {
    keepToLimit(frame, seen, "view.refraction.interfaces", "refractions", params.interfaces,
                transport::kWayStoppedInside,
                "end inside of an object and are taken to see what they would outside");
    keepToLimit(frame, seen, "view.refraction.reflections", "reflections", params.reflections,
                transport::kWayReflectedTooOften, "are lost between total reflections");
    keepToLimit(frame, seen, "view.refraction.nesting", "dielectrics",
                numberDielectrics(frame.scene()).depth, transport::kWayNestedTooDeep,
                "are lost in a dielectric inside of more others");
    // Fewer layers than there are interfaces to be met in them.
    const bool isMonotonic = params.search == RefractionSearch::monotonic;
    if (isMonotonic && params.layers >= params.interfaces) return;
    frame.keepsTo(
        {"view.refraction", layers.statistics,
         [=](const gl::Executor& executor) -> std::optional<ReachedLimit> {
             const transport::LayerStatistics found =
                 executor.buffer(layers.statistics).read<transport::LayerStatistics>().front();
             if (found.leftOut == 0) return {};
             const int deepest = static_cast<int>(found.complexity);
             return ReachedLimit{
                 "view.refraction.layers",
                 "layers",
                 static_cast<double>(params.layers),
                 static_cast<double>(isMonotonic ? std::min(deepest, params.interfaces) : deepest),
                 fmt::format("{} of {} fragments of transmitting objects, in {} pixels, lie beyond "
                             "the last layer",
                             found.leftOut, found.fragments, found.pixelsLeftOut),
                 0.0};
         }});
}

}  // namespace

View traceRefraction(FrameBuilder& frame, const RefractionViewParams& wanted, Geometry geometry,
                     EyeBuffer eye, LayeredDepth /*layers*/, Radiance receivers) {
    if (!eye.interface.valid()) {
        frame.leaveOut("view.refraction", "the scene has no specular surface");
        return {receivers.radiance, {}, {}};
    }
    const RefractionViewParams params = forScene(frame.scene(), wanted);
    const HitTesting testing = hitTesting(frame);
    LayeredDepth layers;
    {
        const FrameBuilder::Within within(frame, "view");
        // The n-th interface is looked for in the n-th layer, and no deeper.
        layers = peel(frame, geometry,
                      {.name = "view.layers",
                       .set = render::DrawSet::dielectrics,
                       .layers = usefulLayers(params),
                       .reader = "the eye's rays need"});
    }
    struct Data {
        EyeBuffer eye;
        LayeredDepth layers;
        Radiance receivers;
        View seen;
    };
    const DielectricsBox box = boxOfDielectrics(frame);
    const View view =
        frame
            .pass<Data>(
                "view.refraction", "the eye looks through specular surfaces",
                [&](graph::PassSetup& setup, Data& data) {
                    data.eye = eye;
                    data.layers = layers;
                    data.receivers = receivers;
                    readLayers(setup, layers);
                    data.seen = createView(frame, setup, eye, receivers);
                },
                [&inputs = frame.inputs(), params, testing, box](const Data& data,
                                                                 gl::PassContext& context) {
                    gl::Command command =
                        context.fullscreen("screen_space_photons/refraction.frag");
                    if (box.holdsReceivers) command.define("RECEIVERS_INSIDE");
                    bindHitTesting(command, testing, inputs, data.layers);
                    bindLook(inputs, command, data.eye, data.receivers, params.look, data.seen);
                    command.params("view.refraction", params)
                        .set("dielectricsCenterVs", box.centerVs)
                        .set("dielectricsHalfExtent", box.halfExtentMeters)
                        .draw();
                })
            .seen;
    keepToLimits(frame, params, layers, view);
    return view;
}

}  // namespace kaustik
