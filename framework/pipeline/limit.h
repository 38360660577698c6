// SPDX-License-Identifier: MIT
// A cap that a node keeps to, and what it says of a frame in which that was reached.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include <vector>

#include "framework/pipeline/stages.h"

namespace kaustik::gl {
class Executor;
}  // namespace kaustik::gl

namespace kaustik {

struct ReachedLimit {
    std::string parameter;  // "layers.count"
    std::string unit;       // of the next two: "layers"
    double value = 0.0;
    double needed = 0.0;   // what would have been enough; 0: nobody knows
    std::string sentence;  // what was lost
    double lostWatts = 0.0;
};

struct NodeLimit {
    std::string pass;  // that keeps to the cap: where it did not run nothing was lost
    // What tells whether the cap was reached, something that the node makes anyway: kept to the end
    // of a frame that is measured. Empty where it is known beforehand.
    std::vector<graph::ResourceRef> counted;
    // Asked after such a frame; may wait for the device.
    std::function<std::optional<ReachedLimit>(const gl::Executor&)> reached;
};

// How many hits of a list have that fate, from a share of it on: hits.flux and the list must have
// been kept. Waits for the device.
[[nodiscard]] std::size_t countHits(const gl::Executor& executor, const Hits& hits,
                                    std::uint32_t fate, double fromShare = 0.0);

}  // namespace kaustik
