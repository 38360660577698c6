// SPDX-License-Identifier: MIT
// filter.blur, blend and levels: what is made of a map of flux once all light has been stored. Flux
// a texel, W, before and after; the blur keeps it, the others do not (WD08, section 4.1), which the
// report's blend_energy_ratio says. What a map holds besides, for glossy receivers, is kept.
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "framework/core/error.h"
#include "framework/pipeline/frame_builder.h"
#include "techniques/caustic_map/levels.h"
#include "techniques/caustic_map/nodes.h"

namespace kaustik {
namespace {

struct BlurParams {
    int diameter = 7;
    template <class R>
    void reflect(R& r) {
        r.field(diameter, "diameter", "Of the Gaussian; an even number is one less", "texels",
                params::range(1, 63));
    }
};

enum class Interpolant : int { bernstein, linear };

struct BlendParams {
    Interpolant interpolant = Interpolant::bernstein;
    int least = 8;
    int most = 16;
    template <class R>
    void reflect(R& r) {
        r.choice(interpolant, "interpolant",
                 "bernstein: up to three sizes, smaller ones where they are brighter; linear: two, "
                 "which rings",
                 {"bernstein", "linear"});
        r.field(least, "least", "Photons on a texel up to which a size of splat is not used", "",
                params::range(0, 1000000));
        r.field(most, "most", "Photons on a texel from which on a size of splat is enough", "",
                params::range(1, 1000000));
    }
};

enum class LevelSource : int { splats, mip };

struct LevelFilterParams {
    LevelSource source = LevelSource::splats;
    int photons = 16;
    template <class R>
    void reflect(R& r) {
        r.choice(source, "source",
                 "splats: levels as reconstruct.levels has splatted them; mip: sums of four texels "
                 "of the level before",
                 {"splats", "mip"});
        r.field(photons, "photons", "Photons on a texel of a level from which on it is enough", "",
                params::range(1, 1000000));
    }
};

struct Filtered {
    FluxMap map;
    FluxMap before;
    graph::Texture<IrradianceTexel> blurred;  // of filter.blur, along x alone
};

using FilterCommands = std::function<void(const Filtered&, gl::PassContext&)>;

// Adds a pass for each map of the frame.
CausticMap filterMaps(FrameBuilder& frame, const std::string& node, const std::string& why,
                      const CausticMap& map, const std::function<void(graph::PassSetup&, Filtered&)>& more,
                      const FilterCommands& commands) {
    CausticMap result = map;
    for (FluxMap& one : result.maps) {
        const FluxMap before = one;
        one = frame
                  .pass<Filtered>(
                      node, why,
                      [&](graph::PassSetup& setup, Filtered& data) {
                          data.before = before;
                          data.map = before;
                          data.map.sets.flux = 1;
                          data.map.sets.counts = false;
                          data.map.counts = {};
                          const Views& views = before.on.views;
                          const std::string suffix =
                              before.light > 0 ? fmt::format(".light_{}", before.light + 1) : "";
                          data.map.flux = setup.create<FluxWord>(
                              "caustic.filtered" + suffix, views->width(), views->height(),
                              views->layers(data.map.wordsPerView()));
                          setup.image("filteredSums", data.map.flux);
                          if (before.sets.flux == 1) setup.bypass(data.map.flux, before.flux);
                          more(setup, data);
                      },
                      [commands](const Filtered& data, gl::PassContext& context) {
                          commands(data, context);
                      })
                  .map;
    }
    return result;
}

void setMaps(gl::Command& command, const Filtered& data) {
    command.set("setsBefore", data.before.sets.perView())
        .set("views", data.before.on.views->count());
}

void dispatchOverMap(gl::Command& command, const Filtered& data) {
    const Views& views = data.before.on.views;
    command.dispatchOver(views->width(), 8, views->height(), 8);
}

// A filter of maps that are not there.
void needsSets(const std::string& node, const CausticMap& map, int sets, const char* instead) {
    const FluxSets& own = map.maps.front().sets;
    if (own.flux == sets && own.counts) return;
    throw ConfigError(fmt::format("{} takes the maps of {}; take that, or filter=none.", node,
                                  instead));
}

CausticMap blurMap(FrameBuilder& frame, const BlurParams& params, CausticMap map) {
    if (map.maps.front().sets.flux > 1)
        throw ConfigError("filter.blur takes one map; reconstruct.four_radii and levels make "
                          "several, for filter.blend and filter.levels.");
    const int diameter = params.diameter - (params.diameter % 2 == 0 ? 1 : 0);
    return filterMaps(
        frame, "filter.blur", "points become what splats would be", map,
        [](graph::PassSetup& setup, Filtered& data) {
            const Views& views = data.before.on.views;
            setup.sample("fluxSums", data.before.flux);
            data.blurred = setup.image(
                "blurred", setup.create<IrradianceTexel>(
                               data.before.light > 0
                                   ? fmt::format("caustic.blurred.light_{}", data.before.light + 1)
                                   : "caustic.blurred",
                               views->width(), views->height(),
                               std::max(1, views->layers(data.before.sets.perView()))));
            setup.bypass(data.blurred, {0, 0, 0, 0});
        },
        [diameter](const Filtered& data, gl::PassContext& context) {
            for (int axis = 0; axis < 2; ++axis) {
                gl::Command command = context.compute("caustic_map/blur.comp");
                setMaps(command, data);
                command.set("diameter", diameter).set("axis", axis);
                dispatchOverMap(command, data);
            }
        });
}

CausticMap blendSizes(FrameBuilder& frame, const BlendParams& params, CausticMap map) {
    needsSets("filter.blend", map, 4, "reconstruct.four_radii");
    return filterMaps(
        frame, "filter.blend", "each texel takes the splats that its photons are dense enough for",
        map,
        [](graph::PassSetup& setup, Filtered& data) {
            setup.sample("fluxSums", data.before.flux);
            setup.sample("photonCounts", data.before.counts);
        },
        [params](const Filtered& data, gl::PassContext& context) {
            gl::Command command = context.compute("caustic_map/blend.comp");
            setMaps(command, data);
            command.set("setsAfter", data.map.sets.perView()).params("filter.blend", params);
            dispatchOverMap(command, data);
        });
}

CausticMap pickLevels(FrameBuilder& frame, const LevelFilterParams& params, CausticMap map) {
    needsSets("filter.levels", map, 2, "reconstruct.levels");
    const bool isMip = params.source == LevelSource::mip;
    if (isMip) {
        for (FluxMap& one : map.maps) {
            one = frame.pass<FluxMap>(
                "filter.mip", "levels are sums of finer ones",
                [&](graph::PassSetup& setup, FluxMap& data) {
                    data = FluxMap::deposit(setup, one, one.on, one.sets, "");
                },
                [](const FluxMap& data, gl::PassContext& context) {
                    const Views& views = data.on.views;
                    const int levels = levelsOf(views->width(), views->height());
                    for (int level = 1; level < levels; ++level) {
                        gl::Command command = context.compute("caustic_map/mip.comp");
                        setLevelLayout(command, data);
                        command.set("level", level)
                            .set("views", views->count())
                            .set("setsBefore", data.sets.perView())
                            .dispatchOver((views->width() >> level) + 1, 8,
                                          (views->height() >> level) + 1, 8);
                    }
                });
        }
    }
    return filterMaps(
        frame, "filter.levels", "each texel takes the finest level with enough photons", map,
        [](graph::PassSetup& setup, Filtered& data) {
            setup.sample("fluxSums", data.before.flux);
            setup.sample("photonCounts", data.before.counts);
        },
        [params](const Filtered& data, gl::PassContext& context) {
            const Views& views = data.before.on.views;
            gl::Command command = context.compute("caustic_map/levels.comp");
            setMaps(command, data);
            setLevelLayout(command, data.before);
            command.set("setsAfter", data.map.sets.perView())
                .set("levels", levelsOf(views->width(), views->height()))
                .params("filter.levels", params);
            dispatchOverMap(command, data);
        });
}

}  // namespace

void registerMapFilters(Registry& registry) {
    registry.node<FilterStage>(
        "blur", {"Blurs the map's texels by a Gaussian, for points.", "WD06"}, &blurMap);
    registry.node<FilterStage>(
        "blend",
        {"Takes of four sizes of splats those that enough photons lie on.", "WD08, section 4.1"},
        &blendSizes);
    registry.node<FilterStage>("levels",
                               {"Takes of each place the finest level with enough photons.",
                                "WD08, section 4, Fig. 4; rejected there"},
                               &pickLevels);
}

}  // namespace kaustik
