// SPDX-License-Identifier: MIT
// The limits that a run reached, and what was lost to each: layers, bounces, and what nodes say of
// their own.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "framework/report/run_report.h"

namespace kaustik::report {

// From what was measured: the layers' statistics, the ledger and RunRecord::nodeLimits.
[[nodiscard]] std::vector<ReachedLimit> reachedLimits(const RunRecord& record,
                                                      const Renderer& renderer);

// For report.json: `limits`.
[[nodiscard]] nlohmann::json toJson(const std::vector<ReachedLimit>& limits);

}  // namespace kaustik::report
