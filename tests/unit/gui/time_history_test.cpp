// SPDX-License-Identifier: MIT
// Runs of frames of the same settings, and what a change between them has cost.
#include "framework/gui/time_history.h"

#include <gtest/gtest.h>

namespace kaustik::gui::test {
namespace {

class TimeHistoryTest : public testing::Test {
  protected:
    TimeHistoryTest() {
        result.document.scene = "pool";
        result.document.variant.technique = "planar";
        result.variants[0].frameMs = {50.0, 10.0, 12.0};
        addTimes("trace.a", {30.0, 6.0, 8.0});
    }
    void addTimes(const std::string& pass, std::vector<double> milliseconds) {
        report::PassTimes times;
        times.name = pass;
        times.gpuMilliseconds = std::move(milliseconds);
        result.variants[0].times.push_back(std::move(times));
    }
    // A next order, answered.
    void order() { result.variants[0].order = ++result.order; }
    FrameResult result;
    TimeHistory history;
};

TEST_F(TimeHistoryTest, FramesOfTheSameSettingsAreOneRun) {
    history.note(result, 0);
    result.variants[0].frameMs.push_back(11.0);
    result.document.edits.timeSeconds = 2.0;  // time passes, and settings stay
    order();
    history.note(result, 0);
    ASSERT_EQ(history.runs().size(), 1u);
    EXPECT_EQ(history.runs()[0].frameMs.size(), 4u);
    EXPECT_EQ(history.runs()[0].change, "");
}

TEST_F(TimeHistoryTest, AChangeBeginsARunAndSaysWhatItIs) {
    history.note(result, 0);
    result.document.variant.technique = "exact_rays";
    result.document.variant.assignments["emit.photons"] = "64x64";
    result.document.variant.disabled.insert("shadow.bvh");
    result.document.size = {400, 300};
    ++result.order;
    history.note(result, 0);
    EXPECT_EQ(history.runs().size(), 1u) << "what is there answers the order before";
    result.variants[0].order = result.order;
    result.variants[0].isPreview = true;
    history.note(result, 0);
    EXPECT_EQ(history.runs().size(), 1u) << "a quick picture is no frame";
    result.variants[0].isPreview = false;
    result.variants[0].frameMs = {7.0};
    history.note(result, 0);
    ASSERT_EQ(history.runs().size(), 2u);
    EXPECT_EQ(history.runs()[1].change,
              "size 800x600 → 400x300, planar → exact_rays, emit.photons default → 64x64, "
              "shadow.bvh on → off");
    // There is no B.
    history.note(result, 1);
    EXPECT_EQ(history.runs().size(), 2u);
}

TEST_F(TimeHistoryTest, KeepsTheNewestRuns) {
    for (std::size_t i = 0; i < TimeHistory::kMaxRuns + 3; ++i) {
        result.document.variant.assignments["emit.photons"] = std::to_string(i);
        order();
        history.note(result, 0);
    }
    EXPECT_EQ(history.runs().size(), TimeHistory::kMaxRuns);
    EXPECT_EQ(history.runs().back().variant, result.document.variant);
}

TEST_F(TimeHistoryTest, TellsMediansBeforeAndAfterWithWhatDiffersMostFirst) {
    addTimes("gather.b", {1.0, 1.0, 1.0});
    history.note(result, 0);
    result.variants[0].times.clear();
    result.variants[0].frameMs = {40.0, 21.0};
    addTimes("gather.b", {9.0, 1.5});
    addTimes("layers.c", {9.0, 14.0});
    result.document.variant.technique = "exact_rays";
    order();
    history.note(result, 0);
    ASSERT_EQ(history.runs().size(), 2u);
    const Table table = timesBeforeAndAfter(history.runs()[0], history.runs()[1]);
    using Row = std::vector<std::string>;
    ASSERT_EQ(table.rows.size(), 4u);
    EXPECT_EQ(table.rows[0], (Row{"frame", "11.00", "21.00", "+10.00"}));
    EXPECT_EQ(table.rows[1], (Row{"layers.c", "–", "14.00", "+14.00"}));
    EXPECT_EQ(table.rows[2], (Row{"trace.a", "7.00", "–", "-7.00"}));
    EXPECT_EQ(table.rows[3], (Row{"gather.b", "1.00", "1.50", "+0.50"}));
}

}  // namespace
}  // namespace kaustik::gui::test
