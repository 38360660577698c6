// SPDX-License-Identifier: MIT
// reconstruct.triangles: between photons of neighbouring cells lies the light between them. Four
// that took the same path to the same surface are joined, and what two triangles between them cover
// of each pixel is computed exactly, whatever their size; where a cell is folded over, light passes
// as often as it is. What cannot be joined, at a silhouette, an edge or a change of path, is
// covered by the photon's own beam; one that is wide and has no joined neighbour puts its light
// into squares of the eye's pixels (triangles_pixel_blocks.glsl). No blending and no order: sums
// are in fixed point. (Caustic triangles: U08, section 4.2, there on the faces of a cube and by the
// device's rasteriser.) What crosses from one face of a cube to the next is whole. In: hits with
// beams, eye view space, m and W, and what views see; out: flux a pixel, W, and where a receiver is
// glossy radiant intensity towards the eye, W/sr.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "framework/core/error.h"
#include "framework/pipeline/frame_builder.h"
#include "techniques/reconstruct/edge_samples.h"
#include "techniques/reconstruct/pixel_block.h"
#include "techniques/reconstruct/triangles.h"
#include "techniques/reconstruct/triangles_joins.h"
#include "techniques/reconstruct/triangles_pixel_blocks.h"
#include "techniques/splats/clamped.h"
#include "techniques/stores/stores.h"
#include "techniques/thread_lists/thread_list.h"
#ifdef KAUSTIK_HAS_EMBREE
#include "techniques/reconstruct/processor_triangles.h"
#endif

namespace kaustik {
namespace {

bool widensByLights(const FrameFacts& facts) {
    return whyTrianglesAreNotWidened(facts).empty() &&
           facts.settings.get<TrianglesParams>("reconstruct.triangles").lightSize ==
               LightSize::widened;
}

// The lists of shaders/reconstruct/triangles_patch_list.glsl.
enum PatchKind { joined, ofBeams, atCreases };
// Then come those of each kind that are laid more than once, and wide ones of two kinds.
constexpr std::size_t kPatchKinds = 3;
constexpr std::size_t kPatchesOfPhoton = 5;
constexpr std::size_t kWidePatches = 2 * kPatchKinds;
enum WideKind : std::size_t { toPixels, toSquares };
constexpr std::size_t kWideKinds = 2;
constexpr std::size_t kPatchCounts = kWidePatches + kWideKinds;
// What has been listed, for triangles_groups.comp.
enum Listed : int { none, patches, copies, widePatches };
constexpr std::size_t kPatchCountWords =
    kPatchCounts * sizeof(ThreadListHeader) / sizeof(std::uint32_t);
// Patches that are kept: wide ones, of which more are covered by one thread each, or as many of all
// kinds as the processor covers at once.
constexpr std::size_t kMaxWidePatches = 1u << 18u;
struct VertexShares {
    float quarter, area, triangles, cells;
};
struct PatchBlock {
    glm::vec4 flux, low, high;
};
constexpr int kMaxMerges = 4;

// On the faces of a cube nothing wider than this, rad, is one triangle: whichever face sees its
// middle has nearly always all of it before it; what little another sees then is shared among the
// rest.
constexpr float kMaxWidthOnCube = 1.2f;

// Mesa's software rasteriser ends all loops of a thread after 65,535 turns together, of which a
// pixel of a wide patch takes four in one of its eight threads.
constexpr int kMaxWidthOnSoftware = 360;

// Null where the device covers the eye's pixels: what a light's size spreads is laid many times,
// and goes there. The same for all that is put into one map.
std::shared_ptr<ProcessorPixels> processorFor(const FrameBuilder& frame,
                                              const TrianglesParams& params, const Photons& photons,
                                              const FluxMap& before) {
    if (before.flux.valid()) return before.byProcessor;
    const bool isAsked = isProcessorAsked(frame, params.cover, "reconstruct.triangles.cover");
    if (!isAsked || photons.hasLightSpread()) return nullptr;
#ifdef KAUSTIK_HAS_EMBREE
    return std::make_shared<ProcessorPixels>();
#else
    return nullptr;
#endif
}

Stored coverIn(FrameBuilder& frame, const TrianglesParams& wanted, const Geometry& geometry,
               const Hits& hits, const Store& store, const FluxMap& before) {
    TrianglesParams params = trianglesForViews(wanted, *store.receivers.views);
    const FluxSets sets = setsIn(frame, store);
    const bool isGlossy = sets.hasIntensity();
    EdgeSamples edges;
    if (params.coverage == Coverage::samples && store.isEyeView()) {
        // OpenGL grants a shader no more than sixteen textures.
        const bool hasRoom =
            !hits.incoming.hasLightSpread() || !(isGlossy || hits.incoming.extents.valid());
        if (hasRoom) {
            edges = edgeSamplesOf(frame, geometry, store.receivers);
        } else {
            frame.warn(
                "reconstruct.triangles.coverage: where light of a lamp's size falls on glossy "
                "receivers, or photons are refined, pixels show what is at their middles.");
        }
    }
    struct Data {
        Stored stored;
        TriangleJoins joins;
        graph::Buffer<VertexShares> shares;
        graph::Buffer<std::uint32_t> patches;  // counts, and a list
        graph::Buffer<transport::PatchData> wide;
        graph::Buffer<PatchBlock> blocks;  // where any are merged
        graph::Buffer<transport::Clamped> clamped;
    };
    const auto capacity = static_cast<std::size_t>(hits.incoming.capacity());
    // A light's map is read between its texels, and how light goes to the eye is each pixel's own.
    const bool hasBlocks = store.isEyeView() && !isGlossy;
    const std::shared_ptr<ProcessorPixels> processor =
        hasBlocks ? processorFor(frame, params, hits.incoming, before) : nullptr;
    if (!processor && frame.inputs().isOnProcessor)
        params.maximum = std::min(params.maximum, kMaxWidthOnSoftware);
    // The processor tells the kinds of wide ones apart by itself.
    const std::size_t wideKinds = hasBlocks && !processor ? kWideKinds : 1;
    const std::size_t wideCapacity = std::min(4 * capacity, kMaxWidePatches) / wideKinds;
    const std::string reason =
        std::string(hits.incoming.cells.width > 0
                        ? "what neighbours bring is spread between them"
                        : "no photon has neighbours: each is covered by its own beam") +
        (processor ? "; the processor finds over which pixels" : "");
    const Data& covered = frame.pass<Data>(
        "reconstruct.triangles",
        isGlossy ? reason + ", and, since some receivers are glossy, how it goes to the eye"
                 : reason,
        [&](graph::PassSetup& setup, Data& data) {
            data.stored = depositIn(setup, store, hits, before, sets);
            data.stored.map.byProcessor = processor;
            if (hits.incoming.extents.valid()) {
                setup.sample("cellExtents", hits.incoming.extents);
                setup.define("CELL_EXTENTS");
            }
            if (edges.valid()) {
                setup.sample("edgeReceiver", edges.receiver);
                setup.sample("edgeSamples", edges.samples);
                setup.define("EDGE_SAMPLES");
            }
            const auto create = [&]<class T>(graph::Buffer<T>& buffer, const char* block,
                                             const char* name, std::size_t count) {
                buffer = setup.storage(
                    block, setup.createBuffer<T>("triangles." + std::string(name) + store.suffix +
                                                     hits.incoming.suffix,
                                                 count));
                setup.bypass(buffer, {0, 0, 0, 0});
            };
            data.joins = TriangleJoins::create(setup, store, hits);
            create(data.shares, "PhotonShares", "shares", capacity);
            create(data.patches, "Patches", "patches",
                   kPatchCountWords +
                       (hits.incoming.hasLightSpread() ? 2 : 1) * kPatchesOfPhoton * capacity);
            create(data.wide, "WidePatches", "wide", wideKinds * wideCapacity);
            if (params.merge > 0.0f) {
                setup.define("MERGES");
                create(data.blocks, "PatchBlocks", "blocks", capacity);
            }
            if (hasBlocks) {
                setup.define("PIXEL_BLOCKS");
                data.stored.map.pixelBlocks = putIntoPixelBlocks(setup, store, before);
            }
            create(data.clamped, "ClampedWidths", "clamped", 1);
        },
        [params, sets, store, wideCapacity, hasBlocks, edges, list = hits.incoming,
         &inputs = frame.inputs()](const Data& data, gl::PassContext& context) {
            clearIfFirst(context, data.stored);
            if (!context.isRepeated()) context.buffer(data.clamped).clear();
            const auto shader = [&](const char* name) {
                gl::Command command = context.compute(name);
                bindStore(command, store).params("reconstruct.triangles", params);
                return command;
            };
            const auto shaderOfPhotons = [&](const char* name) {
                gl::Command command = shader(name);
                setCells(command, list.cells);
                return command;
            };
            const auto countGroups = [&](Listed listed) {
                context.compute("reconstruct/triangles_groups.comp")
                    .set("listed", static_cast<int>(listed))
                    .set("wideCapacity", static_cast<int>(wideCapacity))
                    .dispatch(1);
            };
            if (hasBlocks && data.stored.isFirst && !context.isRepeated())
                makePixelBlocks(shader("reconstruct/triangles_pixel_blocks.comp"), store);
            countGroups(Listed::none);
            data.joins.find(context, list, shaderOfPhotons);
            const int listCapacity = list.capacity();
            gl::Command lists = shaderOfPhotons("reconstruct/triangles_list.comp");
            lists.set("listCapacity", listCapacity);
            data.joins.dispatchOverArrivals(std::move(lists));
            for (int step = 0; params.merge > 0.0f && step <= kMaxMerges + 1; ++step) {
                gl::Command command = shaderOfPhotons("reconstruct/triangles_merge.comp");
                command.set("mergeStep", step);
                data.joins.dispatchOverArrivals(std::move(command));
            }
            const auto dispatchOverPatches = [&](gl::Command command, std::size_t number) {
                setDeposit(command, sets);
                command.dispatchIndirect(data.patches, number * sizeof(ThreadListHeader) +
                                                           offsetof(ThreadListHeader, groupsX));
            };
            const auto coverPatches = [&](bool areCopies) {
                for (const PatchKind kind : {joined, ofBeams, atCreases}) {
                    gl::Command command = shaderOfPhotons("reconstruct/triangles.comp");
                    if (kind == joined) command.define("JOINED_PATCHES");
                    if (kind == atCreases) command.define("CREASE_PATCHES");
                    if (areCopies) command.define("COPIES");
                    command.set("wideCapacity", static_cast<int>(wideCapacity))
                        .set("listCapacity", listCapacity);
                    dispatchOverPatches(std::move(command), static_cast<std::size_t>(kind) +
                                                                (areCopies ? kPatchKinds : 0));
                }
            };
            countGroups(Listed::patches);
#ifdef KAUSTIK_HAS_EMBREE
            if (ProcessorPixels* const pixels = data.stored.map.byProcessor.get()) {
                if (data.stored.isFirst && !context.isRepeated() && !context.isListing()) {
                    clearPixels(*pixels, inputs.view, store, edges, data.stored.map.pixelBlocks,
                                context);
                }
                const auto make = [&](std::size_t kind, int firstPlace) {
                    gl::Command command = shaderOfPhotons("reconstruct/triangles_made.comp");
                    if (kind == joined) command.define("JOINED_PATCHES");
                    if (kind == atCreases) command.define("CREASE_PATCHES");
                    command.set("placeCount", static_cast<int>(wideCapacity))
                        .set("firstPlace", firstPlace)
                        .set("listCapacity", listCapacity);
                    dispatchOverPatches(std::move(command), kind);
                };
                const std::size_t most = kPatchesOfPhoton * static_cast<std::size_t>(listCapacity);
                coverOnProcessor(*pixels,
                                 {data.patches, kPatchKinds, data.wide, wideCapacity, most, make},
                                 params.shading, inputs, data.stored.ledger, context);
                return;
            }
#else
            static_cast<void>(edges), static_cast<void>(inputs);
#endif
            coverPatches(false);
            if (list.hasLightSpread()) {
                countGroups(Listed::copies);
                coverPatches(true);
            }
            countGroups(Listed::widePatches);
            for (const WideKind kind : {toPixels, toSquares}) {
                if (kind == toSquares && !hasBlocks) continue;
                gl::Command command = shader("reconstruct/triangles_wide.comp");
                if (kind == toSquares) command.define("WALKS_BLOCKS");
                command.set("wideCapacity", static_cast<int>(wideCapacity));
                dispatchOverPatches(std::move(command), kWidePatches + kind);
            }
        });
    reportWidthLimit(frame,
                     {"reconstruct.triangles", "maximum", WidthBound::largest,
                      static_cast<double>(params.maximum), "px",
                      "beams are narrower than they were to be", store.cascade > 0},
                     covered.clamped, 0);
    return covered.stored;
}

CausticMap coverTriangles(FrameBuilder& frame, const TrianglesParams& params, Hits hits,
                          Surfaces surfaces, CausticMap before) {
    needsBeams(frame, "reconstruct.triangles", hits.incoming);
    return storeEverywhere(frame, surfaces, hits, before,
                           [&](const Store& store, const Hits& own, const FluxMap& former) {
                               return coverIn(frame, params, surfaces.geometry, own, store, former);
                           });
}

}  // namespace

TrianglesParams trianglesForViews(TrianglesParams params, const render::RasterViews& views) {
    if (views.count() == 1) return params;
    const float maximum = kMaxWidthOnCube * 0.5f * static_cast<float>(views.width());
    params.maximum = std::clamp(static_cast<int>(maximum), 1, params.maximum);
    return params;
}

void registerReconstructTriangles(Registry& registry) {
    registry.node<ReconstructStage>(
        "triangles",
        {"Joins neighbouring photons of one path and spreads their flux over what the "
         "triangles between them cover of each pixel; what cannot be joined is covered "
         "by its own beam.",
         "U08, section 4.2, on the screen",
         "It joins photons of neighbouring cells: an emitter without neighbours leaves each photon "
         "its own beam. Cells wider than reconstruct.triangles.maximum are not joined, and what "
         "lies between four photons is taken to change evenly. What a light's size spreads over "
         "a crease is brought to the surface beyond it on the screen alone, not in maps. Where a "
         "pixel shows several surfaces all of them reflect as the one at its middle."},
        {.beams = true,
         .widensByLights = &widensByLights,
         .joinsCells = true,
         .close = &shareOutPixelBlocks},
        &coverTriangles);
}

}  // namespace kaustik
