// SPDX-License-Identifier: MIT
// What became of light that was stored: `map` (off the screen, or where a filter has changed it),
// `cells` and `energy.primitives` of report.json.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "framework/pipeline/renderer.h"

namespace kaustik::report {

struct PrimitiveFlux {
    double trianglesWatts = 0.0;
    double beamsWatts = 0.0;
};

// Of the frame that `renderer` has rendered to be measured; null where all light was stored on the
// screen and no filter has changed it.
[[nodiscard]] nlohmann::json mapAccount(const Renderer& renderer);
// One sentence where the filter of this name has lost or added a tenth of the flux or more.
[[nodiscard]] std::optional<std::string> mapWarning(const nlohmann::json& account,
                                                    const std::string& filter);
[[nodiscard]] nlohmann::json mapSchema();

// The report's `cells` of that frame: how many photons a driver that chooses them has taken, and
// looked at; null where it takes all of a grid's.
[[nodiscard]] nlohmann::json cellAccount(const Renderer& renderer);
[[nodiscard]] nlohmann::json cellSchema();

// The same frame's flux that was given to pixels between photons that are joined, and by beams of
// those that are not, W.
[[nodiscard]] PrimitiveFlux primitiveFlux(const Renderer& renderer);

}  // namespace kaustik::report
