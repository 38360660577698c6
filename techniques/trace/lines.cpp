// SPDX-License-Identifier: MIT
// trace.lines: each photon's ray as a line into a row of a texture, one fragment a step, every
// layer looked up; trace.reduce: log2(width) halvings of the rows leave a column of first hits
// (K06, section 2.1). Photons that do not fit into the row texture follow in batches; the result
// does not depend on their size. The line's vertices come from their number instead of a vertex
// array. In: photons and layered depth in eye view space, m; out: hits, W that arrive after
// absorption.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/pipeline/frame_builder.h"
#include "techniques/tracing/hit_testing.h"

namespace kaustik {
namespace {

// How each photon's line gets its vertices (K06, section 2.1; section 6, future work).
enum class LineSource : int { vertex, geometry };

struct LinesParams {
    LineSource source = LineSource::vertex;
    int width = 0;
    int rows = 0;
    int memoryMebibytes = 64;
    int minimum = 4;
    template <class R>
    void reflect(R& r) {
        r.choice(source, "source",
                 "vertex: a vertex shader places both ends of each line; geometry: a geometry "
                 "shader makes the line from one point",
                 {"vertex", "geometry"});
        r.field(width, "width",
                "Most fragments of a photon's line; 0: as many as the longer side of the picture "
                "has pixels, so that no step skips one",
                "texels", params::range(0, 16384));
        r.field(rows, "rows", "Photons in a batch, one row each; 0: as many as the memory allows",
                "", params::range(0, 16384));
        r.field(memoryMebibytes, "memory",
                "Most memory for the row texture and its reductions; fewer rows mean more batches",
                "MiB", params::range(1, 8192));
        r.field(minimum, "minimum",
                "Fewest fragments of a line, for rays almost parallel to the view direction",
                "texels", params::range(1, 64));
    }
};

struct RowTexel {  // x: ray parameter of a hit, m, 0 none; y: step and layer
    static constexpr Format format = Format::rg32f;
};

struct RowExtent {  // fragments of a batch's longest line
    std::uint32_t fragments;
};

struct RowTextures {
    graph::Texture<RowTexel> rows;
    graph::Buffer<RowExtent> extents;  // by batch
    // The reduce goes back and forth between these; either may be the one that ends up one wide.
    graph::Texture<RowTexel> half;
    graph::Texture<RowTexel> quarter;
};

int halved(int width) {
    return (width + 1) / 2;
}

struct Layout {
    int width;  // texels of a row
    int steps;  // most of a ray; of one tile of the screen a row has those on it
    int rows;
    int batches;
    ReachedLimit limit;  // what makes more than one batch
};

constexpr int kMaxRows = 16384;  // of a texture, on every device of OpenGL 4.5

// Steps of a ray on a tile: none is longer than a pixel, and they are shorter only where there are
// no more of them than of pixels and one.
int stepsOnTile(const PixelRegion& tile) {
    const glm::ivec2 extent = tile.end - tile.first;
    return std::max(extent.x, extent.y) + 4;
}

Layout makeLayout(const FrameBuilder& frame, const LinesParams& params, int photonCount) {
    const int steps = params.width > 0 ? params.width
                                       : std::clamp(std::max(frame.width(), frame.height()),
                                                    params.minimum, kMaxRows);
    const std::optional<ScreenTile> tile = frame.tile();
    const int width =
        tile ? std::min(steps, std::max(stepsOnTile(tile->own), params.minimum)) : steps;
    const auto bytesPerRow =
        static_cast<std::size_t>(width + halved(width) + halved(halved(width))) *
        graph::bytesPerTexel(RowTexel::format);
    const std::size_t memory = static_cast<std::size_t>(params.memoryMebibytes) << 20;
    const auto affordable =
        static_cast<int>(std::clamp<std::size_t>(memory / bytesPerRow, 1, kMaxRows));
    const int wanted = params.rows > 0 ? params.rows : photonCount;
    const int rows = std::clamp(std::min(wanted, photonCount), 1, affordable);
    const int batches = (photonCount + rows - 1) / rows;
    // Batches cost time and nothing else.
    const std::string lost = fmt::format(
        "{} passes over the photons of a tracing instead of one; no flux is lost to it", batches);
    const double needed = static_cast<double>(photonCount);
    const double mebibytes = needed * static_cast<double>(bytesPerRow) / 1048576.0;
    const ReachedLimit byRows{
        "trace.lines.rows", "rows", static_cast<double>(rows), needed, lost, 0.0};
    const ReachedLimit byMemory{
        "trace.lines.memory", "MiB", static_cast<double>(params.memoryMebibytes),
        std::ceil(mebibytes), lost,  0.0};
    const bool isByRows = rows == wanted || rows == kMaxRows;
    return {width, steps, rows, batches, isByRows ? byRows : byMemory};
}

// `run` counts the tracings of a frame: after each specular interaction there is one.
RowTextures createRows(graph::PassSetup& setup, const Layout& layout, int run) {
    const std::string suffix = run == 1 ? "" : fmt::format("_{}", run);
    const int half = halved(layout.width);
    RowTextures textures;
    textures.rows = setup.create<RowTexel>("trace.rows" + suffix, layout.width, layout.rows);
    textures.half = setup.create<RowTexel>("trace.rows_half" + suffix, half, layout.rows);
    textures.quarter =
        setup.create<RowTexel>("trace.rows_quarter" + suffix, halved(half), layout.rows);
    textures.extents = setup.createBuffer<RowExtent>("trace.row_extents" + suffix,
                                                     static_cast<std::size_t>(layout.batches));
    return textures;
}

RowTextures rasterizeLines(FrameBuilder& frame, const LinesParams& params, const Photons& photons,
                           const LayeredDepth& layers, const Layout& layout, RowTextures textures,
                           int batch) {
    const HitTesting testing = hitTesting(frame);
    const int run = frame.runsOf(TraceStage::name);
    return frame.pass<RowTextures>(
        "trace.lines",
        fmt::format("{} rows of {} texels, {} batch{}", layout.rows, layout.width, layout.batches,
                    layout.batches == 1 ? "" : "es"),
        [&](graph::PassSetup& setup, RowTextures& data) {
            photons.sample(setup);
            readLayers(setup, layers);
            data = batch == 0 ? createRows(setup, layout, run) : textures;
            if (batch > 0) {
                data.rows = setup.write(textures.rows);
                data.extents = setup.write(textures.extents);
            }
            setup.storage("RowExtents", data.extents);
            if (layers.tile) setup.define("TILE_SEARCH");
        },
        [params, testing, layout, layers, batch](const RowTextures& data,
                                                 gl::PassContext& context) {
            if (batch == 0) context.buffer(data.extents).clear();
            const bool isMade = params.source == LineSource::geometry;
            std::vector<std::string> shaders{"trace/lines.vert"};
            if (isMade) shaders = {"trace/lines_point.vert", "trace/lines.geom"};
            shaders.push_back("trace/lines.frag");
            gl::Command command = context.shaders(shaders);
            setHitTesting(command, testing, layers)
                .params("trace.lines", params)
                .set("batch", batch)
                .set("firstPhoton", batch * layout.rows)
                .set("rowsSize", glm::ivec2(layout.width, layout.rows))
                .set("maxSteps", layout.steps)
                .target(data.rows)
                .clear()
                .drawArrays(isMade ? GL_POINTS : GL_LINES, isMade ? layout.rows : 2 * layout.rows);
        });
}

struct Reduced {
    RowTextures textures;
    Hits hits;
};

Reduced reduceRows(FrameBuilder& frame, const LinesParams& params, const LayeredDepth& layers,
                   const Layout& layout, RowTextures textures, const Hits& hits, int batch) {
    const HitTesting testing = hitTesting(frame);
    return frame.pass<Reduced>(
        "trace.reduce", "the first hit of each row",
        [&](graph::PassSetup& setup, Reduced& data) {
            readLayers(setup, layers);
            data.textures.rows = setup.read(textures.rows);
            data.textures.extents = setup.storage("RowExtents", textures.extents);
            data.textures.half = setup.write(textures.half);
            data.textures.quarter = setup.write(textures.quarter);
            hits.incoming.sample(setup);
            data.hits = hits;
            if (batch == 0) {
                data.hits = Hits::create(setup, hits.incoming);
                createTileOutput(setup, layers, data.hits);
            } else {
                data.hits.rewrite(setup);
                rewriteTileOutput(setup, layers, data.hits);
            }
            data.hits.store(setup);
            data.hits.incoming.account(setup);
        },
        [params, testing, layout, layers, batch](const Reduced& data, gl::PassContext& context) {
            graph::ResourceRef source = data.textures.rows;
            graph::ResourceRef target = data.textures.half;
            graph::ResourceRef spare = data.textures.quarter;
            int halvings = 0;
            for (int width = layout.width; width > 1; width = halved(width)) {
                ++halvings;
                context.shaders({"trace/lines_reduce.vert", "trace/lines_reduce.frag"})
                    .texture("source", source)
                    .set("batch", batch)
                    .set("halvings", halvings)
                    .set("targetSize", glm::ivec2(halved(width), layout.rows))
                    .target(target)
                    .viewport(0, 0, halved(width), layout.rows)
                    .drawArrays(GL_TRIANGLE_STRIP, 4);
                source = target;
                std::swap(target, spare);
            }
            gl::Command command = context.compute("trace/lines_resolve.comp");
            setHitTesting(command, testing, layers)
                .params("trace.lines", params)
                .set("batch", batch)
                .texture("column", source)
                .set("firstPhoton", batch * layout.rows)
                .set("maxSteps", layout.steps)
                .dispatchOver(layout.rows, 64);
        });
}

Hits traceLines(FrameBuilder& frame, const LinesParams& params, Photons photons,
                Surfaces surfaces) {
    const LayeredDepth& layers = surfaces.layers;
    needsEyesView("trace.lines", "the layers", layers.views);
    // The device alone knows how many there are: rows for as many as there may be.
    const Layout layout = makeLayout(frame, params, photons.capacity());
    reportStepLimit(frame, "trace.lines", "trace.lines.width", layout.steps, layers);
    requireEveryPixel("trace.lines.width", layout.steps, layers);
    if (layout.batches > 1)
        frame.reportLimit({"trace.lines", {}, [=](const gl::Executor&) { return layout.limit; }});
    RowTextures textures;
    Hits hits;
    hits.incoming = photons;
    for (int batch = 0; batch < layout.batches; ++batch) {
        textures = rasterizeLines(frame, params, photons, layers, layout, textures, batch);
        const Reduced reduced = reduceRows(frame, params, layers, layout, textures, hits, batch);
        textures = reduced.textures;
        hits = reduced.hits;
        photons.ledger = hits.incoming.ledger;
    }
    return hits;
}

}  // namespace

void registerTraceLines(Registry& registry) {
    registry.node<TraceStage>(
        "lines",
        {"Rasterises each photon's ray as a line into a row of a texture and "
         "reduces the row to its first hit.",
         "K06, section 2.1",
         "It finds what the eye's layers hold and nothing else: not what is off the screen, "
         "edge-on, smaller than a pixel or beyond the last layer. It works on the screen alone, "
         "and refuses layers of another view."},
        {.tiles = true}, &traceLines);
}

}  // namespace kaustik
