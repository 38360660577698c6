// SPDX-License-Identifier: MIT
// A cap that a node keeps to, and what it says of a frame in which that was reached; and what else
// a node finds out of a frame that is measured.
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

struct EnergyLedger;

struct ReachedLimit {
    std::string parameter;  // "layers.count"
    std::string unit;       // of the next two: "layers"
    double value = 0.0;
    double needed = 0.0;   // what would have been enough; 0: not known
    std::string sentence;  // what was lost
    double lostWatts = 0.0;
    // Where such things are counted, in all batches and rounds of loops: what, how many, and what
    // flux they carry, W; 0 where that says nothing. "splats are smaller than they were to be".
    std::string counted = {};
    std::uint64_t count = 0;
    double countedWatts = 0.0;
};
// One limit of two that several passes have kept to: the sum of what they count, and of the rest
// what went farther. Both have the same `parameter`.
[[nodiscard]] ReachedLimit bothLimits(const ReachedLimit& one, const ReachedLimit& other);

struct NodeLimit {
    std::string pass;  // that keeps to the cap: where it did not run nothing was lost
    // What tells whether the cap was reached, something that the node makes anyway: kept to the end
    // of a frame that is measured. Empty where it is known beforehand.
    std::vector<graph::ResourceRef> counted;
    // Asked after such a frame; may wait for the device.
    std::function<std::optional<ReachedLimit>(const gl::Executor&)> reached;
    // Instead, where shaders count it in an account of the ledger.
    std::function<std::optional<ReachedLimit>(const EnergyLedger&)> inLedger = {};
};

// Something that is wrong with what a node is given or makes, which only a frame that has been
// rendered tells.
struct NodeWarning {
    std::string pass;                         // that finds it out; where it did not run nothing is
    std::vector<graph::ResourceRef> counted;  // as NodeLimit has them
    // One sentence that names the node and how much it is; none where all is well.
    std::function<std::optional<std::string>(const gl::Executor&)> found;
};

}  // namespace kaustik
