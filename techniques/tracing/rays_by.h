// SPDX-License-Identifier: MIT
// Who traces exact rays: the device, through the hierarchy of the scene, or the processor (Embree),
// whose rays may part from each other at no cost.
#pragma once

#include <string>

#include "framework/core/error.h"
#include "framework/pipeline/frame_builder.h"

namespace kaustik {

enum class RaysBy : int { automatic, device, processor };

// The parameter "rays" of a node.
template <class R>
void reflectRaysBy(R& r, RaysBy& rays) {
    r.choice(rays, "rays",
             "Who traces the rays: the device, or the processor (Embree); auto: the processor "
             "where the device renders on it",
             {"auto", "device", "processor"});
}

// `parameter`: its full name. ConfigError where the processor is asked for and the program is built
// without Embree.
[[nodiscard]] inline bool isProcessorAsked(const FrameBuilder& frame, RaysBy rays,
                                           const std::string& parameter) {
#ifdef KAUSTIK_HAS_EMBREE
    static_cast<void>(parameter);
    return rays == RaysBy::processor || (rays == RaysBy::automatic && frame.inputs().isOnProcessor);
#else
    static_cast<void>(frame);
    if (rays == RaysBy::processor)
        throw ConfigError(parameter +
                          " = processor: this program is built without Embree; take device.");
    return false;
#endif
}

}  // namespace kaustik
