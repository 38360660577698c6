// SPDX-License-Identifier: MIT
// The limits that a run reached, and what was lost to each: batches, bounces, layers.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/report/run_report.h"

namespace kaustik::report {

struct ReachedLimit {
    std::string parameter;  // "layers.count"
    double value = 0.0;
    double needed = 0.0;   // what would have been enough; 0: nobody knows
    std::string sentence;  // what was lost
    double lostWatts = 0.0;
};

// From what was measured: the layers' statistics, the ledger, and the passes that ran in batches.
[[nodiscard]] std::vector<ReachedLimit> reachedLimits(const RunRecord& record,
                                                      const Renderer& renderer);

// For report.json: `limits`.
[[nodiscard]] nlohmann::json toJson(const std::vector<ReachedLimit>& limits);

}  // namespace kaustik::report
