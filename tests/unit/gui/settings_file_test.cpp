// SPDX-License-Identifier: MIT
#include "framework/gui/settings_file.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "framework/core/files.h"
#include "techniques/register_all.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::gui::test {
namespace {

class SettingsFile : public testing::Test {
  protected:
    [[nodiscard]] Settings read() const { return readSettings(folder_ / "", registry_); }
    void write(const std::string& text) const { writeSettings(folder_ / "", text); }
    [[nodiscard]] bool exists(const std::string& name) const {
        return std::filesystem::exists(folder_ / name);
    }
    kaustik::test::TemporaryFolder folder_;
    Registry registry_ = registerAll();
};

TEST_F(SettingsFile, IsNotThereAtTheFirstStart) {
    EXPECT_TRUE(read().problems.empty());
    EXPECT_EQ(read().document, Document());
    EXPECT_TRUE(readSettings("", registry_).problems.empty()) << "nor where nothing is kept";
}

TEST_F(SettingsFile, IsReadAsItWasWritten) {
    Document document;
    document.scene = "ring";
    document.variant.assignments = {{"trace.epsilon", "0.25"}};
    nlohmann::json all = toJson(SavedState());
    all["document"] = toJson(document);
    write(all.dump());
    EXPECT_TRUE(read().problems.empty());
    EXPECT_EQ(read().document, document);
}

TEST_F(SettingsFile, ThatIsCutOffIsKeptUnderAnotherName) {
    write(R"({"view": {"layer": 3)");
    const Settings settings = read();
    ASSERT_EQ(settings.problems.size(), 1u);
    const SettingsBackup aside = setSettingsAside(folder_ / "", settings.problems);
    EXPECT_TRUE(aside.isDone);
    EXPECT_FALSE(exists("workbench.json"));
    EXPECT_EQ(readFile(folder_ / "workbench-damaged-1.json"), R"({"view": {"layer": 3)");
    EXPECT_NE(aside.notice.find("workbench-damaged-1.json"), std::string::npos) << aside.notice;
    // And the next one, too.
    write("[");
    EXPECT_TRUE(setSettingsAside(folder_ / "", read().problems).isDone);
    EXPECT_EQ(readFile(folder_ / "workbench-damaged-2.json"), "[");
    EXPECT_EQ(readFile(folder_ / "workbench-damaged-1.json"), R"({"view": {"layer": 3)");
}

TEST_F(SettingsFile, ThatIsNestedDeeperThanTheStackIsDamaged) {
    write("{\"view\": {\"layer\": " + std::string(100000, '[') + std::string(100000, ']') + "}}");
    ASSERT_EQ(read().problems.size(), 1u);
    EXPECT_NE(read().problems.front().find("nested more than 64 deep"), std::string::npos);
}

TEST_F(SettingsFile, OfWhichAPartMakesNoSenseIsDamagedAndTheRestIsUsed) {
    write(R"({"view": {"layer": "three", "split": 0.25}})");
    const Settings settings = read();
    EXPECT_EQ(settings.problems.size(), 1u);
    EXPECT_NE(settings.problems.front().find("view.layer"), std::string::npos);
    EXPECT_EQ(settings.kept.view.split, 0.25f);
}

TEST_F(SettingsFile, WithNamesOfAnotherVersionIsDamaged) {
    Document document;
    document.scene = "ring";
    document.variant.assignments = {{"no.such.parameter", "1"}};
    write(nlohmann::json({{"document", toJson(document)}}).dump());
    const Settings settings = read();
    ASSERT_EQ(settings.problems.size(), 1u);
    EXPECT_NE(settings.problems.front().find("no.such.parameter"), std::string::npos);
    EXPECT_EQ(settings.document.scene, "ring");
    EXPECT_EQ(settings.document.variant, Variant());
}

TEST_F(SettingsFile, WithTheFormerNameOfAParameterIsToldTheNewOne) {
    Document document;
    document.scene = "ring";
    document.variant.assignments = {{"secant.most", "1"}};
    write(nlohmann::json({{"document", toJson(document)}}).dump());
    const Settings settings = read();
    ASSERT_EQ(settings.problems.size(), 1u);
    EXPECT_NE(settings.problems.front().find("it is called 'trace.secant.max_steps' now"),
              std::string::npos)
        << settings.problems.front();
}

TEST_F(SettingsFile, ThatCannotBePutAsideIsNotToBeReplaced) {
    const SettingsBackup aside = setSettingsAside(folder_ / "nowhere", {"a problem"});
    EXPECT_FALSE(aside.isDone);
    EXPECT_NE(aside.notice.find("nothing is kept"), std::string::npos) << aside.notice;
}

}  // namespace
}  // namespace kaustik::gui::test
