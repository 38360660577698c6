// SPDX-License-Identifier: MIT
// Deals the runs of a plan out to shards.
#pragma once

#include <vector>

#include "framework/core/shard.h"
#include "framework/experiment/plan.h"

namespace kaustik::experiment {

// What a report averages stays together: runs that differ in nothing but their seed, with all their
// repeats, are one shard's, so that they are timed on one device, interleaved with the others
// there. Such groups are dealt in an order that follows none of the settings, so that no shard gets
// all the slow ones. The runs are in the plan's order.
[[nodiscard]] std::vector<const PlannedRun*> runsOf(const Plan& plan, const Shard& shard);

}  // namespace kaustik::experiment
