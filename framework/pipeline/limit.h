// SPDX-License-Identifier: MIT
// A cap that a node keeps to, and what it says of a frame in which that was reached.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "framework/graph/resource.h"

namespace kaustik::gl {
class Executor;
class Texture;
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
    // of a frame that is measured. Invalid where it is known beforehand.
    graph::ResourceRef counted;
    // Asked after such a frame; may wait for the device.
    std::function<std::optional<ReachedLimit>(const gl::Executor&)> reached;
};

// How many texels of a transfer map's hits or photons have that fate, from a row on. `fated` is the
// texture that holds it in its fourth channel: HitFlux or PhotonDirection. Waits for the device.
[[nodiscard]] std::size_t countWithFate(const gl::Texture& fated, std::uint32_t fate,
                                        int firstRow = 0);

}  // namespace kaustik
