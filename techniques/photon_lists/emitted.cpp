// SPDX-License-Identifier: MIT
#include "techniques/photon_lists/emitted.h"

#include <algorithm>
#include <vector>
#include "framework/transport/primitives.h"

namespace kaustik {

CellGrid cellsOf(const Samples& samples, const params::Extent& grid) {
    CellGrid cells;
    cells.width = grid.width;
    cells.firstOwn = samples.firstRow;
    cells.endOwn = std::min(samples.firstRow + samples.rows, grid.height);
    cells.firstRow = std::max(cells.firstOwn - samples.borderRows, 0);
    cells.rows = std::min(cells.endOwn + samples.borderRows, grid.height) - cells.firstRow;
    cells.firstLight = samples.firstLight;
    cells.lights = samples.lights;
    return cells;
}

Hits storeEmitted(graph::PassSetup& setup, Photons photons, const Samples& samples) {
    photons.batch = samples.suffix;
    photons.ledger = setup.storage(
        "LedgerEntries", samples.ledger.valid() ? setup.write(samples.ledger)
                                                : setup.createBuffer<transport::LedgerEntry>(
                                                      "ledger", transport::kLedgerEntryCount));
    photons.store(setup);
    Hits hits = Hits::create(setup, photons);
    hits.store(setup);
    return hits;
}

void beginEmission(gl::PassContext& context, const Photons& photons, const Samples& samples) {
    if (!samples.ledger.valid()) context.buffer(photons.ledger).clear();
    if (!samples.cells.valid()) fillList(context, photons);
}

namespace {

std::vector<graph::ResourceRef> texturesOf(const Hits& hits) {
    std::vector<graph::ResourceRef> all = hits.incoming.textures();
    const std::vector<graph::ResourceRef> ofHits = hits.textures();
    all.insert(all.end(), ofHits.begin(), ofHits.end());
    if (hits.incoming.extents.valid()) all.push_back(hits.incoming.extents);
    return all;
}

}  // namespace

bool isAnyKept(const gl::PassContext& context, const Hits& hits) {
    const std::vector<graph::ResourceRef> all = texturesOf(hits);
    return std::any_of(all.begin(), all.end(),
                       [&](const graph::ResourceRef& texture) { return context.isKept(texture); });
}

void clearEmitted(gl::PassContext& context, const Hits& hits) {
    for (const graph::ResourceRef& texture : texturesOf(hits))
        context.texture(texture).clear({0, 0, 0, 0});
}

}  // namespace kaustik
