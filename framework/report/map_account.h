// SPDX-License-Identifier: MIT
// What became of light that was stored off the screen: `map` of report.json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "framework/pipeline/renderer.h"

namespace kaustik::report {

// Of the frame that `renderer` has rendered to be measured; null where all light was stored on the
// screen.
[[nodiscard]] nlohmann::json mapAccount(const Renderer& renderer);
[[nodiscard]] nlohmann::json mapSchema();

// The same frame's `cells`: how many photons a driver that chooses them has taken, and looked at;
// null where it takes all of a grid's.
[[nodiscard]] nlohmann::json cellAccount(const Renderer& renderer);
[[nodiscard]] nlohmann::json cellSchema();

}  // namespace kaustik::report
