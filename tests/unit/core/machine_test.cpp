// SPDX-License-Identifier: MIT
#include "framework/core/machine.h"

#include <gtest/gtest.h>

namespace kaustik {
namespace {

ProcessorTimes at(double seconds, double machine, double own) {
    return {machine, own,
            std::chrono::steady_clock::time_point(
                std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                    std::chrono::duration<double>(seconds)))};
}

TEST(MachineLoad, IsWhatOthersHadOfTheProcessors) {
    // In two seconds all processors worked for three, this process for one of them.
    EXPECT_NEAR(otherProcessors(at(10, 100, 7), at(12, 103, 8)).value(), 1.0, 1e-9);
    EXPECT_EQ(otherProcessors(at(10, 100, 7), at(12, 100.99, 8)), 0.0);
}

TEST(MachineLoad, IsUnknownOfAMomentAndWithoutBothEnds) {
    EXPECT_FALSE(otherProcessors(at(10, 100, 7), at(10.05, 103, 8)));
    EXPECT_FALSE(otherProcessors(std::nullopt, at(12, 103, 8)));
    EXPECT_FALSE(otherProcessors(at(10, 100, 7), std::nullopt));
}

// What this process does is no other's.
TEST(MachineLoad, CountsThisProcessAsItsOwn) {
    const auto begin = processorTimes();
    ASSERT_TRUE(begin);
    volatile double sum = 0.0;
    while (std::chrono::steady_clock::now() - begin->when < std::chrono::milliseconds(300))
        sum = sum + 1.0;
    const auto end = processorTimes();
    ASSERT_TRUE(end);
    const double own = end->ownSeconds - begin->ownSeconds;
    EXPECT_GT(own, 0.0);
    // All processors together had at least that; theirs is counted in hundredths of a second.
    EXPECT_GT(end->machineSeconds - begin->machineSeconds, own - 0.05);
}

}  // namespace
}  // namespace kaustik
