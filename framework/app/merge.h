// SPDX-License-Identifier: MIT
// Files of settings (--merge): what they say counts where the command line does not say it itself.
#pragma once

#include <set>
#include <string>

#include "framework/app/options.h"
#include "framework/pipeline/registry.h"

namespace kaustik::app {

// Reads the files of options.scene.merged in their order, later ones count more, and takes over
// from them what is not among `given`, the names of the options and arguments on the command line
// ("time-step", "scene"). Parameters are left in options.scene.parameters. Throws ConfigError
// "file:line: …" for whatever makes no sense and IoError for a file that cannot be read.
void mergeSettings(RunOptions& options, const std::set<std::string>& given,
                   const Registry& registry);
// Does the same for `explain`. Keys that only `run` has are checked and have no effect.
void mergeSettings(ExplainOptions& options, const std::set<std::string>& given,
                   const Registry& registry);

}  // namespace kaustik::app
