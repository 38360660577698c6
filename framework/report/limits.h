// SPDX-License-Identifier: MIT
// The limits that a run reached, and what was lost to each: layers, bounces, and what nodes say of
// their own.
#pragma once

#include <optional>
#include <vector>

#include "framework/report/run_report.h"

namespace kaustik::report {

// From what was measured: the layers' statistics, the ledger and RunRecord::nodeLimits. Their
// sentences are whole: they say what is counted, too.
[[nodiscard]] std::vector<ReachedLimit> reachedLimits(const RunRecord& record,
                                                      const Renderer& renderer);

// An entry of `limits` in report.json.
struct LimitTable {
    ReachedLimit limit;
};
template <class F>
void reflect(F& f, const LimitTable& table) {
    const ReachedLimit& limit = table.limit;
    f.field("limit", limit.parameter, "The parameter that sets it");
    f.field("unit", limit.unit, "Of value and needed");
    f.field("value", limit.value, "What the parameter allows");
    f.fieldOrNull("needed", limit.needed > 0.0 ? std::optional(limit.needed) : std::nullopt, "",
                  "What would have been enough; null where that is not known");
    f.field("lost", limit.sentence, "What was lost, in words");
    f.field("lost_w", limit.lostWatts, "Flux that was lost");
    f.field("count", limit.counted.empty() ? std::nullopt : std::optional(limit.count),
            "How many of what `lost` speaks of, where that is counted, in all batches");
    f.field("count_w", limit.countedWatts > 0.0 ? std::optional(limit.countedWatts) : std::nullopt,
            "The flux that these carry, where that is counted");
}

}  // namespace kaustik::report
