// SPDX-License-Identifier: MIT
// specular.split: reflects and refracts photons where they have hit a specular surface and follows
// both Fresnel branches (K06, section 2.3). The first `levels` interactions double the transfer
// map; from then on each photon follows one of the two branches, drawn by its share of the flux, so
// that nothing is lost and nothing grows. Exact unpolarised Fresnel; eye view space, m and W.
#include <fmt/format.h>

#include "techniques/shared/next_photons.h"
#include "techniques/shared/nodes.h"
#include "techniques/shared/specular.h"

namespace kaustik {
namespace {

// Which photons follow one branch for want of room. Nothing is lost to it, and what is drawn is
// noise.
void keepToLevels(FrameBuilder& frame, const SplitParams& params, const Hits& before) {
    frame.keepsTo(
        {"specular.split",
         {before.flux, before.incoming.list},
         [levels = params.levels,
          before](const gl::Executor& executor) -> std::optional<ReachedLimit> {
             const std::size_t count = countHits(executor, before, transport::kFateSpecular);
             if (count == 0) return {};
             return ReachedLimit{
                 "specular.split.levels",
                 "interactions",
                 static_cast<double>(levels),
                 0.0,
                 fmt::format("{} photons hit another specular surface and followed one branch, "
                             "drawn by its share; no flux is lost to it",
                             count),
                 0.0};
         }});
}

}  // namespace

Photons splitAtInterface(FrameBuilder& frame, const SplitParams& params, Hits hits,
                         Surfaces /*surfaces*/) {
    const int run = hits.incoming.paths.interactions + 1;
    const bool splits = run <= params.levels;
    // Of the first batch alone: what is counted must be kept to the end of the frame.
    if (run == params.levels + 1 && hits.incoming.batch.empty()) keepToLevels(frame, params, hits);
    if (!splits) frame.drawsAtRandom();
    const NextPhotons next = makeRoom(frame, hits, splits ? 2 : 1);
    return frame.pass<Photons>(
        "specular.split",
        splits ? "photons hit specular surfaces and follow both branches"
               : "photons hit specular surfaces again and follow one branch",
        [&](graph::PassSetup& setup, Photons& data) { data = sendOn(setup, hits, next); },
        [&inputs = frame.inputs(), list = hits.incoming, splits](const Photons&,
                                                                 gl::PassContext& context) {
            dispatchOver(context.compute("shared/specular_split.comp")
                             .set("splits", splits ? 1 : 0)
                             .set("seedLow", static_cast<unsigned>(inputs.seed))
                             .set("seedHigh", static_cast<unsigned>(inputs.seed >> 32)),
                         list);
        });
}

void registerSpecularSplit(Registry& registry) {
    registry.node<SpecularStage>(
        "split", {"Refracts and reflects: follows both Fresnel branches.", "K06, section 2.3"},
        &splitAtInterface);
}

}  // namespace kaustik
