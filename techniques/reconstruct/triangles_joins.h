// SPDX-License-Identifier: MIT
// Which photons of a list arrive, from which cells, and which of them are joined with their
// neighbours: what reconstruct.triangles finds first, and a driver that chooses photons by it.
#pragma once

#include <cstdint>
#include <functional>

#include "framework/pipeline/frame_builder.h"
#include "techniques/stores/stores.h"
#include "techniques/thread_lists/thread_list.h"

namespace kaustik {

class TriangleJoins {
  public:
    // Declares a pass' own buffers.
    static TriangleJoins create(graph::PassSetup& setup, const Store& store, const Hits& hits);

    // A command of the pass with all that its shaders need of store, parameters and cells.
    using MakeShader = std::function<gl::Command(const char*)>;
    void find(gl::PassContext& context, const Photons& list, const MakeShader& shader) const;
    // One thread a photon that has arrived (shaders/reconstruct/triangles_arrivals.glsl).
    void dispatchOverArrivals(gl::Command command) const;

  private:
    graph::Buffer<std::uint32_t> photonOfCell_;
    graph::Buffer<std::uint32_t> joins_;
    ThreadList arrivals_;
};

}  // namespace kaustik
