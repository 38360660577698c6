// SPDX-License-Identifier: MIT
// Programs as a strict compiler sees them: glslang, spirv-val and spirv-cross, each in a process of
// its own (Debian: glslang-tools, spirv-tools, spirv-cross).
#pragma once

#include <string>
#include <vector>

#include "tests/gpu/strict/recording.h"

namespace kaustik::test {

// What a stage takes of what a driver has only so many of: what its code can reach counts.
struct StageResources {
    std::string kind;  // comp, vert, geom, frag
    int images = 0;
    int storageBlocks = 0;
    int uniformBlocks = 0;
    int samplers = 0;
    int outputs = 0;            // of a fragment shader
    int uniformComponents = 0;  // outside of blocks
    int groupThreads[3] = {0, 0, 0};
    int sharedBytes = 0;
};

struct CheckedProgram {
    std::string problem;  // what the compiler or the validator says; "" where nothing
    std::vector<StageResources> stages;
};

// The tools that are not installed.
[[nodiscard]] std::vector<std::string> missingTools();

// Without those definitions and parameters, right after #version, that it does not name: a pass
// gives all of its programs the same.
[[nodiscard]] RecordedProgram withoutUnused(RecordedProgram program);

// As many at a time as the machine has processors; in the order of `programs`.
[[nodiscard]] std::vector<CheckedProgram> checkPrograms(
    const std::vector<RecordedProgram>& programs);

// What of a program goes beyond the least that drivers give (driver_limits.h), a sentence each.
[[nodiscard]] std::vector<std::string> beyondDriverLimits(
    const std::vector<StageResources>& stages);

}  // namespace kaustik::test
