// SPDX-License-Identifier: MIT
// The panel Trade-off: settings of the session as points of time and error, and the way back to
// one.
#include "tests/gui/workbench_fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

class TradeOffPanel : public WorkbenchTest {
  protected:
    void untilPoints(int count) {
        bench->waitFor("a point more", [&](const json& screen) {
            const json& controls = screen.at("controls");
            return controls.contains("trade_off.plot") &&
                   controls.at("trade_off.plot").at("value") == std::to_string(count) + " points";
        });
    }
};

TEST_F(TradeOffPanel, EachSettledSettingIsAPointAndAClickBringsItBack) {
    start();
    open("Trade-off");
    EXPECT_TRUE(says("trade_off.remark", "Points need a reference"));
    open("Error");
    bench->click("error.compute");
    open("Trade-off");
    untilPoints(1);
    const json before = document();
    EXPECT_EQ(bench->value("trade_off.point.1"), "front") << "there is no other one";
    open("Parameters");
    bench->typeInto("parameter.layers.count", "1", Entry::controlClick);
    open("Trade-off");
    untilPoints(2);
    EXPECT_TRUE(says("trade_off.row.2", "layers.count=1"));
    EXPECT_NE(document(), before);
    // Without layers photons are lost: whatever it costs, it cannot beat the first.
    EXPECT_EQ(bench->value("trade_off.point.1"), "front");
    bench->hover("trade_off.point.1");
    bench->keepScreenshot("trade-off");
    bench->click("trade_off.point.1");
    untilSettled();
    EXPECT_EQ(document(), before);
    untilPoints(2);  // the same settings are the same point
    choose("trade_off.measure", "FLIP");
    untilPoints(2);
    // Of another view no point can stand next to these.
    bench->drag("picture", 40, 0);
    bench->waitFor("no points of this view", [](const json& screen) {
        return screen.at("controls").contains("trade_off.remark");
    });
}

// Two settings that differ in the picture's brightness alone, and one that takes so much longer
// that the noise of these two's times is no distance.
TEST_F(TradeOffPanel, PointsThatLieOnEachOtherAreListedTogether) {
    json slower = smallDocument();
    slower["variant"]["set"]["emit.photons"] = "128x128";
    start(savedStateWith(slower));
    open("Error");
    bench->click("error.compute");
    open("Trade-off");
    untilPoints(1);
    open("Parameters");
    bench->typeInto("parameter.emit.photons", "512", Entry::click, "Return", {0.2, 0.5});
    open("Trade-off");
    untilPoints(2);
    open("Parameters");
    bench->typeInto("parameter.emit.photons", "512", Entry::click, "Return", {0.7, 0.5});
    open("Trade-off");
    untilPoints(3);
    bench->click("trade_off.row.1");
    untilSettled();
    open("Parameters");
    bench->typeInto("parameters.search", "picture.exposure");
    bench->typeInto("parameter.compose.picture.exposure", "0.5", Entry::controlClick);
    open("Trade-off");
    untilPoints(4);
    bench->click("trade_off.row.3");
    untilSettled();
    bench->hover("trade_off.point.1");
    ASSERT_TRUE(says("trade_off.heap", "2 lie here")) << bench->screen().at("controls");
    bench->keepScreenshot("trade-off-heap");
}

}  // namespace
}  // namespace kaustik::test
