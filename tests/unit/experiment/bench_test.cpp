// SPDX-License-Identifier: MIT
#include "framework/experiment/bench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_text.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::experiment {
namespace {

// Tables of the distribution, two-sided.
TEST(StudentT, IsThatOfTables) {
    EXPECT_NEAR(studentT(1.0, 0.05), 12.706, 0.002);
    EXPECT_NEAR(studentT(2.0, 0.05), 4.3027, 0.0005);
    EXPECT_NEAR(studentT(4.0, 0.01), 4.6041, 0.0005);
    EXPECT_NEAR(studentT(10.0, 0.05), 2.2281, 0.0003);
    EXPECT_NEAR(studentT(8.0, 0.001), 5.0413, 0.001);
    EXPECT_NEAR(studentT(1e6, 0.05), 1.95996, 0.0003);
}

TEST(TimeChange, OfTwiceTheTimeIsTwo) {
    const TimeChange change = changeOfTime({10.0, 10.1, 9.9}, {20.0, 20.2, 19.8}, 0.05);
    EXPECT_NEAR(change.ratio, 2.0, 1e-6);
    EXPECT_GT(change.low, 1.9);
    EXPECT_LT(change.high, 2.1);
    EXPECT_EQ(change.verdict(), Verdict::slower);
    EXPECT_EQ(changeOfTime({20.0, 20.2, 19.8}, {10.0, 10.1, 9.9}, 0.05).verdict(), Verdict::faster);
}

TEST(TimeChange, OfOneRoundIsUndecided) {
    const TimeChange change = changeOfTime({10.0}, {20.0, 21.0}, 0.05);
    EXPECT_NEAR(change.ratio, std::sqrt(20.0 * 21.0) / 10.0, 1e-9);
    EXPECT_EQ(change.verdict(), Verdict::undecided);
}

// Of versions that are alike it is in error as often as it says.
TEST(TimeChange, IsFalseAsOftenAsItMayBe) {
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0.0, 0.1);
    const auto rounds = [&] {
        std::vector<double> times(5);
        for (double& time : times)
            time = 100.0 * std::exp(noise(random));
        return times;
    };
    int wrong = 0;
    constexpr int kTrials = 1000;
    for (int i = 0; i < kTrials; ++i)
        wrong += changeOfTime(rounds(), rounds(), 0.05).verdict() != Verdict::undecided;
    EXPECT_LT(wrong, 75);
    EXPECT_GT(wrong, 15);
}

class BenchFile : public testing::Test {
  protected:
    test::TemporaryFolder folder;

    static Bench bench(double factor = 1.0) {
        Bench bench{"1.0", "2026-11-25T00:00:00Z", "a device", "--size 4x3", 0.5, {}};
        bench.scenes["pool"].frame = {10.0 * factor, 10.2 * factor, 9.9 * factor};
        bench.scenes["pool"].passes["emit.grid"] = {1.0, 1.1, 0.9};
        bench.scenes["ring"].frame = {5.0, 5.1, 4.9};
        return bench;
    }
};

TEST_F(BenchFile, IsReadAsItWasWritten) {
    writeFileWhole(folder / "a.json", jsonText(benchJson(bench())));
    const Bench read = readBench(folder / "a.json");
    EXPECT_EQ(read.version, "1.0");
    EXPECT_EQ(read.otherProcessors, 0.5);
    EXPECT_EQ(read.scenes.at("pool").frame, bench().scenes.at("pool").frame);
    EXPECT_EQ(read.scenes.at("pool").passes, bench().scenes.at("pool").passes);
}

TEST_F(BenchFile, ThatIsNoneIsRefused) {
    for (const char* text : {"", "[]", "{}", R"({"schema": "kaustik.report/1"})",
                             R"({"schema": "kaustik.bench/1", "version": 1})"}) {
        writeFileWhole(folder / "a.json", text);
        EXPECT_THROW(static_cast<void>(readBench(folder / "a.json")), IoError) << text;
    }
    std::string zero = jsonText(benchJson(bench()));
    zero.replace(zero.find("5.0"), 3, "0.0");
    writeFileWhole(folder / "a.json", zero);
    EXPECT_THROW(static_cast<void>(readBench(folder / "a.json")), IoError);
}

TEST_F(BenchFile, ComparesScenesAndPassesOfBoth) {
    const std::vector<SceneChange> changes = compareBenches(bench(), bench(1.5));
    ASSERT_EQ(changes.size(), 2u);
    EXPECT_EQ(changes[0].scene, "pool");
    EXPECT_EQ(changes[0].frame.verdict(), Verdict::slower);
    EXPECT_EQ(changes[0].passes.at("emit.grid").verdict(), Verdict::undecided);
    EXPECT_EQ(changes[1].frame.verdict(), Verdict::undecided);
}

TEST_F(BenchFile, OfAnotherDeviceOrOtherSettingsIsNotCompared) {
    Bench other = bench();
    other.device = "another";
    EXPECT_THROW(static_cast<void>(compareBenches(bench(), other)), ConfigError);
    other = bench();
    other.settings = "--size 8x6";
    EXPECT_THROW(static_cast<void>(compareBenches(bench(), other)), ConfigError);
    other = bench();
    other.scenes.clear();
    EXPECT_THROW(static_cast<void>(compareBenches(bench(), other)), ConfigError);
}

}  // namespace
}  // namespace kaustik::experiment
