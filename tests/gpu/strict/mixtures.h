// SPDX-License-Identifier: MIT
// Frames in which every two nodes of different stages meet, to learn which programs there are.
#pragma once

#include <cstddef>

namespace kaustik::test {

struct MixtureCount {
    std::size_t frames = 0;   // that were made
    std::size_t refused = 0;  // that cannot be
    std::size_t pairs = 0;    // of nodes that met
    std::size_t apart = 0;    // of nodes that no frame has together
};

// Makes each frame once; what is drawn and dispatched is the caller's matter (recording.h).
MixtureCount renderMixtures();

}  // namespace kaustik::test
