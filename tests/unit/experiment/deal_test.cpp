// SPDX-License-Identifier: MIT
#include "framework/experiment/deal.h"

#include <gtest/gtest.h>

#include <map>

#include "framework/experiment/fingerprint.h"

namespace kaustik::experiment {
namespace {

// Every combination of a technique, a size and a seed.
Plan planOf(int techniques, int sizes, int seeds) {
    Plan plan;
    for (int technique = 0; technique < techniques; ++technique) {
        for (int size = 0; size < sizes; ++size) {
            for (int seed = 1; seed <= seeds; ++seed) {
                PlannedRun run;
                run.settings = {{"technique", technique}, {"size", size}, {"seed", seed}};
                run.hash = fingerprint(run.settings.dump());
                plan.runs.push_back(std::move(run));
            }
        }
    }
    return plan;
}

TEST(Deal, GivesEveryRunToOneShardInThePlansOrder) {
    const Plan plan = planOf(4, 5, 3);
    std::map<const PlannedRun*, int> dealt;
    for (std::uint64_t number = 1; number <= 7; ++number) {
        const PlannedRun* last = nullptr;
        for (const PlannedRun* run : runsOf(plan, {number, 7})) {
            ++dealt[run];
            EXPECT_LT(last, run);
            last = run;
        }
    }
    EXPECT_EQ(dealt.size(), plan.runs.size());
    for (const auto& [run, times] : dealt)
        EXPECT_EQ(times, 1);
}

TEST(Deal, KeepsTogetherWhatAReportAverages) {
    const Plan plan = planOf(4, 5, 3);
    for (std::uint64_t number = 1; number <= 7; ++number) {
        std::map<std::pair<int, int>, int> seeds;
        for (const PlannedRun* run : runsOf(plan, {number, 7}))
            ++seeds[{run->settings.at("technique"), run->settings.at("size")}];
        for (const auto& [settings, count] : seeds)
            EXPECT_EQ(count, 3);
    }
}

TEST(Deal, IsBalancedAndFollowsNoSetting) {
    // As many shards as sizes: dealt one by one, each shard would have all runs of one size.
    const Plan plan = planOf(40, 5, 1);
    for (std::uint64_t number = 1; number <= 5; ++number) {
        const auto runs = runsOf(plan, {number, 5});
        EXPECT_EQ(runs.size(), 40u);
        std::map<int, int> sizes;
        for (const PlannedRun* run : runs)
            ++sizes[run->settings.at("size")];
        for (const auto& [size, count] : sizes)
            EXPECT_LT(count, 20) << "size " << size << " in shard " << number;
    }
}

TEST(Deal, LeavesSomeShardsEmptyWhereThereAreFewRuns) {
    const Plan plan = planOf(1, 2, 1);
    std::size_t runs = 0;
    for (std::uint64_t number = 1; number <= 5; ++number)
        runs += runsOf(plan, {number, 5}).size();
    EXPECT_EQ(runs, 2u);
}

}  // namespace
}  // namespace kaustik::experiment
