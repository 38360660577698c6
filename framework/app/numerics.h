// SPDX-License-Identifier: MIT
// What `kaustik experiment run` does with a study that names a suite.
#pragma once

#include "framework/app/commands.h"
#include "framework/experiment/spec.h"
#include "framework/pipeline/registry.h"

namespace kaustik::app {

// Measures the hard cases that the study names, of the common ones and those that `addHardCases`
// adds (where it is not null); prints their table and writes it as numerics.csv, .json and .md.
// Throws ConfigError for what the study asks wrongly, and Error (exit code 1) when a row fails or
// the user interrupts; nothing is written in the latter case.
void runSuite(const ExperimentOptions& options, const experiment::Spec& spec,
              const Registry& registry, AddHardCases addHardCases);

}  // namespace kaustik::app
