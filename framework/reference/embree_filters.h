// SPDX-License-Identifier: MIT
// What a ray may not hit: Embree asks these of each triangle that a ray crosses.
#pragma once

#include <cstdint>

#include "framework/reference/embree.h"
#include "framework/reference/embree_scene.h"
#include "framework/reference/media_stack.h"

namespace kaustik::reference {

// Embree hands the context to the filters: what the ray may not hit.
struct FilterContext {
    QueryContext embree;
    TriangleId start;
    const MediaStack* media;
    SideRule sides;
    std::uint32_t leftSide;
    float reachMeters;
    const float* resolvedMeters;  // of rays to lights, by their numbers; else null
};

// Of a ray that hits everything but `start`, by the rule of `sides`.
[[nodiscard]] inline FilterContext makeContext(const TriangleId& start, const MediaStack& media,
                                               SideRule sides) {
    FilterContext context;
    initQueryContext(context.embree);
    context.start = start;
    context.media = &media;
    context.sides = sides;
    context.leftSide = transport::kLeftNone;
    context.reachMeters = 0.0f;
    context.resolvedMeters = nullptr;
    return context;
}

// For specular objects in the scene of all surfaces.
void rejectWrongSide(const RTCFilterFunctionNArguments* arguments);

// For receivers and mirrors between a point and the eye, and all surfaces on rays to lights.
void rejectStart(const RTCFilterFunctionNArguments* arguments);

}  // namespace kaustik::reference
