// SPDX-License-Identifier: MIT
// reconstruct.fixed, four_radii, levels and lens: photons as Gaussian splats of the texels of
// whatever they are stored in, a light's map or the screen (WD06, WD08). A point of OpenGL is a
// square, and so is their support; weights are summed over the texels that take them first, so that
// each size deposits the photon's flux exactly. In: hits, eye view space, m and W; out: flux a
// texel, W, in as many sets as there are sizes or levels.
#include <fmt/format.h>

#include <algorithm>

#include "framework/core/error.h"
#include "framework/pipeline/frame_builder.h"
#include "techniques/caustic_map/levels.h"
#include "techniques/caustic_map/nodes.h"
#include "techniques/shared/narrowed.h"
#include "techniques/shared/stores.h"

namespace kaustik {
namespace {

// Which texels a splat lies on.
enum class SplatEdges : int { kept, crossed };
enum class SplatCenter : int { photon, texel };

constexpr const char* kEdgesSentence =
    "kept: texels that see the photon's own surface; crossed: all that it covers, as published, so "
    "that light leaks over edges";

struct FixedParams {
    int diameter = 7;
    SplatEdges edges = SplatEdges::kept;
    SplatCenter center = SplatCenter::photon;
    template <class R>
    void reflect(R& r) {
        r.field(diameter, "diameter", "Of a splat; 1: points, for filter.blur", "texels",
                params::range(1, 63));
        r.choice(edges, "edges", kEdgesSentence, {"kept", "crossed"});
        r.choice(center, "center", "photon: where it arrives; texel: the middle of its texel",
                 {"photon", "texel"});
    }
};

struct FourRadiiParams {
    SplatEdges edges = SplatEdges::kept;
    template <class R>
    void reflect(R& r) {
        r.choice(edges, "edges", kEdgesSentence, {"kept", "crossed"});
    }
};

struct LevelsParams {
    int diameter = 3;
    template <class R>
    void reflect(R& r) {
        r.field(diameter, "diameter",
                "Of a splat in every level, in that level's texels; 1: points", "texels",
                params::range(1, 15));
    }
};

struct MultiLevelParams {
    int diameter = 3;
    template <class R>
    void reflect(R& r) {
        r.field(diameter, "diameter", "Of a splat, in texels of its photon's level; 1: points",
                "texels", params::range(1, 15));
    }
};

struct LensParams {
    float widths = 3.5f;
    float least = 2.0f;
    float most = 96.0f;
    SplatEdges edges = SplatEdges::kept;
    template <class R>
    void reflect(R& r) {
        r.field(widths, "widths",
                "Diameter of a splat in widths of its photon's beam, D0 of WD08's Eq. 7; more is "
                "less noise and more blur",
                "", params::range(0.1f, 100.0f));
        r.field(least, "least", "Smallest diameter", "texels", params::range(1.0f, 127.0f));
        r.field(most, "most", "Largest diameter; splats shrink to it", "texels",
                params::range(1.0f, 127.0f));
        r.choice(edges, "edges", kEdgesSentence, {"kept", "crossed"});
    }
};

struct TexelSplats {
    std::string node;
    std::string why;
    int flux = 1;   // sets of it
    int parts = 1;  // of these add up
    bool counts = false;
    SplatEdges edges = SplatEdges::kept;
    SplatCenter center = SplatCenter::photon;
    float diameter = 7.0f;
    bool hasLevels = false;
    bool intoOne = false;  // of the levels, as coarse as the photon's beam is wide
    std::optional<LensParams> lens = {};
};

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
        gl::Command command = context.compute("caustic_map/splats.comp");
        bindStore(command, store);
        setLevelLayout(command, map);
        command.set("mapsPerView", map.sets.perView())
            .set("keepsEdges", splats.edges == SplatEdges::kept ? 1 : 0)
            .set("atTexels", splats.center == SplatCenter::texel ? 1 : 0)
            .set("level", level);
        if (map.sets.counts) command.define("COUNTS").set("countsPerView", map.sets.flux);
        setDeposit(command, map.sets);
        if (splats.intoOne) command.define("ONE_LEVEL").set("levels", levels);
        if (splats.lens) {
            command.define("BEAM_WIDTHS")
                .set("widths", splats.lens->widths)
                .set("least", splats.lens->least)
                .set("most", splats.lens->most);
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
constexpr float kMostOnCubes = 64.0f;

Stored splatInto(FrameBuilder& frame, TexelSplats splats, const Hits& hits, const Store& store,
                 const FluxMap& before) {
    if (splats.lens && store.receivers.views->count() > 1)
        splats.lens->most = std::min(splats.lens->most, kMostOnCubes);
    FluxSets sets = setsIn(frame, store);
    sets.flux = splats.flux;
    sets.parts = splats.parts;
    sets.counts = splats.counts;
    const Splatted& splatted = frame.pass<Splatted>(
        splats.node, splats.why,
        [&](graph::PassSetup& setup, Splatted& data) {
            data.stored = depositIn(setup, store, hits, before, sets);
            if (splats.lens) {
                data.narrowed = setup.storage(
                    "CutSplats", setup.createBuffer<transport::Narrowed>(
                                     "lens.narrowed" + store.suffix + hits.incoming.suffix, 1));
                setup.bypass(data.narrowed, {0, 0, 0, 0});
            }
        },
        [splats, store, list = hits.incoming](const Splatted& data, gl::PassContext& context) {
            clearIfFirst(context, data.stored);
            if (splats.lens && !context.isRepeated()) context.buffer(data.narrowed).clear();
            drawSplats(splats, store, data, list, context);
        });
    if (splats.lens) {
        keepToWidth(frame, splats.node, splatted.narrowed, 0, "most",
                    static_cast<int>(splats.lens->most), "splats are smaller than they were to be");
    }
    return splatted.stored;
}

CausticMap splat(FrameBuilder& frame, const TexelSplats& splats, const Hits& hits,
                 const Surfaces& surfaces, const CausticMap& before) {
    return storeEverywhere(frame, surfaces, hits, before,
                           [&](const Store& store, const Hits& own, const FluxMap& former) {
                               return splatInto(frame, splats, own, store, former);
                           });
}

CausticMap splatFixed(FrameBuilder& frame, const FixedParams& params, Hits hits, Surfaces surfaces,
                      CausticMap before) {
    TexelSplats splats{.node = "reconstruct.fixed", .why = "photons are splats of one size"};
    splats.edges = params.edges;
    splats.center = params.center;
    splats.diameter = static_cast<float>(params.diameter);
    return splat(frame, splats, hits, surfaces, before);
}

CausticMap splatFourRadii(FrameBuilder& frame, const FourRadiiParams& params, Hits hits,
                          Surfaces surfaces, CausticMap before) {
    TexelSplats splats{.node = "reconstruct.four_radii",
                       .why = "photons are splats of four sizes, counted by texel"};
    splats.edges = params.edges;
    splats.flux = 4;
    splats.counts = true;
    return splat(frame, splats, hits, surfaces, before);
}

CausticMap splatLevels(FrameBuilder& frame, const LevelsParams& params, Hits hits,
                       Surfaces surfaces, CausticMap before) {
    TexelSplats splats{.node = "reconstruct.levels",
                       .why = "photons are splats in every level of the map"};
    // Coarser levels' texels hold several surfaces, and cross edges all the same.
    splats.diameter = static_cast<float>(params.diameter);
    splats.flux = 2;
    splats.counts = true;
    splats.hasLevels = true;
    return splat(frame, splats, hits, surfaces, before);
}

CausticMap splatOneLevel(FrameBuilder& frame, const MultiLevelParams& params, Hits hits,
                         Surfaces surfaces, CausticMap before) {
    needsBeams(frame, "reconstruct.multi_level", hits.incoming);
    TexelSplats splats{.node = "reconstruct.multi_level",
                       .why = "photons whose light spreads are splats in coarser levels"};
    splats.diameter = static_cast<float>(params.diameter);
    splats.flux = 2;
    splats.counts = true;
    splats.hasLevels = true;
    splats.intoOne = true;
    splats.parts = 2;
    if (frame.needs().glossyReceivers) {
        throw ConfigError(
            "reconstruct.multi_level keeps no directions, which the scene's glossy receivers need; "
            "take reconstruct=lens.");
    }
    return splat(frame, splats, hits, surfaces, before);
}

CausticMap splatLens(FrameBuilder& frame, const LensParams& params, Hits hits, Surfaces surfaces,
                     CausticMap before) {
    needsBeams(frame, "reconstruct.lens", hits.incoming);
    TexelSplats splats{.node = "reconstruct.lens",
                       .why = "photons are splats as wide as their beams where they arrive"};
    splats.edges = params.edges;
    splats.lens = params;
    return splat(frame, splats, hits, surfaces, before);
}

}  // namespace

void registerTexelSplats(Registry& registry) {
    registry.node<ReconstructStage>(
        "fixed", {"Splats each photon as a Gaussian of so many texels.", "WD06; WD08, section 3"},
        &splatFixed);
    registry.node<ReconstructStage>(
        "four_radii",
        {.sentence = "Splats each photon in four sizes at once, 3, 7, 11 and 15 texels, and counts "
                     "photons; filter.blend takes one or some of them.",
         .source = "WD08, section 4.1",
         .filter = "blend"},
        &splatFourRadii);
    registry.node<ReconstructStage>(
        "levels",
        {.sentence = "Splats each photon into every level of the map's resolution; filter.levels "
                     "takes one.",
         .source = "WD08, section 4, Fig. 4; rejected there",
         .filter = "levels"},
        &splatLevels);
    registry.node<ReconstructStage>(
        "multi_level",
        {.sentence = "Splats each photon into that level of the map's resolution whose texels are "
                     "as wide as its beam where it arrives; filter.level_sum adds up all of them.",
         .source = "WN09, section 3.2.2, multi-resolution caustic map",
         .beams = true,
         .filter = "level_sum"},
        &splatOneLevel);
    registry.node<ReconstructStage>(
        "lens",
        {.sentence = "Splats each photon as a round Gaussian as wide as its beam is where it "
                     "arrives (specular.two_interfaces.lens says how that is known).",
         .source = "WD08, section 4.2, Eqs. 1 to 7",
         .beams = true},
        &splatLens);
}

}  // namespace kaustik
