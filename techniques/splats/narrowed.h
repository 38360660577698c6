// SPDX-License-Identifier: MIT
// What was drawn narrower than its photons' beams asked for, as shaders count it
// (transport::Narrowed): said as a reached limit.
#pragma once

#include <bit>
#include <optional>
#include <string>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// Entry `which` of `narrowed`, written by the pass of the node. `parameter`: of the node, with this
// value, px; `sentence`: what follows on the number of those that are narrower. No flux is lost.
inline void reportWidthLimit(FrameBuilder& frame, const std::string& node,
                             const graph::Buffer<transport::Narrowed>& narrowed, std::size_t which,
                             const std::string& parameter, int pixels,
                             const std::string& sentence) {
    frame.reportLimit(
        {node, {narrowed}, [=](const gl::Executor& executor) -> std::optional<ReachedLimit> {
             const transport::Narrowed found =
                 executor.buffer(narrowed).read<transport::Narrowed>()[which];
             if (found.count == 0) return {};
             return ReachedLimit{
                 node + "." + parameter,
                 "px",
                 static_cast<double>(pixels),
                 static_cast<double>(std::bit_cast<float>(found.widestBits)),
                 std::to_string(found.count) + " " + sentence + "; no flux is lost to it",
                 0.0};
         }});
}

}  // namespace kaustik
