// SPDX-License-Identifier: MIT
// gather.project: the caustic map of each light projected onto the eye's receivers like a shadow
// map (WD06), light by light. Where a receiver is glossy, all of a texel's light counts as coming
// from its mean direction. In: flux a texel, W; out: irradiance, W/m², and radiance, W/m²/sr.
#include <utility>

#include "framework/core/error.h"
#include "framework/pipeline/frame_builder.h"
#include "techniques/caustic_map/map_filters.h"
#include "techniques/caustic_map/nodes.h"

namespace kaustik {
namespace {

struct ProjectParams {
    int places = 4;
    template <class R>
    void reflect(R& r) {
        r.field(places, "places",
                "Most looks at a map along each side of a pixel that spans several of its texels",
                "", params::range(1, 16));
    }
};

IrradianceMap projectMaps(FrameBuilder& frame, const ProjectParams& params, CausticMap map,
                          Surfaces surfaces) {
    if (map.maps.front().on.views->isEyes())
        throw ConfigError(
            "gather.project looks light up in the lights' maps, but it is stored on "
            "the screen; take reconstruct.space=light, or gather=screen.");
    if (map.maps.front().sets.flux > 1 && !map.maps.front().filtered.valid())
        throw ConfigError(
            "gather.project takes one map, but the light is stored in several sizes "
            "or levels; take filter=blend or filter=levels.");
    map = inFloats(frame, std::move(map));
    IrradianceMap result;
    result.ledger = map.ledger;
    for (std::size_t i = 0; i < map.maps.size(); ++i) {
        const FluxMap& stored = map.maps[i];
        result = frame.pass<IrradianceMap>(
            "gather.project", "each light's map is looked up where the eye's receivers lie",
            [&](graph::PassSetup& setup, IrradianceMap& data) {
                setup.sample("filteredFlux", stored.filtered);
                setup.sample("mapReceiver", stored.on.receiver);
                setup.sample("mapSurface", stored.on.receiverSurface);
                setup.sample("receiver", surfaces.eye.receiver);
                setup.sample("receiverSurface", surfaces.eye.receiverSurface);
                data = result;
                const bool isGlossy = stored.sets.hasDirection;
                if (isGlossy) setup.sample("receiverAlbedo", surfaces.eye.receiverAlbedo);
                if (i > 0) {
                    data.irradiance = setup.write(result.irradiance);
                    setup.bypass(data.irradiance, result.irradiance);
                    if (isGlossy) {
                        data.radiance = setup.write(result.radiance);
                        setup.bypass(data.radiance, result.radiance);
                    }
                    return;
                }
                data.irradiance = setup.create<IrradianceTexel>("caustic.irradiance", frame.width(),
                                                                frame.height());
                setup.bypass(data.irradiance, {0, 0, 0, 0});
                if (!isGlossy) return;
                data.radiance =
                    setup.create<RadianceTexel>("caustic.radiance", frame.width(), frame.height());
                setup.bypass(data.radiance, {0, 0, 0, 0});
            },
            [params, stored, isFirst = i == 0](const IrradianceMap& data,
                                               gl::PassContext& context) {
                const Views& views = stored.on.views;
                gl::Command command = context.fullscreen("caustic_map/project.frag");
                command.uniforms("MapViews", views->block())
                    .params("gather.project", params)
                    .set("mapCount", views->count())
                    .set("setsPerView", stored.filteredPerView());
                if (views->count() > 1) command.define("MAP_IS_CUBE");
                if (views->view(0).isOrthographic) command.define("MAP_IS_PARALLEL");
                command.target(data.irradiance);
                if (isFirst) command.clear();
                if (stored.sets.hasDirection) {
                    command.define("GLOSSY_RECEIVERS").target(data.radiance);
                    if (isFirst) command.clear();
                }
                command.blend(gl::Blend::add).draw();
            });
    }
    return result;
}

}  // namespace

void registerProject(Registry& registry) {
    registry.node<GatherStage>(
        "project",
        {"Looks each light's caustic map up at the eye's receivers, like a shadow map.", "WD06"},
        &projectMaps);
}

}  // namespace kaustik
