// SPDX-License-Identifier: MIT
// filter.blur, blend and levels: what is made of a map of flux once all light has been stored. Flux
// a texel, W, before and after; the blur keeps it, the others do not (WD08, section 4.1), which the
// report's blend_energy_ratio says. What a map holds besides, for glossy receivers, is kept.
#include <fmt/format.h>

#include <functional>
#include <utility>

#include "framework/core/error.h"
#include "framework/pipeline/frame_builder.h"
#include "techniques/caustic_map/levels.h"
#include "techniques/caustic_map/map_filters.h"
#include "techniques/caustic_map/nodes.h"
#include "techniques/shared/generators.h"

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
    LevelSource from = LevelSource::splats;
    int enough = 16;
    template <class R>
    void reflect(R& r) {
        r.choice(from, "from",
                 "splats: levels as reconstruct.levels has splatted them; mip: sums of four texels "
                 "of the level before",
                 {"splats", "mip"});
        r.field(enough, "enough", "Photons on a texel of a level from which on it is enough", "",
                params::range(1, 1000000));
    }
};

// Of filter.blur, along x alone.
using Blurred = graph::Texture<FilteredTexel>;

struct Filtered {
    FluxMap map;
    Blurred blurred;
};

using MoreSetup = std::function<void(graph::PassSetup&, Filtered&)>;
using FilterCommands = std::function<void(const Filtered&, gl::PassContext&)>;

std::string suffixOf(const FluxMap& map) {
    if (map.light >= 0) {
        return (map.light > 0 ? fmt::format(".light_{}", map.light + 1) : "") +
               (map.cascade > 0 ? fmt::format(".cascade_{}", map.cascade + 1) : "");
    }
    return map.generator > 0 ? suffixOfGenerator(static_cast<std::size_t>(map.generator)) : "";
}

template <class Texel>
graph::Texture<Texel> createLike(graph::PassSetup& setup, const std::string& name,
                                 const FluxMap& map, int layersPerView) {
    const Views& views = map.on.views;
    return setup.create<Texel>(name + suffixOf(map), views->width(), views->height(),
                               views->count() * layersPerView);
}

// Adds a pass for each map of the frame.
CausticMap filterMaps(FrameBuilder& frame, const std::string& node, const std::string& why,
                      CausticMap map, const MoreSetup& more, const FilterCommands& commands) {
    for (FluxMap& one : map.maps) {
        one = frame
                  .pass<Filtered>(
                      node, why,
                      [&](graph::PassSetup& setup, Filtered& data) {
                          data.map = one;
                          setup.sample("fluxSums", one.flux);
                          data.map.filtered =
                              setup.image("filteredFlux",
                                          createLike<FilteredTexel>(setup, "caustic.filtered", one,
                                                                    one.filteredPerView()));
                          more(setup, data);
                      },
                      [commands](const Filtered& data, gl::PassContext& context) {
                          commands(data, context);
                      })
                  .map;
    }
    return map;
}

gl::Command filterCommand(gl::PassContext& context, const char* shader, const FluxMap& map) {
    gl::Command command = context.compute(std::string("caustic_map/") + shader);
    command.set("setsBefore", map.sets.perView())
        .set("setsAfter", map.filteredPerView())
        .set("lastIsIntensity", map.sets.hasIntensity ? 1 : 0)
        .set("views", map.on.views->count());
    return command;
}

void dispatchOverMap(gl::Command& command, const FluxMap& map) {
    command.dispatchOver(map.on.views->width(), 8, map.on.views->height(), 8);
}

// A filter of maps that are not there.
void needsSets(const std::string& node, const CausticMap& map, int sets, const char* instead) {
    const FluxSets& own = map.maps.front().sets;
    if (own.flux == sets && own.counts) return;
    throw ConfigError(
        fmt::format("{} takes the maps of {}; take that, or filter=none.", node, instead));
}

CausticMap blurMap(FrameBuilder& frame, const BlurParams& params, CausticMap map) {
    if (map.maps.front().sets.flux > 1)
        throw ConfigError(
            "filter.blur takes one map; reconstruct.four_radii and levels make "
            "several: take filter=blend or filter=levels.");
    const int diameter = params.diameter - (params.diameter % 2 == 0 ? 1 : 0);
    return filterMaps(
        frame, "filter.blur", "points become what splats would be", std::move(map),
        [](graph::PassSetup& setup, Filtered& data) {
            data.blurred =
                setup.image("blurred", createLike<FilteredTexel>(setup, "caustic.blurred", data.map,
                                                                 data.map.sets.perView()));
        },
        [diameter](const Filtered& data, gl::PassContext& context) {
            for (int axis = 0; axis < 2; ++axis) {
                gl::Command command = filterCommand(context, "blur.comp", data.map);
                command.set("diameter", diameter).set("axis", axis);
                dispatchOverMap(command, data.map);
            }
        });
}

CausticMap blendSizes(FrameBuilder& frame, const BlendParams& params, CausticMap map) {
    needsSets("filter.blend", map, 4, "reconstruct.four_radii");
    return filterMaps(
        frame, "filter.blend", "each texel takes the splats that its photons are dense enough for",
        std::move(map),
        [](graph::PassSetup& setup, Filtered& data) {
            setup.sample("photonCounts", data.map.counts);
        },
        [params](const Filtered& data, gl::PassContext& context) {
            gl::Command command = filterCommand(context, "blend.comp", data.map);
            command.params("filter.blend", params);
            dispatchOverMap(command, data.map);
        });
}

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
                gl::Command command = context.compute("caustic_map/mip.comp");
                setLevelLayout(command, data);
                command.set("level", level)
                    .set("views", views->count())
                    .set("setsBefore", data.sets.perView())
                    .dispatchOver((views->width() >> level) + 1, 8, (views->height() >> level) + 1,
                                  8);
            }
        });
}

CausticMap pickLevels(FrameBuilder& frame, const LevelFilterParams& params, CausticMap map) {
    needsSets("filter.levels", map, 2, "reconstruct.levels");
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
            gl::Command command = filterCommand(context, "levels.comp", data.map);
            setLevelLayout(command, data.map);
            command.set("levels", levelsOf(views->width(), views->height()))
                .params("filter.levels", params);
            dispatchOverMap(command, data.map);
        });
}

CausticMap addLevels(FrameBuilder& frame, const params::NoParams&, CausticMap map) {
    if (map.maps.front().sets.parts != 2) {
        throw ConfigError(
            "filter.level_sum takes the maps of reconstruct.multi_level; take that, or "
            "filter=none.");
    }
    return filterMaps(
        frame, "filter.level_sum", "each place gets what every level holds of it", std::move(map),
        [](graph::PassSetup&, Filtered&) {},
        [](const Filtered& data, gl::PassContext& context) {
            const Views& views = data.map.on.views;
            gl::Command command = filterCommand(context, "level_sum.comp", data.map);
            setLevelLayout(command, data.map);
            command.set("levels", levelsOf(views->width(), views->height()));
            dispatchOverMap(command, data.map);
        });
}

}  // namespace

CausticMap inFloats(FrameBuilder& frame, CausticMap map) {
    if (map.maps.front().filtered.valid()) return map;
    // Of the frame's one map, for whoever asks first.
    return *frame.once<CausticMap>("map.in_floats", [&] {
        return std::make_shared<CausticMap>(filterMaps(
            frame, "gather.unpack", "a texel of the map is looked up more than once",
            std::move(map), [](graph::PassSetup&, Filtered&) {},
            [](const Filtered& data, gl::PassContext& context) {
                gl::Command command = filterCommand(context, "unpack.comp", data.map);
                dispatchOverMap(command, data.map);
            }));
    });
}

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
    registry.node<FilterStage>(
        "level_sum", {"Adds up all levels of a multi-resolution map.", "WN09, section 3.2.2"},
        &addLevels);
}

}  // namespace kaustik
