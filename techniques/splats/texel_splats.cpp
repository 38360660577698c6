// SPDX-License-Identifier: MIT
#include "techniques/splats/texel_splats.h"

#include <algorithm>

#include "techniques/maps/levels.h"
#include "techniques/splats/clamped.h"

namespace kaustik {
namespace {

// Splats that are smaller, and that are larger than their beams asked for, as
// shaders/splats/texel_splats.comp has them.
constexpr std::size_t kAboveMaximum = 0;
constexpr std::size_t kBelowMinimum = 1;

struct Splatted {
    Stored stored;
    graph::Buffer<transport::Clamped> clamped;  // of the lens's splats
};

void drawSplats(const TexelSplats& splats, const Store& store, const Splatted& data,
                const Photons& list, gl::PassContext& context) {
    const FluxMap& map = data.stored.map;
    const render::RasterViews& views = *store.receivers.views;
    const bool isShared = splats.layout == SetLayout::sharedLevels;
    const bool hasLevels = isShared || splats.layout == SetLayout::levels;
    const int levels = hasLevels ? levelsOf(views.width(), views.height()) : 1;
    for (int level = 0; level < levels; ++level) {
        gl::Command command = context.compute("splats/texel_splats.comp");
        bindStore(command, store);
        setLevelLayout(command, map);
        command.set("mapsPerView", map.sets.perView())
            .set("fluxSets", map.sets.flux())
            .set("keepsEdges", splats.edges == SplatEdges::kept ? 1 : 0)
            .set("atTexels", splats.center == SplatCenter::texel ? 1 : 0)
            .set("level", level);
        if (map.sets.counts) command.define("COUNTS");
        setDeposit(command, map.sets);
        if (isShared) command.define("ONE_LEVEL").set("levels", levels);
        if (splats.beams) {
            command.define("BEAM_WIDTHS")
                .set("widths", splats.beams->widths)
                .set("isRound", splats.beams->isRound ? 1 : 0)
                .set("minimum", splats.beams->minimum)
                .set("maximum", splats.beams->maximum);
        } else if (splats.layout == SetLayout::sizes) {
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
    FluxSets sets = setsIn(frame, store, splats.layout);
    sets.counts = splats.counts;
    const Splatted& splatted = frame.pass<Splatted>(
        splats.node, splats.reason,
        [&](graph::PassSetup& setup, Splatted& data) {
            data.stored = depositIn(setup, store, hits, before, sets);
            if (splats.beams) {
                data.clamped = setup.storage(
                    "ClampedWidths", setup.createBuffer<transport::Clamped>(
                                         "lens.clamped" + store.suffix + hits.incoming.suffix, 2));
                setup.bypass(data.clamped, {0, 0, 0, 0});
            }
        },
        [splats, store, list = hits.incoming](const Splatted& data, gl::PassContext& context) {
            clearIfFirst(context, data.stored);
            if (splats.beams && !context.isRepeated()) context.buffer(data.clamped).clear();
            drawSplats(splats, store, data, list, context);
        });
    if (splats.beams) {
        WidthLimit limit{splats.node,
                         "max_diameter",
                         WidthBound::largest,
                         static_cast<double>(splats.beams->maximum),
                         "texels",
                         "splats are smaller than they were to be",
                         store.cascade > 0};
        reportWidthLimit(frame, limit, splatted.clamped, kAboveMaximum);
        limit.parameter = "min_diameter";
        limit.bound = WidthBound::smallest;
        limit.value = static_cast<double>(splats.beams->minimum);
        limit.counted = "splats are larger than they were to be";
        reportWidthLimit(frame, limit, splatted.clamped, kBelowMinimum);
    }
    return splatted.stored;
}

}  // namespace

CausticMap splat(FrameBuilder& frame, const TexelSplats& splats, const Hits& hits,
                 const Surfaces& surfaces, const CausticMap& before) {
    if (splats.edges == SplatEdges::crossed) {
        frame.warn(fmt::format(
            "{0}.edges=crossed lets light lie on what is next to its surface on the map, in front "
            "of it or behind; {0}.edges=kept does not.",
            splats.node));
    }
    return storeEverywhere(frame, surfaces, hits, before,
                           [&](const Store& store, const Hits& own, const FluxMap& former) {
                               return splatInto(frame, splats, own, store, former);
                           });
}

}  // namespace kaustik
