// SPDX-License-Identifier: MIT
// specular.split: reflects and refracts photons where they have met a specular surface and follows
// both Fresnel branches (K06, section 2.3). The first `levels` interactions double the transfer
// map; from then on each photon goes one of the two ways, drawn by its share of the flux, so that
// nothing is lost and nothing grows. Exact unpolarised Fresnel; eye view space, m and W.
#include <fmt/format.h>

#include "framework/pipeline/frame_builder.h"
#include "techniques/shared/nodes.h"

namespace kaustik {
namespace {

// Which photons go one way for want of room. Nothing is lost to it, and what is drawn is noise.
void keepToLevels(FrameBuilder& frame, const SplitParams& params, const Hits& before) {
    frame.keepsTo({"specular.split", before.flux,
                   [levels = params.levels, handle = before.flux](
                       const gl::Executor& executor) -> std::optional<ReachedLimit> {
                       const std::size_t met =
                           countWithFate(executor.texture(handle), transport::kFateSpecular);
                       if (met == 0) return {};
                       return ReachedLimit{
                           "specular.split.levels",
                           "interactions",
                           static_cast<double>(levels),
                           0.0,
                           fmt::format("{} photons met another specular surface and went one way, "
                                       "drawn by its share; no flux is lost to it",
                                       met),
                           0.0};
                   }});
}

}  // namespace

Hits splitAtInterface(FrameBuilder& frame, const SplitParams& params, Hits hits) {
    struct Data {
        Hits before;
        Hits after;
    };
    const int run = frame.runsOf(SpecularStage::name);
    const bool splits = run <= params.levels;
    if (run == params.levels + 1) keepToLevels(frame, params, hits);
    if (!splits) frame.drawsAtRandom();
    return frame
        .pass<Data>(
            "specular.split",
            splits ? "photons meet specular surfaces and go both ways"
                   : "photons meet specular surfaces again and go one way",
            [&](graph::PassSetup& setup, Data& data) {
                data.before = hits;
                const Photons& from = hits.incoming;
                setup.read(hits.position);
                setup.read(hits.surface);
                setup.read(hits.flux);
                setup.read(from.position);
                setup.read(from.direction);
                setup.read(from.flux);
                Hits& after = data.after;
                after.incoming = from;
                Photons& to = after.incoming;
                if (splits) to.height *= 2;
                const auto name = [&](const char* what) { return fmt::format("{}_{}", what, run); };
                to.position =
                    setup.create<PhotonPosition>(name("photons.position"), to.width, to.height);
                to.direction =
                    setup.create<PhotonDirection>(name("photons.direction"), to.width, to.height);
                to.flux = setup.create<PhotonFlux>(name("photons.flux"), to.width, to.height);
                after.position =
                    setup.create<HitPosition>(name("hits.position"), to.width, to.height);
                after.surface = setup.create<HitSurface>(name("hits.surface"), to.width, to.height);
                after.flux = setup.create<HitFlux>(name("hits.flux"), to.width, to.height);
                to.ledger = setup.write(from.ledger);
                ++to.paths.interactions;
            },
            [&inputs = frame.inputs(), run, splits](const Data& data, gl::PassContext& context) {
                const Photons& from = data.before.incoming;
                const Photons& to = data.after.incoming;
                gl::Command command = context.compute("shared/specular_split.comp");
                inputs.bindLedger(command, to.ledger)
                    .storage("Materials", inputs.gpuScene.materials())
                    .texture("photonPosition", from.position)
                    .texture("photonDirection", from.direction)
                    .texture("photonFlux", from.flux)
                    .texture("hitPosition", data.before.position)
                    .texture("hitSurface", data.before.surface)
                    .texture("hitFlux", data.before.flux)
                    .image("nextPosition", to.position)
                    .image("nextDirection", to.direction)
                    .image("nextFlux", to.flux)
                    .image("keptPosition", data.after.position)
                    .image("keptSurface", data.after.surface)
                    .image("keptFlux", data.after.flux)
                    .set("isFirst", run == 1 ? 1 : 0)
                    .set("splits", splits ? 1 : 0)
                    .set("drawing", static_cast<unsigned>(run))
                    .set("seedLow", static_cast<unsigned>(inputs.seed))
                    .set("seedHigh", static_cast<unsigned>(inputs.seed >> 32))
                    .dispatchOver(from.width, 8, from.height, 8);
            })
        .after;
}

}  // namespace kaustik
