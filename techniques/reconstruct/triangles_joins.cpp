// SPDX-License-Identifier: MIT
#include "techniques/reconstruct/triangles_joins.h"

#include <algorithm>
#include <string>
#include <utility>

namespace kaustik {

TriangleJoins TriangleJoins::create(graph::PassSetup& setup, const Store& store, const Hits& hits) {
    const auto capacity = static_cast<std::size_t>(hits.incoming.capacity());
    const auto nameOf = [&](const char* what) {
        return "triangles." + std::string(what) + store.suffix + hits.incoming.suffix;
    };
    const auto create = [&](const char* block, const char* name, std::size_t count) {
        const auto buffer =
            setup.storage(block, setup.createBuffer<std::uint32_t>(nameOf(name), count));
        setup.bypass(buffer, {0, 0, 0, 0});
        return buffer;
    };
    TriangleJoins made;
    made.photonOfCell_ = create("CellPhotons", "photon_of_cell",
                                std::max<std::size_t>(hits.incoming.cells.places(), 1));
    made.joins_ = create("CellJoins", "joins", capacity);
    made.arrivals_ = ThreadList::create(setup, "Arrivals", nameOf("arrivals"), capacity);
    return made;
}

void TriangleJoins::find(gl::PassContext& context, const Photons& list,
                         const MakeShader& shader) const {
    context.buffer(photonOfCell_).clear();
    arrivals_.clear(context);
    dispatchOver(shader("reconstruct/triangles_cells.comp"), list);
    arrivals_.close(context);
    dispatchOverArrivals(shader("reconstruct/triangles_join.comp"));
}

void TriangleJoins::dispatchOverArrivals(gl::Command command) const {
    arrivals_.dispatchOver(std::move(command));
}

}  // namespace kaustik
