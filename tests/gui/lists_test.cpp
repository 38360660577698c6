// SPDX-License-Identifier: MIT
// Lists that open, and the field that the long ones are searched by.
#include "tests/gui/workbench_fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

class Lists : public WorkbenchTest {
  protected:
    void untilClosed(const std::string& search) {
        bench->waitFor("a closed list",
                       [&](const json& screen) { return !screen.at("controls").contains(search); });
    }
};

TEST_F(Lists, CloseAtOneEscapeAndForgetTheirSearch) {
    start();
    for (const auto& [tab, list] :
         {std::pair{"Image", "image.texture"}, std::pair{"Study", "study.vary"}}) {
        const std::string search = std::string(list) + ".search";
        open(tab);
        const std::string before = bench->value(list);
        bench->click(list);
        bench->type("irr");
        EXPECT_EQ(bench->value(search), "irr") << list << ": the field has the keyboard";
        bench->key("Escape");
        untilClosed(search);
        EXPECT_EQ(bench->value(list), before);
        bench->click(list);
        EXPECT_EQ(bench->value(search), "");
        bench->key("Escape");
        untilClosed(search);
    }
}

}  // namespace
}  // namespace kaustik::test
