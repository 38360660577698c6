// SPDX-License-Identifier: MIT
// What one tracing of a frame was given and what it found: what the photon audit looks at. Eye view
// space, m, W.
#pragma once

#include "framework/pipeline/stages.h"

namespace kaustik {

class FrameBuilder;

struct TraceRecord {
    Hits hits;
    // Right before and after: what the tracer itself has booked lies between.
    Ledger before;
    Ledger after;
    TracerReach reach = TracerReach::eyeLayers;
};

// Adds a pass, not part of any technique, that copies the ledger as it is at this point.
[[nodiscard]] Ledger copyLedger(FrameBuilder& frame, const Ledger& ledger, const std::string& name);

}  // namespace kaustik
