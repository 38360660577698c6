// SPDX-License-Identifier: MIT
// What one tracing of a frame was given and what it found, copied before the next one overwrites
// it: what the photon audit looks at. Eye view space, m, W.
#pragma once

#include "framework/transport/stages.h"

namespace kaustik {

class FrameBuilder;

struct TraceRecord {
    // Of `hits.incoming` those in flight were traced; their texels of `hits` are of this tracing,
    // all others of an earlier one. The ledger is as it stood right after.
    Hits hits;
};

// Adds a pass, not part of any technique, that copies the newest versions of all handles.
[[nodiscard]] TraceRecord recordTrace(FrameBuilder& frame, const Hits& hits);

}  // namespace kaustik
