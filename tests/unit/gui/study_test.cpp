// SPDX-License-Identifier: MIT
// What is varied, in how many runs, and how long they are expected to take.
#include "framework/gui/study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "techniques/register_all.h"

namespace kaustik::gui::test {
namespace {

class StudyTest : public testing::Test {
  protected:
    [[nodiscard]] TypedAxis typed(const std::string& key, const std::string& text) const {
        return typedAxis(key, text, Variant(), registry_);
    }
    [[nodiscard]] static Study twoAxes() {
        Study study;
        study.document.variant.assignments = {{"trace.epsilon", "0.02"}};
        study.axes = {{"layers.count", {"4", "8"}}, {"trace", {"march", "lines", "exact"}}};
        return study;
    }
    Registry registry_ = registerAll();
};

using Texts = std::vector<std::string>;

TEST_F(StudyTest, TakesValuesThatWereTypedWhateverIsBetweenThem) {
    for (const char* text : {"1 4 16", "1, 4, 16", " 1;4 ;  16 ", "1 4 4 16 1"}) {
        const TypedAxis axis = typed("layers.count", text);
        EXPECT_EQ(axis.problem, "") << text;
        EXPECT_EQ(axis.axis.values, (Texts{"1", "4", "16"})) << text;
    }
    EXPECT_EQ(typed("emit.photons", "32x32 64x16").axis.values, (Texts{"32x32", "64x16"}));
    EXPECT_EQ(typed("trace.epsilon", "0.010 1e-2 0.5").axis.values, (Texts{"0.01", "0.5"}))
        << "equal ones are the same run";
    EXPECT_EQ(typed(kTechniqueKey, "exact_rays screen_space_photons").axis.values,
              (Texts{"exact_rays", "screen_space_photons"}));
}

TEST_F(StudyTest, SaysWhatIsNoValue) {
    EXPECT_NE(typed("layers.count", "4 many").problem.find("many"), std::string::npos);
    EXPECT_TRUE(typed("layers.count", "4 many").problem.starts_with("layers.count"));
    EXPECT_NE(typed("layers.count", "4 1000000").problem.find("1000000"), std::string::npos);
    // A decimal comma is neither two values nor one.
    EXPECT_NE(typed("trace.epsilon", "0,05").problem.find("0,05"), std::string::npos);
    EXPECT_NE(typed("layers.count", " , ").problem, "");
    EXPECT_NE(typed("layers.number", "1").problem.find("layers.number"), std::string::npos);
    EXPECT_NE(typed(kTechniqueKey, "exact_ways").problem.find("exact_rays"), std::string::npos);
}

TEST_F(StudyTest, HasEveryCombinationOnceAndTheRestAsItIs) {
    const Study study = twoAxes();
    const std::vector<Variant> variants = variantsOf(study);
    ASSERT_EQ(variants.size(), runCount(study.axes));
    ASSERT_EQ(variants.size(), 6u);
    std::set<std::string> texts;
    for (const Variant& variant : variants) {
        texts.insert(variedText(study, variant));
        EXPECT_EQ(variant.assignments.at("trace.epsilon"), "0.02");
    }
    EXPECT_EQ(texts.size(), 6u);
    // The last axis varies fastest.
    EXPECT_EQ(variedText(study, variants[0]), "layers.count=4, trace=march");
    EXPECT_EQ(variedText(study, variants[1]), "layers.count=4, trace=lines");
    EXPECT_EQ(variedText(study, variants[3]), "layers.count=8, trace=march");
}

TEST_F(StudyTest, CountsNoFurtherThanItsLimit) {
    std::vector<StudyAxis> axes(40, {"key", Texts(100, "1")});
    EXPECT_EQ(runCount(axes), kMaxStudyRuns + 1);
    axes.resize(1);
    EXPECT_EQ(runCount(axes), 100u);
}

// Each run is a start, and the frames that are timed, one before and one for the ledger.
TEST_F(StudyTest, ExpectsWhatTheSessionHasMeasured) {
    const Study study = twoAxes();
    const KnownTimes known{2.0, 100.0, true};
    EXPECT_NEAR(expectedSeconds(study, 8, known, {}), 6 * (2.0 + 0.1 * 10), 1e-9);
    SettledPoint point;
    point.document = study.document;
    point.document.variant = variantsOf(study)[4];
    point.isPrecise = true;
    point.frameMs = 700.0;
    EXPECT_NEAR(expectedSeconds(study, 8, known, {point}), 5 * 3.0 + (2.0 + 0.7 * 10), 1e-9);
    // What was timed in another way, or of another view, says nothing.
    SettledPoint other = point;
    other.isPrecise = false;
    SettledPoint elsewhere = point;
    elsewhere.document.size = {64, 48};
    EXPECT_NEAR(expectedSeconds(study, 8, known, {other, elsewhere}), 18.0, 1e-9);
}

TEST_F(StudyTest, SaysATimeInWords) {
    EXPECT_EQ(durationText(0.0), "1 s");
    EXPECT_EQ(durationText(39.2), "40 s");
    EXPECT_EQ(durationText(170.0), "3 min");
    EXPECT_EQ(durationText(7500.0), "2 h 05 min");
}

}  // namespace
}  // namespace kaustik::gui::test
