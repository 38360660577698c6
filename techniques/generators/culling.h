// SPDX-License-Identifier: MIT
// Which specular objects are no caustic generators (U08, section 4.1), as around.cull says, and
// what becomes of the light that falls on them.
#pragma once

#include <cstddef>
#include <vector>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// `none`: all are generators. `light`: but those that no light can reach directly. `eye`: but
// those, too, whose light cannot come to what the eye sees (light_reach.h).
enum class GeneratorCulling : int { none, light, eye };

// Specular objects that are left out, by their place in the scene.
struct CulledObjects {
    std::vector<std::size_t> unlit;
    std::vector<std::size_t> unseen;  // that light can reach
};
// As around.cull says; made once a frame, which then says in `explain` which they are and why.
// Without any where no node asks for generators.
[[nodiscard]] const CulledObjects& culledObjects(FrameBuilder& frame);

// Hits of which those on objects that are left out as unseen have ended, their flux in the ledger
// as off_screen: the very hits where there are none.
[[nodiscard]] Hits endAtUnseen(FrameBuilder& frame, const Hits& hits);

}  // namespace kaustik
