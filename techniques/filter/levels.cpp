// SPDX-License-Identifier: MIT
// filter.levels: of each place the finest level with enough photons (WD08, section 4, Fig. 4;
// rejected there). In: the levels of reconstruct.levels, with counts; out: flux a texel, W. It does
// not keep the flux, which the report's blend_energy_ratio says.
#include <utility>

#include "techniques/maps/levels.h"
#include "techniques/maps/map_filters.h"
#include "techniques/maps/map_needs.h"

namespace kaustik {
namespace {

enum class LevelSource : int { splats, mip };

struct LevelFilterParams {
    LevelSource from = LevelSource::splats;
    int minPhotons = 16;
    template <class R>
    void reflect(R& r) {
        r.choice(from, "from",
                 "splats: levels as reconstruct.levels has splatted them; mip: only the finest as "
                 "it has, and all others as sums of four texels of the level before",
                 {"splats", "mip"});
        r.field(minPhotons, "min_photons",
                "Photons on a texel of a level from which on it is enough", "",
                params::range(1, 1000000));
        r.renamed("enough", "min_photons");
    }
};

// Fills the coarser levels from the finest.
FluxMap makeMipChain(FrameBuilder& frame, const FluxMap& map) {
    return frame.pass<FluxMap>(
        "filter.mip", "levels are sums of finer ones",
        [&](graph::PassSetup& setup, FluxMap& data) {
            data = FluxMap::deposit(setup, map, map.on, map.sets, "");
        },
        [](const FluxMap& data, gl::PassContext& context) {
            const Views& views = data.on.views;
            const int levels = levelsOf(views->width(), views->height());
            for (int level = 1; level < levels; ++level) {
                gl::Command command = context.compute("filter/levels_mip.comp");
                setLevelLayout(command, data);
                command.set("level", level)
                    .set("views", views->count())
                    .set("setsBefore", data.sets.perView())
                    .set("fluxSets", data.sets.flux())
                    .dispatchOver((views->width() >> level) + 1, 8, (views->height() >> level) + 1,
                                  8);
            }
        });
}

CausticMap pickLevels(FrameBuilder& frame, const LevelFilterParams& params, CausticMap map) {
    needsMap("filter.levels", map, {SetLayout::levels});
    if (params.from == LevelSource::mip) {
        for (FluxMap& one : map.maps)
            one = makeMipChain(frame, one);
    }
    return filterMaps(
        frame, "filter.levels", "each texel takes the finest level with enough photons",
        std::move(map),
        [](graph::PassSetup& setup, Filtered& data) {
            setup.sample("photonCounts", data.map.counts);
        },
        [params](const Filtered& data, gl::PassContext& context) {
            const Views& views = data.map.on.views;
            gl::Command command = filterCommand(context, "filter/levels.comp", data.map);
            setLevelLayout(command, data.map);
            command.set("levels", levelsOf(views->width(), views->height()))
                .params("filter.levels", params);
            dispatchOverMap(command, data.map);
        });
}

}  // namespace

void registerFilterLevels(Registry& registry) {
    registry.node<FilterStage>(
        "levels",
        {"Takes of each place the finest level with enough photons.",
         "WD08, section 4, Fig. 4; rejected there",
         "It takes the maps of reconstruct=levels and refuses others. It does not keep the flux, "
         "which map.blend_energy_ratio of the report states."},
        &pickLevels);
}

}  // namespace kaustik
