// SPDX-License-Identifier: MIT
// trace.raytraced: the exact first hit of every photon, by Embree on all cores of the processor:
// what somebody without a graphics card would use, and the tracer that judges any reconstruction
// without an error of its own. In: photons, eye view space, m; out: hits, W that arrive after
// absorption. It sees what no view shows, and reads no layers.
#include "techniques/tracing/processor_rays.h"

namespace kaustik {
namespace {

Hits traceRaytraced(FrameBuilder& frame, const params::NoParams&, Photons photons,
                    Surfaces surfaces) {
    return hitsByProcessor(frame, photons, surfaces.geometry);
}

}  // namespace

void registerTraceRaytraced(Registry& registry) {
    registry.node<TraceStage>(
        "raytraced",
        {"Exact first hits by ray tracing on the processor (Embree).", "",
         "It runs on the processor and reads the list of photons back for it, so that the device "
         "waits. It is there only in builds with Embree."},
        {.reach = TracerReach::everything}, &traceRaytraced);
}

}  // namespace kaustik
