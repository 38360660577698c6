// SPDX-License-Identifier: MIT
// The document, or a study of it, as an experiment that `kaustik experiment run` does without the
// workbench, with the same bits on the same device.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/gui/document.h"
#include "framework/gui/study.h"

namespace kaustik::gui {

// What an experiment has next to the document.
struct ExperimentTerms {
    int frames = 8;  // timed, after one that is not
    bool isPrecise = false;
    // Photons at least of the reference that its runs are judged by; 0 for runs without errors. It
    // is that of `reference = "auto"`: the one that the cache has, or else the same computed again,
    // with its second one of the paths that each run's technique models.
    std::uint64_t referencePhotons = 0;
};

// Writes NAME.toml into `folder`, and NAME-scene.toml next to it where the scene has been changed
// by hand; gives the files, the experiment first. With a variant B it has two runs. `name`:
// letters, digits, '-' and '_'. Throws ConfigError for another name or settings that make no sense,
// IoError where it cannot be written.
std::vector<std::filesystem::path> writeExperiment(const Document& document,
                                                   const Registry& registry,
                                                   const std::filesystem::path& folder,
                                                   const std::string& name,
                                                   const ExperimentTerms& terms);
// The same with a run for each of variantsOf(study), in their order.
std::vector<std::filesystem::path> writeStudy(const Study& study, const Registry& registry,
                                              const std::filesystem::path& folder,
                                              const std::string& name,
                                              const ExperimentTerms& terms);

}  // namespace kaustik::gui
