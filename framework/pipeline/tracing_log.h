// SPDX-License-Identifier: MIT
// What a tracing was given and found, in the processor's memory. Eye view space, m, W.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "framework/pipeline/ledger.h"
#include "framework/pipeline/renderer.h"

namespace kaustik {

// A photon in flight, and its hit.
struct TracedPhoton {
    glm::vec3 position{0.0f};
    glm::vec3 direction{0.0f};
    glm::vec3 fluxWatts{0.0f};
    std::uint32_t media = 0;
    std::uint32_t light = 0;
    bool isFound = false;
    glm::vec3 found{0.0f};  // not a number where the tracer has found none
};

// The photons of all runs of a tracing in a frame; those of no other batch alone.
struct TracingLog {
    std::vector<TracedPhoton> photons;
    std::size_t beforeLast = 0;    // of these, those of runs before the last
    std::uint64_t notANumber = 0;  // photons whose fate or place is none; not among them
    EnergyLedger booked;           // by the tracer itself
};

[[nodiscard]] bool isFinite(const glm::vec3& v);

// Adds what lies between two ledgers, one of which may be empty.
void addBooked(EnergyLedger& sum, const EnergyLedger& before, const EnergyLedger& after);

// Reads back what the frame has left of a tracing outside of loops, or gives its log.
[[nodiscard]] std::shared_ptr<const TracingLog> readTracing(const Renderer& renderer,
                                                            const TraceRecord& trace);

// Adds a pass as copyLedger's, which gives `record.after`, and which keeps in `record.log` what
// every run of the loop around it has found.
void logTracing(FrameBuilder& frame, TraceRecord& record, const std::string& name);

}  // namespace kaustik
