// SPDX-License-Identifier: MIT
#include "framework/experiment/deal.h"

#include <map>
#include <set>
#include <string>

#include "framework/experiment/fingerprint.h"

namespace kaustik::experiment {
namespace {

std::string groupOf(const PlannedRun& run) {
    nlohmann::json settings = run.settings;
    settings.erase("seed");
    return fingerprint(settings.dump());
}

}  // namespace

std::vector<const PlannedRun*> runsOf(const Plan& plan, const Shard& shard) {
    std::vector<const PlannedRun*> runs;
    std::map<std::string, std::vector<const PlannedRun*>> groups;  // as good as shuffled
    for (const PlannedRun& run : plan.runs)
        groups[groupOf(run)].push_back(&run);
    std::set<const PlannedRun*> own;
    std::uint64_t index = 0;
    for (const auto& [group, members] : groups) {
        if (index++ % shard.count == shard.number - 1) own.insert(members.begin(), members.end());
    }
    for (const PlannedRun& run : plan.runs) {
        if (own.contains(&run)) runs.push_back(&run);
    }
    return runs;
}

}  // namespace kaustik::experiment
