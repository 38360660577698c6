// SPDX-License-Identifier: MIT
#include "techniques/maps/projection.h"

#include <string>
#include <utility>

#include "techniques/maps/directions.h"
#include "techniques/maps/map_filters.h"
#include "techniques/maps/undersampled.h"

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
    map = inFloats(frame, std::move(map));
    struct Data {
        IrradianceMap gathered;
        CountedPixels tooLong;
        CountedPixels undersampled;
    };
    IrradianceMap result;
    result.ledger = map.ledger;
    Views parts;
    for (std::size_t i = 0; i < map.maps.size(); ++i) {
        const FluxMap& stored = map.maps[i];
        if (stored.cascade == 0) parts = partsOf(frame, map.maps, stored.light);
        const bool isGlossy = stored.sets.hasDirection();
        const bool usesMean = isGlossy && !projection.isFromCentre;
        const Data& added = frame.pass<Data>(
            projection.node, projection.reason,
            [&](graph::PassSetup& setup, Data& made) {
                IrradianceMap& data = made.gathered;
                setup.sample("filteredFlux", stored.filtered);
                setup.sample("mapReceiver", stored.on.receiver);
                setup.sample("mapSurface", stored.on.receiverSurface);
                setup.sample("receiver", surfaces.eye.receiver);
                setup.sample("receiverSurface", surfaces.eye.receiverSurface);
                data = result;
                made.undersampled = countUndersampled(setup, "_" + std::to_string(i + 1));
                if (isGlossy) setup.sample("receiverAlbedo", surfaces.eye.receiverAlbedo);
                if (usesMean)
                    made.tooLong = countLongDirections(setup, "_" + std::to_string(i + 1));
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
            [projection, stored, parts, usesMean, isFirst = i == 0](const Data& made,
                                                                    gl::PassContext& context) {
                const IrradianceMap& data = made.gathered;
                made.undersampled.clear(context);
                if (usesMean) made.tooLong.clear(context);
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
                if (stored.sets.hasDirection()) {
                    command.define("GLOSSY_RECEIVERS").target(data.radiance);
                    if (usesMean) command.define("USES_MEAN_DIRECTION");
                    if (isFirst) command.clear();
                }
                command.blend(gl::Blend::add).draw();
            });
        result = added.gathered;
        reportUndersampled(frame, projection.node, projection.maxSamples, added.undersampled);
        if (usesMean) warnOfDirections(frame, projection.node, added.tooLong);
    }
    return result;
}

}  // namespace kaustik
