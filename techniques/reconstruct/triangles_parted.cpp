// SPDX-License-Identifier: MIT
// Where reconstruct.triangles would not join the photons that arrive: what a driver that refines
// asks of it before anything is stored.
#include <algorithm>
#include <utility>

#include "techniques/reconstruct/triangles.h"
#include "techniques/reconstruct/triangles_joins.h"

namespace kaustik {
namespace {

using Shares = graph::Buffer<std::uint32_t>;

Shares addPartedIn(FrameBuilder& frame, const Store& store, const Hits& hits,
                   const graph::Buffer<float>& cellFlux, const Shares& before) {
    const TrianglesParams params = trianglesForViews(
        frame.params<TrianglesParams>("reconstruct.triangles"), *store.receivers.views);
    struct Data {
        TriangleJoins joins;
        Shares parted;
    };
    return frame
        .pass<Data>(
            "reconstruct.triangles_parted", "photons that are not joined have finer ones between",
            [&](graph::PassSetup& setup, Data& data) {
                hits.sample(setup);
                hits.incoming.sample(setup);
                setup.sample("cellExtents", hits.incoming.extents);
                setup.define("CELL_EXTENTS");
                data.joins = TriangleJoins::create(setup, store, hits);
                setup.storage("CellFlux", cellFlux);
                data.parted = setup.storage("PartedShares", setup.write(before));
            },
            [params, store, list = hits.incoming](const Data& data, gl::PassContext& context) {
                const auto shader = [&](const char* name) {
                    gl::Command command = context.compute(name);
                    bindStore(command, store).params("reconstruct.triangles", params);
                    setCells(command, list.cells);
                    return command;
                };
                data.joins.find(context, list, shader);
                data.joins.dispatchOverArrivals(shader("reconstruct/triangles_parted.comp"));
            })
        .parted;
}

}  // namespace

graph::Buffer<std::uint32_t> addParted(FrameBuilder& frame, const Surfaces& surfaces,
                                       const Hits& hits, graph::Buffer<float> cellFlux,
                                       graph::Buffer<std::uint32_t> parted) {
    const std::vector<Store> stores = storesOf(frame, surfaces);
    for (const Store& store : stores) {
        // A light's further maps hold the same light again, and every generator's joins the same.
        if (store.cascade > 0 || store.generator > 0) continue;
        parted = addPartedIn(frame, store, hits, cellFlux, parted);
    }
    return parted;
}

}  // namespace kaustik
