// SPDX-License-Identifier: MIT
// What one tracing of a frame was given and what it found: what the photon audit looks at. Eye view
// space, m, W.
#pragma once

#include <memory>

#include "framework/pipeline/stages.h"

namespace kaustik {

class FrameBuilder;
struct TracingLog;

struct TraceRecord {
    Hits hits;
    // Right before and after: what the tracer itself has booked lies between.
    Ledger before;
    Ledger after;
    TracerReach reach = TracerReach::eyeLayers;
    // Of a tracing in a loop, whose last run alone is left in the above; else null.
    std::shared_ptr<const TracingLog> log;
};

// Adds a pass, not part of any technique, that copies the ledger as it is at this point.
[[nodiscard]] Ledger copyLedger(FrameBuilder& frame, const Ledger& ledger, const std::string& name);

}  // namespace kaustik
