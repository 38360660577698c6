// SPDX-License-Identifier: MIT
#include "techniques/adaptive_caustic_map/landing.h"

#include "techniques/shared/stores.h"

namespace kaustik {
namespace {

std::vector<Store> landingViews(FrameBuilder& frame, const Surfaces& surfaces, RefineMetric metric,
                                LandingOf whose) {
    if (metric == RefineMetric::map && whose != LandingOf::path) return storesOf(frame, surfaces);
    std::vector<Store> eye(1);
    eye.front().receivers = surfaces.eye;
    return eye;
}

}  // namespace

graph::Buffer<transport::Landing> land(FrameBuilder& frame, const std::string& pass,
                                       graph::Buffer<transport::Landing> landings, const Hits& hits,
                                       const Surfaces& surfaces, RefineMetric metric,
                                       LandingOf whose, int branches) {
    using Landings = graph::Buffer<transport::Landing>;
    const scene::Bounds bounds = sceneBounds(frame.scene());
    const auto farthest =
        bounds.empty ? 1.0f : static_cast<float>(glm::length(bounds.maximum - bounds.minimum));
    const std::vector<Store> views = landingViews(frame, surfaces, metric, whose);
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
            [store, number = static_cast<int>(i), metric, whose, branches, farthest,
             splits = hits.incoming.cells.splits,
             list = hits.incoming](const Landings&, gl::PassContext& context) {
                gl::Command command = context.compute("adaptive_caustic_map/land.comp");
                bindStore(command, store)
                    .set("isFirst", number == 0 ? 1 : 0)
                    // The faces of cubes, and all maps, have numbers of their own.
                    .set("viewNumber", static_cast<int>(transport::kMostViews) * number)
                    .set("isPart", store.cascade > 0 ? 1 : 0)
                    .set("needsSight",
                         metric == RefineMetric::eye && whose != LandingOf::path ? 1 : 0);
                if (whose == LandingOf::path) command.define("PATHS").set("farthest", farthest);
                if (whose == LandingOf::photon) {
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
