// SPDX-License-Identifier: MIT
// The line that says whether what is shown is what was asked for, and what is no longer possible.
#include <algorithm>

#include "tests/gui/shader_copies.h"
#include "tests/gui/workbench_fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

class ShownLine : public WorkbenchTest {
  protected:
    [[nodiscard]] std::vector<std::filesystem::path> savedExperiments() const {
        std::vector<std::filesystem::path> found;
        if (!std::filesystem::exists(folder / "out")) return found;
        for (const auto& entry : std::filesystem::directory_iterator(folder / "out")) {
            if (entry.path().extension() == ".toml") found.push_back(entry.path());
        }
        return found;
    }
};

TEST_F(ShownLine, APassThatIsNoLongerThereIsForgottenWithNotice) {
    start();
    bench->click("passes.on.shadow.lookup");
    untilSettled();
    EXPECT_EQ(bench->value("shown"), "asked");
    const json before = document();
    ASSERT_EQ(before.at("variant").at("disable"), json({"shadow.lookup"}));
    open("Technique");
    choose("stage.shadow", "rays");
    bench->waitFor("the pass forgotten", [](const json& screen) {
        return screen.at("status").at("document").at("variant").at("disable").empty();
    });
    untilSettled();
    EXPECT_TRUE(says("status.message", "shadow.lookup")) << bench->value("status.message");
    EXPECT_TRUE(says("shown.sentence", "What is shown is what was asked for"));
    bench->keepScreenshot("shown-forgotten");
    open("Passes");
    EXPECT_EQ(bench->value("passes.name.shadow.rays"), "ran");
    // What is saved runs, and gives the picture.
    bench->key("ctrl+s");
    ASSERT_TRUE(says("status.message", "Wrote "));
    ASSERT_EQ(savedExperiments().size(), 1u);
    run({"experiment", "run", savedExperiments().front().string(), "--out", "again"});
    // One step back is before the choice, and stays there.
    bench->key("ctrl+z");
    untilSettled();
    EXPECT_EQ(document(), before);
}

TEST_F(ShownLine, ChangesThatAreBeingRenderedAreSaidSo) {
    json slow = smallDocument();
    slow["size"] = {240, 180};
    slow["variant"]["set"]["emit.photons"] = "384x384";
    start(savedStateWith(slow));
    EXPECT_EQ(bench->value("shown"), "asked");
    bench->typeInto("parameter.emit.photons", "383", Entry::click, "Return", {0.2, 0.5});
    EXPECT_EQ(bench->value("shown"), "rendering");
    // What is not known to run is saved once it is.
    bench->key("ctrl+s");
    EXPECT_TRUE(savedExperiments().empty());
    bench->waitFor("the new picture", [](const json& screen) {
        return screen.at("controls").at("shown").at("value") == "asked";
    });
    bench->waitFor("the experiment", [](const json& screen) {
        return screen.at("status").at("message").get<std::string>().starts_with("Wrote ");
    });
    EXPECT_EQ(savedExperiments().size(), 1u);
}

// A tracer whose shader does not compile.
class ABrokenNode : public ShownLine {
  protected:
    void startWith(json document) {
        shaders.write("trace/march.frag", "no shader");
        WorkbenchTest::start(savedStateWith(document), shaders.environment());
    }
    ShaderCopies shaders{folder / "root"};
};

// However much better the reference gets.
TEST_F(ABrokenNode, IsNotSaidToBeMeasured) {
    startWith(smallDocument());
    open("Error");
    bench->click("error.compute");
    const auto untilComputed = [&](const char* control) {
        bench->waitFor(control, [&](const json& screen) {
            const json& controls = screen.at("controls");
            return controls.contains(control) && !controls.contains("error.progress");
        });
    };
    untilComputed("error.rmse");
    open("Technique");
    choose("stage.trace", "march");
    untilSettled();
    open("Error");
    bench->typeInto("error.photons", "4", Entry::controlClick, "Return", {0.2, 0.5});
    bench->click("error.compute");
    untilComputed("error.unjudged");
    EXPECT_TRUE(says("error.unjudged", "cannot run")) << bench->value("error.unjudged");
}

TEST_F(ABrokenNode, IsSaidWithAWayBackAndCannotBeSaved) {
    startWith(smallDocument());
    const json before = document();
    open("Technique");
    choose("stage.trace", "march");
    untilSettled();
    EXPECT_EQ(bench->value("shown"), "stale");
    EXPECT_TRUE(says("shown.sentence", "march.frag")) << bench->value("shown.sentence");
    bench->keepScreenshot("shown-stale");
    bench->key("ctrl+s");
    EXPECT_TRUE(says("status.message", "Not saved"));
    EXPECT_TRUE(says("status.message", "march.frag"));
    open("Record");
    bench->click("record.experiment");
    bench->click("record.report");
    EXPECT_TRUE(says("record.state", "idle"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    bench->click("shown.remedy");
    untilSettled();
    EXPECT_EQ(document(), before);
    EXPECT_EQ(bench->value("shown"), "asked");
    EXPECT_FALSE(bench->has("shown.remedy"));
}

TEST_F(ABrokenNode, InTheOtherVariantIsNamed) {
    json both = smallDocument();
    both["other"] = both["variant"];
    both["other"]["set"]["trace"] = "march";
    startWith(both);
    EXPECT_EQ(bench->value("shown"), "stale");
    EXPECT_TRUE(says("shown.sentence", "B: ")) << bench->value("shown.sentence");
    // Nothing has been rendered yet that one could go back to.
    bench->click("shown.remedy");
    untilSettled();
    EXPECT_EQ(bench->value("shown"), "asked");
    EXPECT_TRUE(document().at("other").at("set").empty());
}

}  // namespace
}  // namespace kaustik::test
