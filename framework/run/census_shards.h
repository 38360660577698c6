// SPDX-License-Identifier: MIT
// A census of which several processes have accounted for some of the techniques each. Their files
// are those of toJson() (technique_account.h) and say how they were made.
#pragma once

#include <filesystem>
#include <vector>

#include "framework/run/technique_account.h"

namespace kaustik::run {

// The whole of all shards: the same as of one process. The scene's census of paths is in the cache,
// or taken again. Throws ConfigError, naming the file, where they do not belong together or to the
// scene, and where one is missing, is there twice or is no such file; IoError where one cannot be
// read.
[[nodiscard]] SceneCensus mergeCensus(const scene::Scene& scene,
                                      const std::vector<std::filesystem::path>& files,
                                      const Watch& watch);

}  // namespace kaustik::run
