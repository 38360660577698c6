// SPDX-License-Identifier: MIT
// specular.split: reflects and refracts photons where they have hit a specular surface and follows
// both Fresnel branches (K06, section 2.3). The first `levels` interactions double the transfer
// map; from then on each photon follows one of the two branches, drawn by its share of the flux, so
// that nothing is lost and nothing grows. Exact unpolarised Fresnel; eye view space, m and W.
#include <fmt/format.h>

#include "techniques/photon_lists/next_photons.h"
#include "techniques/specular/split.h"

namespace kaustik {
namespace {

// Which photons follow one branch for want of room. Nothing is lost to it, and what is drawn is
// noise.
void reportLevelLimit(FrameBuilder& frame, const SplitParams& params, const Hits& before) {
    frame.reportLimit(
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

std::string whyBothBranches(const scene::SceneNeeds& needs) {
    if (needs.reflectedLight) {
        return fmt::format("{:.0f}% of the light on '{}' is reflected, and '{}' lies in its path",
                           100.0 * needs.reflectedLight->share, needs.reflectedLight->sheet,
                           needs.reflectedLight->receiver);
    }
    if (needs.concaveBody) {
        return fmt::format(
            "'{}' is not convex, and each of its faces that light within comes to "
            "reflects a share",
            *needs.concaveBody);
    }
    return "";
}

Photons splitAtInterface(FrameBuilder& frame, const SplitParams& params, Hits hits,
                         Surfaces /*surfaces*/) {
    const int run = hits.incoming.paths.interactions + 1;
    const bool splits = run <= params.levels;
    // Of the first batch alone: what is counted must be kept to the end of the frame.
    if (run == params.levels + 1 && hits.incoming.batch.empty())
        reportLevelLimit(frame, params, hits);
    if (!splits) frame.usesRandomness();
    const NextPhotons next = allocateNext(frame, hits, splits ? 2 : 1);
    return frame.pass<Photons>(
        "specular.split",
        splits ? "photons hit specular surfaces and follow both branches"
               : "photons hit specular surfaces again and follow one branch",
        [&](graph::PassSetup& setup, Photons& data) { data = bindNextPhotons(setup, hits, next); },
        [&inputs = frame.inputs(), list = hits.incoming, splits](const Photons&,
                                                                 gl::PassContext& context) {
            dispatchOver(context.compute("specular/split.comp")
                             .set("splits", splits ? 1 : 0)
                             .set("seedLow", static_cast<unsigned>(inputs.seed))
                             .set("seedHigh", static_cast<unsigned>(inputs.seed >> 32)),
                         list);
        });
}

void registerSpecularSplit(Registry& registry) {
    registry.node<SpecularStage>(
        "split",
        {"Refracts and reflects: follows both Fresnel branches.", "K06, section 2.3",
         "Both branches are followed for the first specular.split.levels interactions. From then "
         "on each photon follows one of them, drawn by its share of the flux: nothing is lost, but "
         "there is noise."},
        &splitAtInterface);
}

}  // namespace kaustik
