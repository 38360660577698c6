// SPDX-License-Identifier: MIT
// trace.auto: exact first hits, by trace.raytraced where the device renders on the processor, since
// Embree takes a third to two thirds of the shaders' time there (results/exact_rays.md), else by
// trace.bvh. Out: the same hits, ties aside, whichever finds them.
#include <string>

#include "framework/pipeline/frame_builder.h"
#include "techniques/tracing/bvh_rays.h"
#ifdef KAUSTIK_HAS_EMBREE
#include "techniques/tracing/processor_rays.h"
#endif

namespace kaustik {
namespace {

// Why shaders are to trace; "" where the processor is.
const char* whyOnDevice(const FrameBuilder& frame) {
#ifdef KAUSTIK_HAS_EMBREE
    return frame.inputs().isOnProcessor ? "" : "the device is not the processor";
#else
    static_cast<void>(frame);
    return "this program is built without Embree";
#endif
}

Hits traceAuto(FrameBuilder& frame, const params::NoParams&, Photons photons, Surfaces surfaces) {
    const std::string reason = whyOnDevice(frame);
    const bool onProcessor = reason.empty();
    if (frame.runsOf(TraceStage::name) == 1) {
        const FrameBuilder::PassScope whoever(frame);
        frame.skip(onProcessor ? "trace.bvh" : "trace.raytraced",
                   onProcessor ? "the device is the processor, on which Embree traces" : reason);
    }
#ifdef KAUSTIK_HAS_EMBREE
    if (onProcessor) return hitsByProcessor(frame, photons, surfaces.geometry);
#endif
    return hitsByBvh(frame, photons, surfaces.geometry);
}

}  // namespace

void registerTraceAuto(Registry& registry) {
    registry.node<TraceStage>(
        "auto",
        {"Exact first hits: by the processor (Embree) where the device renders on it, else on the "
         "device.",
         "",
         "It decides by the kind of device, and by whether the program is built with Embree; no "
         "time is measured."},
        {.reach = TracerReach::everything}, &traceAuto);
}

}  // namespace kaustik
