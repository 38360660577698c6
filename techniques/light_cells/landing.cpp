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

graph::Buffer<transport::Landing> findLandings(FrameBuilder& frame, const std::string& pass,
                                               graph::Buffer<transport::Landing> landings,
                                               const Hits& hits, const Surfaces& surfaces,
                                               RefineMetric metric, LandingSource source,
                                               int branches) {
    using Landings = graph::Buffer<transport::Landing>;
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
                data = setup.storage("Landings", setup.write(before));
            },
            [store, number = static_cast<int>(i), metric, source, branches, farthest,
             splits = hits.incoming.cells.splits,
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
                    command.set("splits", splits).set("branches", branches);
                }
                dispatchOver(command, list);
            });
    }
    return landings;
}

}  // namespace kaustik
