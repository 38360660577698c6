// SPDX-License-Identifier: MIT
#include "techniques/maps/projection.h"

#include <utility>

#include "framework/core/error.h"
#include "techniques/maps/map_filters.h"

namespace kaustik {
namespace {

// The views of a light's maps after the first; nothing where it has one.
Views partsOf(FrameBuilder& frame, const std::vector<FluxMap>& maps, int light) {
    std::vector<render::RasterView> views;
    for (const FluxMap& map : maps) {
        if (map.light == light && map.cascade > 0) views.push_back(map.on.views->view(0));
    }
    return views.empty() ? nullptr : frame.makeViews(render::Space::light, std::move(views));
}

}  // namespace

IrradianceMap projectMaps(FrameBuilder& frame, const Projection& projection, CausticMap map,
                          const Surfaces& surfaces) {
    if (map.maps.front().sets.flux > 1 && !map.maps.front().filtered.valid()) {
        throw ConfigError(projection.node +
                          " takes one map, but the light is stored in several sizes "
                          "or levels; take filter=blend or filter=levels.");
    }
    map = inFloats(frame, std::move(map));
    IrradianceMap result;
    result.ledger = map.ledger;
    Views parts;
    for (std::size_t i = 0; i < map.maps.size(); ++i) {
        const FluxMap& stored = map.maps[i];
        if (stored.cascade == 0) parts = partsOf(frame, map.maps, stored.light);
        result = frame.pass<IrradianceMap>(
            projection.node, projection.reason,
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
            [projection, stored, parts, isFirst = i == 0](const IrradianceMap& data,
                                                          gl::PassContext& context) {
                const Views& views = stored.on.views;
                gl::Command command = context.fullscreen("maps/projection.frag");
                command.uniforms("MapViews", views->block())
                    .set("maxSamples", projection.maxSamples)
                    .set("mapCount", views->count())
                    .set("setsPerView", stored.filteredPerView());
                if (views->count() > 1) command.define("MAP_IS_CUBE");
                if (views->view(0).isOrthographic) command.define("MAP_IS_PARALLEL");
                if (parts) {
                    command.define("MAP_HAS_PARTS")
                        .uniforms("MapParts", parts->block())
                        .set("partCount", parts->count())
                        .set("part", stored.cascade);
                }
                command.target(data.irradiance);
                if (isFirst) command.clear();
                if (stored.sets.hasDirection) {
                    command.define("GLOSSY_RECEIVERS").target(data.radiance);
                    command.set("isFromCentre", projection.isFromCentre ? 1 : 0);
                    if (isFirst) command.clear();
                }
                command.blend(gl::Blend::add).draw();
            });
    }
    return result;
}

}  // namespace kaustik
