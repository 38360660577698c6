// SPDX-License-Identifier: MIT
// view.refraction: screen-space refraction tracing (K06, section 4). The passes "view.layers.…"
// make layers of the transmitting objects alone (fragment_lists.h);
// "view.refraction" follows the eye's transmitted ray of every pixel through them, and from mirror
// to mirror, and looks up what it sees: the refracted scene (Fig. 10;
// include/views/scene_look.glsl), else the environment. The reflection at the first interface is
// looked up the same way; later partial reflections are not followed. In: eye buffer, layers,
// radiance of the receivers; out: radiance, W/m²/sr, and where each ray left for good, view space,
// m.
//
// The paper does not say what happens at total internal reflection (here the ray goes on, between
// the same two layers), nor when a ray leaves through the layer that it has entered by (here it is
// then between that layer and the one before).
#include <fmt/format.h>

#include <algorithm>

#include "framework/pipeline/frame_builder.h"
#include "framework/scene/meshes/winding_number.h"
#include "techniques/eye_rays/view_passes.h"
#include "techniques/layered_depth/fragment_lists.h"
#include "techniques/tracing/hit_testing.h"

namespace kaustik {
namespace {

// Where an eye ray's next interface is looked for.
enum class RefractionSearch : int { automatic, monotonic, all };

// When the monotonic search takes a layer for a hit.
enum class RefractionStop : int { crossing, depth };

struct RefractionViewParams {
    RefractionSearch search = RefractionSearch::automatic;
    RefractionStop stop = RefractionStop::crossing;
    int interfaces = 0;
    int reflections = 4;
    int layers = 8;
    SceneLookParams look;
    template <class R>
    void reflect(R& r) {
        r.choice(search, "search",
                 "monotonic: the paper's, between the layer that the ray has passed last and the "
                 "next one; all: in every layer of every pixel on its way; auto: monotonic, unless "
                 "dielectrics lie in one another, of which it knows no order",
                 {"auto", "monotonic", "all"});
        r.choice(stop, "stop",
                 "depth: the paper's, as soon as the ray is deeper than the next layer or nearer "
                 "than the one passed; crossing: it must cross that layer's plane nearby too, so "
                 "that one which passes behind another part of the object goes on. For the "
                 "monotonic search",
                 {"crossing", "depth"})
            .when(search != RefractionSearch::all, "with view.refraction.search=all");
        r.field(interfaces, "interfaces",
                "Most refractions of an eye ray; the paper's table has 2, and 1 is its Fig. 9, "
                "left. 0: "
                "4, or 2 for each closed dielectric of those that lie in one another",
                "", params::range(0, 16));
        r.field(reflections, "reflections",
                "Most total internal reflections of an eye ray; what needs more is lost", "",
                params::range(0, 64));
        r.field(layers, "layers",
                "Most layers of transmitting objects that are kept; the monotonic search needs "
                "no more than its interfaces",
                "", params::range(1, 64));
        look.reflect(r);
    }
};

// As many interfaces as the scene needs, and the search that finds them. A path crosses a sheet
// once: where there is nothing else, no more are looked for, nor peeled, than there are sheets.
RefractionViewParams forScene(const scene::Scene& scene, int nested, RefractionViewParams params) {
    if (params.interfaces == 0) params.interfaces = std::max(4, 2 * nested);
    if (params.search == RefractionSearch::automatic)
        params.search = nested > 1 ? RefractionSearch::all : RefractionSearch::monotonic;
    int sheets = 0;
    for (const scene::Object& object : scene.objects) {
        if (scene.materials[object.material].kind != scene::MaterialKind::dielectric) continue;
        const scene::Mesh& mesh = scene.meshes[object.mesh];
        if (mesh.hasInside || turnsBack(mesh)) return params;
        ++sheets;
    }
    params.interfaces = std::min(params.interfaces, std::max(sheets, 1));
    return params;
}

// A layer more is of use to the monotonic search up to as many as it may hit interfaces.
int neededLayers(const RefractionViewParams& params) {
    const bool isMonotonic = params.search == RefractionSearch::monotonic;
    return isMonotonic ? std::min(params.layers, params.interfaces) : params.layers;
}

// Whether there may be interfaces in layers behind the last one: fewer layers than interfaces to be
// hit in them.
bool asksForLayers(const RefractionViewParams& params) {
    return params.search != RefractionSearch::monotonic || params.layers < params.interfaces;
}

void reportLimits(FrameBuilder& frame, const RefractionViewParams& params,
                  const LayeredDepth& layers, const View& seen) {
    reportDielectricLimits(frame, "view.refraction", seen, params.interfaces, params.reflections);
    reportLostRays(frame, "view.refraction", seen,
                   "no way out of the object that they are in was found; its surface has a hole "
                   "there, is off the screen, or lies beyond view.refraction.layers");
    if (!asksForLayers(params)) return;
    const bool isMonotonic = params.search == RefractionSearch::monotonic;
    frame.reportLimit(
        {"view.refraction",
         {layers.statistics},
         [=](const gl::Executor& executor) -> std::optional<ReachedLimit> {
             const transport::LayerStatistics found =
                 executor.buffer(layers.statistics).read<transport::LayerStatistics>().front();
             if (found.skipped == 0) return {};
             const int deepest = static_cast<int>(found.complexity);
             return ReachedLimit{
                 "view.refraction.layers",
                 "layers",
                 static_cast<double>(params.layers),
                 static_cast<double>(isMonotonic ? std::min(deepest, params.interfaces) : deepest),
                 fmt::format("{} of {} fragments of transmitting objects, in {} pixels, lie beyond "
                             "the last layer",
                             found.skipped, found.fragments, found.pixelsSkipped),
                 0.0};
         }});
}

View traceRefraction(FrameBuilder& frame, const RefractionViewParams& wanted, Geometry geometry,
                     EyeBuffer eye, LayeredDepth sceneLayers, Radiance receivers, Shadows shadows,
                     CausticMap /*map*/) {
    if (!eye.interface.valid()) {
        return renderReceiversOnly(frame, "view.refraction", receivers);
    }
    const DielectricsBox box = boxOfDielectrics(frame);
    const RefractionViewParams params = forScene(frame.scene(), box.nested, wanted);
    LayeredDepth dielectrics;
    if (frame.needs().refractors > 0) {
        const FrameBuilder::PassScope within(frame, "view");
        // The n-th interface is looked for in the n-th layer, and no deeper.
        dielectrics = makeLayers(frame, geometry,
                                 {.name = "view.layers",
                                  .set = render::DrawSet::dielectrics,
                                  .layers = neededLayers(params),
                                  .countsFragments = asksForLayers(params),
                                  .reader = "the eye's rays need"});
    } else {
        frame.skip("view.layers", "the scene has no dielectric");
    }
    std::string reason = lookReason(frame);
    if (wanted.search == RefractionSearch::automatic && params.search == RefractionSearch::all)
        reason += "; of dielectrics in one another it asks all layers";
    struct Data {
        ViewPass look;
        LayeredDepth dielectrics;
    };
    const View view =
        frame
            .pass<Data>(
                "view.refraction", reason,
                [&](graph::PassSetup& setup, Data& data) {
                    data.dielectrics = dielectrics;
                    if (dielectrics.depth.valid()) readLayers(setup, dielectrics);
                    data.look = declareLook(frame, setup, params.look, geometry, eye, sceneLayers,
                                            receivers, shadows);
                },
                [&inputs = frame.inputs(), params, box, testing = hitTesting(frame)](
                    const Data& data, gl::PassContext& context) {
                    drawLook(inputs, context, data.look, params.look, "view/refraction.frag",
                             [&](gl::Command& command) {
                                 command.params("view.refraction", params);
                                 if (!data.dielectrics.depth.valid()) return;
                                 if (box.holdsScene) command.define("SCENE_INSIDE");
                                 setHitTesting(command, testing, data.dielectrics);
                                 command.set("dielectricsCenterVs", box.centerVs)
                                     .set("dielectricsHalfExtent", box.halfExtentMeters);
                             });
                })
            .look.seen;
    reportMirrorLimit(frame, "view.refraction", view, params.look.mirrors);
    if (dielectrics.depth.valid()) reportLimits(frame, params, dielectrics, view);
    return view;
}

}  // namespace

void registerViewRefraction(Registry& registry) {
    registry.node<ViewStage>(
        "refraction",
        {"Traces the eye's refracted rays on the screen through the layers of "
         "the transmitting objects, and on into the scene.",
         "K06, section 4",
         "It finds what the eye sees of the transmitting objects, in no more than "
         "view.refraction.layers layers, and of the scene what the screen shows. Partial "
         "reflections after the first interface are not followed; interfaces and reflections bound "
         "the rest, and the report says what is lost.",
         {"trace.test", "trace.epsilon", "layers.lists"}},
        &traceRefraction);
}

}  // namespace kaustik
