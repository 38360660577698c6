// SPDX-License-Identifier: MIT
#include "techniques/splats/texel_splats.h"

#include <algorithm>

#include "techniques/maps/levels.h"
#include "techniques/splats/narrowed.h"

namespace kaustik {
namespace {

struct Splatted {
    Stored stored;
    graph::Buffer<transport::Narrowed> narrowed;  // of the lens's splats
};

void drawSplats(const TexelSplats& splats, const Store& store, const Splatted& data,
                const Photons& list, gl::PassContext& context) {
    const FluxMap& map = data.stored.map;
    const render::RasterViews& views = *store.receivers.views;
    const int levels = splats.hasLevels ? levelsOf(views.width(), views.height()) : 1;
    for (int level = 0; level < levels; ++level) {
        gl::Command command = context.compute("splats/texel_splats.comp");
        bindStore(command, store);
        setLevelLayout(command, map);
        command.set("mapsPerView", map.sets.perView())
            .set("keepsEdges", splats.edges == SplatEdges::kept ? 1 : 0)
            .set("atTexels", splats.center == SplatCenter::texel ? 1 : 0)
            .set("level", level);
        if (map.sets.counts) command.define("COUNTS").set("countsPerView", map.sets.flux);
        setDeposit(command, map.sets);
        if (splats.intoOneLevel) command.define("ONE_LEVEL").set("levels", levels);
        if (splats.beams) {
            command.define("BEAM_WIDTHS")
                .set("widths", splats.beams->widths)
                .set("minimum", splats.beams->minimum)
                .set("maximum", splats.beams->maximum);
        } else if (splats.flux == 4) {
            command.define("FOUR_RADII");
        } else {
            command.set("diameter", splats.diameter);
        }
        dispatchOver(command, list);
    }
}

// Mesa's software rasteriser ends all loops of a thread group after 65,535 turns together: two
// looks at every texel of a splat, on each of six faces.
constexpr float kMaxDiameterOnCubes = 64.0f;

Stored splatInto(FrameBuilder& frame, TexelSplats splats, const Hits& hits, const Store& store,
                 const FluxMap& before) {
    if (splats.beams && store.receivers.views->count() > 1)
        splats.beams->maximum = std::min(splats.beams->maximum, kMaxDiameterOnCubes);
    FluxSets sets = setsIn(frame, store);
    sets.flux = splats.flux;
    sets.parts = splats.parts;
    sets.counts = splats.counts;
    const Splatted& splatted = frame.pass<Splatted>(
        splats.node, splats.reason,
        [&](graph::PassSetup& setup, Splatted& data) {
            data.stored = depositIn(setup, store, hits, before, sets);
            if (splats.beams) {
                data.narrowed = setup.storage(
                    "CutSplats", setup.createBuffer<transport::Narrowed>(
                                     "lens.narrowed" + store.suffix + hits.incoming.suffix, 1));
                setup.bypass(data.narrowed, {0, 0, 0, 0});
            }
        },
        [splats, store, list = hits.incoming](const Splatted& data, gl::PassContext& context) {
            clearIfFirst(context, data.stored);
            if (splats.beams && !context.isRepeated()) context.buffer(data.narrowed).clear();
            drawSplats(splats, store, data, list, context);
        });
    if (splats.beams) {
        reportWidthLimit(frame, splats.node, splatted.narrowed, 0, "max_diameter",
                         static_cast<int>(splats.beams->maximum),
                         "splats are smaller than they were to be");
    }
    return splatted.stored;
}

}  // namespace

CausticMap splat(FrameBuilder& frame, const TexelSplats& splats, const Hits& hits,
                 const Surfaces& surfaces, const CausticMap& before) {
    return storeEverywhere(frame, surfaces, hits, before,
                           [&](const Store& store, const Hits& own, const FluxMap& former) {
                               return splatInto(frame, splats, own, store, former);
                           });
}

}  // namespace kaustik
