// SPDX-License-Identifier: MIT
// Where the light of a probe, or of a photon, arrives in the view that a metric of the stage refine
// looks from (WN09, section 3.2). C++ and GLSL both read this file.
#pragma once

#ifdef __cplusplus
#include <glm/vec4.hpp>
namespace kaustik::light_cells {
using glm::vec4;
using uint = unsigned int;
#endif

// An entry of a buffer (std430).
struct Landing {
    // xy: where it arrives, continuous texels of the view; zw: of a path through a medium, where it
    // begins.
    vec4 ends;
    uint seenBy;     // the view's number + 1; 0: nowhere that it sees
    uint signature;  // of the probe's path: what it has met, and how it left that
    uint unused0;
    uint unused1;
};

#ifdef __cplusplus
}  // namespace kaustik::light_cells
#endif
