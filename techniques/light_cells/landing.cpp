// SPDX-License-Identifier: MIT
#include "techniques/light_cells/landing.h"

#include "techniques/stores/stores.h"

namespace kaustik {
namespace {

std::vector<Store> landingViews(FrameBuilder& frame, const Surfaces& surfaces, RefineMetric metric,
                                LandingSource source) {
    if (metric == RefineMetric::map && source != LandingSource::path)
        return storesOf(frame, surfaces);
    std::vector<Store> eye(1);
    eye.front().receivers = surfaces.eye;
    return eye;
}

}  // namespace

ProbeNumbers followProbes(FrameBuilder& frame, const std::string& pass, const ProbeNumbers& before,
                          const Hits& hits) {
    return frame.pass<ProbeNumbers>(
        pass, "photons are traced back to the probes that they come from",
        [&](graph::PassSetup& setup, ProbeNumbers& data) {
            hits.incoming.sample(setup);
            if (before.valid()) {
                setup.storage("ProbesBefore", before);
                setup.define("PROBES_BEFORE");
            }
            data = setup.storage("ProbeNumbers",
                                 setup.createBuffer<std::uint32_t>(
                                     "adaptive.probe_numbers" + hits.incoming.suffix,
                                     static_cast<std::size_t>(hits.incoming.capacity())));
        },
        [list = hits.incoming](const ProbeNumbers&, gl::PassContext& context) {
            dispatchOver(context.compute("light_cells/probe_numbers.comp"), list);
        });
}

graph::Buffer<light_cells::Landing> findLandings(FrameBuilder& frame, const std::string& pass,
                                                 graph::Buffer<light_cells::Landing> landings,
                                                 const Hits& hits, const Surfaces& surfaces,
                                                 RefineMetric metric, LandingSource source,
                                                 const ProbeNumbers& probes, int branches) {
    using Landings = graph::Buffer<light_cells::Landing>;
    const scene::Bounds bounds = sceneBounds(frame.scene());
    const auto farthest =
        bounds.empty ? 1.0f : static_cast<float>(glm::length(bounds.maximum - bounds.minimum));
    const std::vector<Store> views = landingViews(frame, surfaces, metric, source);
    for (std::size_t i = 0; i < views.size(); ++i) {
        const Store& store = views[i];
        const Landings before = landings;
        landings = frame.pass<Landings>(
            pass, "where light arrives decides on how many photons it takes",
            [&](graph::PassSetup& setup, Landings& data) {
                hits.sample(setup);
                hits.incoming.sample(setup);
                setup.sample("receiver", store.receivers.receiver);
                setup.sample("receiverSurface", store.receivers.receiverSurface);
                if (probes.valid()) setup.storage("ProbeNumbers", probes);
                data = setup.storage("Landings", setup.write(before));
            },
            [store, number = static_cast<int>(i), metric, source, branches, farthest,
             list = hits.incoming](const Landings&, gl::PassContext& context) {
                gl::Command command = context.compute("light_cells/landing.comp");
                bindStore(command, store)
                    .set("isFirst", number == 0 ? 1 : 0)
                    // The faces of cubes, and all maps, have numbers of their own.
                    .set("viewNumber", static_cast<int>(transport::kMaxViews) * number)
                    .set("isPart", store.cascade > 0 ? 1 : 0)
                    .set("needsSight",
                         metric == RefineMetric::eye && source != LandingSource::path ? 1 : 0);
                if (source == LandingSource::path)
                    command.define("PATHS").set("farthest", farthest);
                if (source == LandingSource::photon) {
                    command.define("BY_PHOTON");
                } else {
                    command.set("branches", branches);
                }
                dispatchOver(command, list);
            });
    }
    return landings;
}

}  // namespace kaustik
