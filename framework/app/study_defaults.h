// SPDX-License-Identifier: MIT
// What the runs of studies have in common with `kaustik run`.
#pragma once

#include "framework/app/options.h"
#include "framework/experiment/plan.h"

namespace kaustik::app {

// This very program, even when it is built anew while its runs go on.
inline constexpr const char* kThisProgram = "/proc/self/exe";

[[nodiscard]] inline experiment::RunDefaults studyDefaults() {
    const RunOptions options;
    return {options.scene.scene, options.scene.technique, options.scene.size,
            options.frames,      options.warmup,          options.seed,
            options.reference,   options.referencePhotons};
}

}  // namespace kaustik::app
