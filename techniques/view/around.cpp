// SPDX-License-Identifier: MIT
// view.around: what the eye sees in and through specular surfaces, by rays that are searched in the
// layers around the generator that they meet first: wherever they end, on the screen or next to it,
// receivers are lit there, by the lights past what the lights' shadow maps have, which know every
// specular object whatever the reference point sees of it, and by the light that is stored around
// the generator, so that caustics are seen in mirrors and through glass (U08, section 6). In: the
// eye's first surfaces, layers and maps around generators, the lights' shadow maps; out: radiance,
// W/m²/sr, and exits in eye view space, m.
#include <fmt/format.h>

#include <utility>

#include "framework/pipeline/frame_builder.h"
#include "techniques/eye_rays/view_passes.h"
#include "techniques/generators/around_stage.h"
#include "techniques/generators/generators.h"
#include "techniques/maps/map_filters.h"
#include "techniques/raster_views/shadow_maps.h"
#include "techniques/tracing/hit_testing.h"

namespace kaustik {
namespace {

struct AroundViewParams {
    int interfaces = 8;
    int branches = 4;
    bool caustics = true;
    float stride = 4.0f;
    int maxSteps = 256;
    int refinements = 8;
    template <class R>
    void reflect(R& r) {
        r.field(interfaces, "interfaces",
                "Specular surfaces that a ray of the eye is followed to after the first", "",
                params::range(1, 16));
        r.field(branches, "branches",
                "Parts of a ray that are followed at most: the refracted one, and what surfaces "
                "reflect; where there is no room for a reflected one the stronger goes on",
                "", params::range(1, 8));
        r.field(caustics, "caustics", "Light what rays end at by what is stored around generators");
        r.field(stride, "stride", "As trace.secant.stride", "texels", params::range(0.1f, 64.0f));
        r.field(maxSteps, "max_steps", "As trace.secant.max_steps", "", params::range(2, 4096));
        r.renamed("most", "max_steps");
        r.field(refinements, "refinements", "As trace.secant.refinements", "",
                params::range(1, 32));
    }
};

// The maps in which light is stored around generators; empty where it is stored elsewhere.
std::vector<FluxMap> storedAround(FrameBuilder& frame, const AroundViewParams& params,
                                  const CausticMap& map) {
    if (map.maps.empty() || !params.caustics) return {};
    // The gather has refused maps of several sets.
    if (map.maps.front().generator >= 0) return inFloats(frame, map).maps;
    frame.warn(
        "view.around sees caustics in what it looks at by maps around generators alone; take "
        "reconstruct.space=cube.");
    return {};
}

// What all generators' receivers and maps hold, in arrays one after the other.
struct Collected {
    graph::Texture<ReceiverTexel> receiver;
    graph::Texture<SurfaceTexel> surface;
    graph::Texture<FilteredTexel> flux;
    Views views;  // of the first
};

Collected collect(FrameBuilder& frame, const std::vector<ReceiverView>& seen,
                  const std::vector<FluxMap>& stored) {
    if (stored.size() == 1)
        return {seen[0].receiver, seen[0].receiverSurface, stored[0].filtered, seen[0].views};
    return frame.pass<Collected>(
        "view.maps", "light that is stored around any generator may be seen in each",
        [&](graph::PassSetup& setup, Collected& data) {
            const Views& views = seen[0].views;
            const int w = views->width();
            const int h = views->height();
            const int layers = views->count() * static_cast<int>(seen.size());
            data.views = views;
            data.receiver = setup.image(
                "allReceivers", setup.create<ReceiverTexel>("view.map_receiver", w, h, layers));
            data.surface = setup.image(
                "allSurfaces", setup.create<SurfaceTexel>("view.map_surface", w, h, layers));
            data.flux = setup.image(
                "allFlux", setup.create<FilteredTexel>("view.map_flux", w, h,
                                                       layers * stored[0].filteredPerView()));
            for (std::size_t i = 0; i < seen.size(); ++i) {
                setup.read(seen[i].receiver);
                setup.read(seen[i].receiverSurface);
                setup.read(stored[i].filtered);
            }
        },
        [seen, stored](const Collected& data, gl::PassContext& context) {
            const int sets = stored[0].filteredPerView();
            for (std::size_t i = 0; i < seen.size(); ++i) {
                context.compute("view/around_collect.comp")
                    .texture("mapReceiver", seen[i].receiver)
                    .texture("mapSurface", seen[i].receiverSurface)
                    .texture("mapFlux", stored[i].filtered)
                    .set("setsPerView", sets)
                    .set("firstView", static_cast<int>(i) * data.views->count())
                    .dispatchOver(data.views->width(), 8,
                                  data.views->height() * data.views->count(), 8);
            }
        });
}

View lookAround(FrameBuilder& frame, const AroundViewParams& params, Geometry geometry,
                EyeBuffer eye, LayeredDepth sceneLayers, Radiance receivers, Shadows shadows,
                CausticMap map) {
    if (!eye.interface.valid()) return renderReceiversOnly(frame, "view.around", receivers);
    const std::vector<SurfacesAround>& around = surfacesAround(frame, geometry);
    const std::vector<ReceiverView>& seen = generatorReceivers(frame, geometry);
    const std::vector<FluxMap> stored = storedAround(frame, params, map);
    const Collected maps = stored.empty() ? Collected{} : collect(frame, seen, stored);
    const int lights = frame.needs().lights;
    const ShadowMaps fromLights = lights > 0 ? shadowMaps(frame, geometry) : ShadowMaps{};
    const View view =
        frame
            .pass<ViewPass>(
                "view.around", lookReason(frame),
                [&](graph::PassSetup& setup, ViewPass& look) {
                    if (!stored.empty()) {
                        setup.read(maps.receiver);
                        setup.read(maps.surface);
                        setup.read(maps.flux);
                    }
                    if (lights > 0) readShadowMaps(setup, fromLights);
                    look = declareLook(frame, setup, {}, geometry, eye, sceneLayers, receivers,
                                       shadows);
                    for (std::size_t i = 0; i < around.size(); ++i) {
                        setup.read(around[i].layers.depth);
                        setup.read(around[i].layers.surface);
                        setup.read(around[i].order);
                        setup.read(seen[i].receiver);
                        setup.read(seen[i].receiverSurface);
                        setup.read(seen[i].receiverAlbedo);
                    }
                },
                [&inputs = frame.inputs(), params, around, seen, stored, maps, lights, fromLights,
                 testing = hitTesting(frame), &block = generatorsBlock(frame),
                 eyeView = viewData(frame.scene(), frame.view(), frame.view())](
                    const ViewPass& look, gl::PassContext& context) {
                    std::vector<Tell> tells;
                    for (std::size_t i = 0; i < around.size(); ++i) {
                        tells.emplace_back([&, i](gl::Command& command) {
                            setHitTesting(command, testing, around[i].layers)
                                .params("view.around", params)
                                .texture("layerDepths", around[i].layers.depth)
                                .texture("layerSurfaces", around[i].layers.surface)
                                .texture("layerOrder", around[i].order)
                                .texture("mapAlbedo", seen[i].receiverAlbedo)
                                .uniforms("Generators", block)
                                .set("mapCount", seen[i].views->count())
                                .set("generatorIndex", static_cast<int>(i))
                                .set("eyeFrustum", eyeView.frustum)
                                .set("eyeSizePixels", eyeView.sizePixels);
                            if (lights > 0) {
                                bindShadowMaps(command.define("HAS_LIGHTS"), fromLights)
                                    .set("lightCount", lights);
                            }
                            if (stored.empty()) {
                                command.texture("mapReceiver", seen[i].receiver)
                                    .texture("mapSurface", seen[i].receiverSurface)
                                    .uniforms("MapViews", seen[i].views->block());
                                return;
                            }
                            command.define("LIGHT_IS_STORED")
                                .texture("mapReceiver", maps.receiver)
                                .texture("mapSurface", maps.surface)
                                .texture("filteredFlux", maps.flux)
                                .uniforms("MapViews", maps.views->block())
                                .set("setsPerView", stored[i].filteredPerView());
                            if (stored.size() > 1) command.define("SEVERAL_CUBES");
                            if (stored[i].sets.hasDirection()) command.define("GLOSSY_RECEIVERS");
                        });
                    }
                    drawSpecular(inputs, context, look, "view/around.frag", tells);
                })
            .seen;
    reportExitLimit(frame, "view.around", view, "view.around.interfaces", "interfaces",
                    params.interfaces, &EyeRays::endedInside,
                    "end at one more and are taken to see the environment");
    reportLostRays(frame, "view.around", view,
                   "no way out of the object that they are in was found; its surface has a hole "
                   "there, or the reference points do not see it");
    return view;
}

}  // namespace

void registerViewAround(Registry& registry) {
    registry.node<ViewStage>(
        "around",
        {"Searches the eye's rays in the layers around the specular object "
         "that they meet, and lights what they find, by caustics too.",
         "U08, sections 3 and 6",
         "It finds what the layers around a generator hold, and lights it by caustics only where "
         "light is stored on cubes (reconstruct.space=cube). Rays are followed to no more than "
         "view.around.interfaces specular surfaces after the first.",
         {"trace.test", "trace.epsilon", "around", "reconstruct.map_size", "reconstruct.map_memory",
          "shadow.map.size"}},
        &lookAround);
}

}  // namespace kaustik
