// SPDX-License-Identifier: MIT
// What is as wide as a bound allows, and not as its photon's beam asks, as shaders count it
// (include/photons/clamped.glsl): said as a reached limit.
#pragma once

#include <bit>
#include <cmath>
#include <optional>
#include <string>

#include "framework/pipeline/ledger.h"
#include "framework/transport/watts.h"

namespace kaustik {

enum class WidthBound { largest, smallest };

// A parameter that bounds a width, and what is counted of those that it changes.
struct WidthLimit {
    std::string node;
    std::string parameter;  // of the node
    WidthBound bound = WidthBound::largest;
    double value = 0.0;
    std::string unit;
    std::string counted;   // ReachedLimit::counted
    bool isAgain = false;  // what it counts carries flux that has been counted elsewhere
};

// Entry `which` of `clamped`, written by the pass of the node. No flux is lost.
inline void reportWidthLimit(FrameBuilder& frame, const WidthLimit& limit,
                             const graph::Buffer<transport::Clamped>& clamped, std::size_t which) {
    const double quantumWatts = static_cast<double>(frame.inputs().ledgerQuantumWatts);
    frame.reportLimit(
        {limit.node, {clamped}, [=](const gl::Executor& executor) -> std::optional<ReachedLimit> {
             const transport::Clamped found =
                 executor.buffer(clamped).read<transport::Clamped>()[which];
             if (found.count == 0) return {};
             const auto factor = static_cast<double>(std::bit_cast<float>(found.factorBits));
             const double units = std::ldexp(static_cast<double>(found.highUnits), 32) +
                                  static_cast<double>(found.lowUnits);
             return ReachedLimit{
                 limit.node + "." + limit.parameter,
                 limit.unit,
                 limit.value,
                 limit.bound == WidthBound::largest ? limit.value * factor : limit.value / factor,
                 "no flux is lost to it",
                 0.0,
                 limit.counted,
                 found.count,
                 limit.isAgain ? 0.0 : units * quantumWatts / transport::kChannels};
         }});
}

}  // namespace kaustik
