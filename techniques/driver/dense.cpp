// SPDX-License-Identifier: MIT
// driver.dense: every photon of every light, in batches no larger than emit.batch, from
// interaction to interaction: what arrives is stored at once, and what reaches another specular
// surface is the next list. In: surfaces; out: the map of flux, W, and in-scattered light.
//
// Refined, a batch is followed twice. What its photons do is first asked of alone: where those
// around a square of the grid are not joined (reconstruct.triangles), since a path, an edge or a
// crease lies between them, the square's light has finer photons, and theirs stand for the rest.
#include <fmt/format.h>

#include <cstddef>

#include "framework/pipeline/frame_builder.h"
#include "techniques/light_cells/squares.h"
#include "techniques/photon_lists/photon_paths.h"

namespace kaustik {
namespace {

struct DenseParams {
    int refine = 1;
    float share = 0.1f;
    template <class R>
    void reflect(R& r) {
        const auto whyNotRefined = [](const FrameFacts& facts) -> std::string {
            if (facts.settings.choice(ReconstructStage::name) != "triangles")
                return facts.withChosen<ReconstructStage>();
            if (facts.settings.choice(EmitStage::name) != "grid")
                return facts.withChosen<EmitStage>();
            return "";
        };
        r.field(refine, "refine",
                "Finer photons along each side of a square between four that are not joined, since "
                "a path, an edge or a crease lies between them; an odd number, else one less; "
                "1: none",
                "", params::range(1, 7))
            .when(whyNotRefined);
        r.field(share, "refine_share",
                "Squares are refined where more than this share of their light is not joined", "",
                params::range(0.0f, 1.0f))
            .when(whyNotRefined)
            .when([this](const FrameFacts&) -> std::string {
                return refine > 1 ? "" : "with driver.dense.refine=1";
            });
    }
};

// Parts along a side of a square; 1: nothing is refined.
int partsOf(FrameBuilder& frame, const DenseParams& params) {
    const bool canRefine = !frame.tile() &&
                           frame.chosenNode(ReconstructStage::name).name == "triangles" &&
                           frame.chosenNode(EmitStage::name).name == "grid";
    if (!canRefine) return 1;
    const int parts = params.refine - (1 - params.refine % 2);
    if (parts != params.refine) {
        frame.warn(fmt::format("driver.dense.refine = {} is taken as {}: an odd number.",
                               params.refine, parts));
    }
    return parts;
}

// What has finer photons, round by round, and the batch's own photons for the rest.
void followRefined(FrameBuilder& frame, const Surfaces& surfaces, const Samples& samples, int parts,
                   float share, Caustic& caustic) {
    Samples rest = samples;
    rest.refinement = parts;
    const RefinedSquares refined = findRefined(frame, surfaces, rest, share, caustic.cells);
    rest.refined = refined.flags;
    followPhotons(frame, surfaces, rest, caustic);
    const SquareRoom room = squareRoom(frame, parts, samples.lights);
    Samples finer = rest;
    finer.suffix = ".refined" + samples.suffix;
    finer.borderRows = 0;
    frame.beginLoop();
    const SquareRound round = takeSquares(frame, refined, room, finer.suffix);
    finer.cells = round.squares;
    followPhotons(frame, surfaces, finer, caustic);
    frame.endLoop(round.counts, offsetof(transport::CellCounts, moreCells));
    caustic.cells = round.counts;
}

Caustic driveDense(FrameBuilder& frame, const DenseParams& params, Surfaces surfaces) {
    Caustic caustic;
    const int parts = partsOf(frame, params);
    for (const Samples& samples : batchesOfGrids(frame)) {
        if (parts > 1) {
            followRefined(frame, surfaces, samples, parts, params.share, caustic);
        } else {
            followPhotons(frame, surfaces, samples, caustic);
        }
    }
    if (!frame.tile()) finishMedia(frame, caustic);
    return caustic;
}

}  // namespace

void registerDriverDense(Registry& registry) {
    registry.node<DriverStage>(
        "dense",
        {"Every photon of every light, from interaction to interaction.", "K06, section 2.3",
         "It follows as many photons as the emitter makes, wherever their light goes: no more "
         "where "
         "it converges, and no fewer where the eye sees nothing of it."},
        {.tiles = true}, &driveDense);
}

}  // namespace kaustik
