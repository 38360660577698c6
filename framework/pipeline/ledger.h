// SPDX-License-Identifier: MIT
// The energy ledger of a frame (framework/README.md, "The energy ledger"): every account summed on
// its own, none as a remainder.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

struct EnergyLedger {
    // Watts as transport/watts.h counts them, and how many additions made them; by kAccount….
    std::array<double, transport::kAccountCount> watts{};
    std::array<std::uint64_t, transport::kAccountCount> events{};
    std::uint64_t traced = 0;  // photons, one for each interaction that it is traced after

    // (emitted - all the other accounts) / emitted; 0 where nothing was emitted.
    [[nodiscard]] double balance() const;
    [[nodiscard]] double lostWatts() const;
    // What should have been emitted, by a reference or as measured: the emission is judged by it,
    // and what it has missed becomes a loss, or, where it caught too much, a negative one.
    void judgeEmission(double emittedWatts);
};

// The causes of loss with the names that the report gives them.
[[nodiscard]] const std::vector<std::pair<unsigned, std::string>>& lossCauses();

// Watts of one channel that one unit of the ledger stands for: a power of two so small that the
// flux of all lights fits into 2^60 units: of 65536² photons each has 2^28.
[[nodiscard]] float ledgerQuantum(const scene::Scene& scene);

// Adds the pass that counts what of the last hits of a batch of photons was still on its way.
[[nodiscard]] Ledger closeBatch(FrameBuilder& frame, const Hits& hits, const Ledger& ledger);

// Adds the pass that sums what was deposited; gives the final ledger.
[[nodiscard]] Ledger closeLedger(FrameBuilder& frame, const FrameOutputs& outputs);

// Adds passes that sum what the lights send onto what they see of specular surfaces first
// (kAccountEmittable), in views of a size of their own: however photons are emitted. Where the
// frame has no caustic there are none.
[[nodiscard]] Ledger addEmittable(FrameBuilder& frame, const FrameOutputs& outputs, Ledger ledger);

// Waits for the device.
[[nodiscard]] EnergyLedger readLedger(const gl::Buffer& buffer, float quantumWatts);

}  // namespace kaustik
