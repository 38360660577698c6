// SPDX-License-Identifier: MIT
// Numbers as people type them: with a comma, without a digit, beyond what there is.
#include "framework/gui/typed_value.h"

#include <gtest/gtest.h>

namespace kaustik::gui {
namespace {

struct Some {
    float epsilon = 0.01f;
    int layers = 8;
    params::Extent photons{32, 32};
    int samples = 1;
    template <class R>
    void reflect(R& r) {
        r.field(epsilon, "epsilon", "A distance", "m", params::range(1e-6f, 10.0f));
        r.field(layers, "layers", "A number", "", params::range(1, 64));
        r.field(photons, "photons", "A grid", "", params::range(1, 16384));
        r.field(samples, "samples", "Squares", "", params::range(1, 16)).only({1, 4, 9, 16});
    }
};

class TypedValues : public testing::Test {
  protected:
    params::ParamSet params = [] {
        params::ParamSet made;
        made.declare<Some>("some");
        return made;
    }();
    [[nodiscard]] params::NamedField named(const std::string& name) const {
        return {"some." + name, params.find("some." + name), ""};
    }
};

TEST_F(TypedValues, ThatFitAreTaken) {
    EXPECT_EQ(typedValue(named("epsilon"), "0.25").text, "0.25");
    EXPECT_EQ(typedValue(named("epsilon"), " 1e-3 ").text, "1e-3");
    EXPECT_EQ(typedValue(named("layers"), "64").text, "64");
    EXPECT_EQ(typedValue(named("layers"), "64").problem, "");
    EXPECT_EQ(typedExtent(named("photons"), {16, 24}).text, "16x24");
    EXPECT_EQ(typedExtent(named("photons"), {16, 24}).problem, "");
}

TEST_F(TypedValues, ThatAreNoNumbersLeaveAllAsItWasAndSaySo) {
    for (const char* text : {"0,05", "abc", "", "nan", "inf", "1 2", "0.05m"}) {
        SCOPED_TRACE(text);
        const TypedValue typed = typedValue(named("epsilon"), text);
        EXPECT_EQ(typed.text, "");
        EXPECT_NE(typed.problem.find("some.epsilon cannot be '" + std::string(text)),
                  std::string::npos)
            << typed.problem;
    }
    EXPECT_EQ(typedValue(named("layers"), "2.5").text, "");
    EXPECT_EQ(typedValue(named("layers"), "99.5").text, "");
    // What was there is as it was.
    EXPECT_EQ(params.get<Some>("some").epsilon, 0.01f);
    EXPECT_EQ(params.get<Some>("some").layers, 8);
}

TEST_F(TypedValues, BetweenThoseThatAreTakenBecomeTheNearestAndSaySo) {
    EXPECT_EQ(typedValue(named("samples"), "9").problem, "");
    const TypedValue between = typedValue(named("samples"), "8");
    EXPECT_EQ(between.text, "9");
    EXPECT_EQ(between.problem, "some.samples takes 1 | 4 | 9 | 16: of 8 it has taken 9.");
    EXPECT_EQ(typedValue(named("samples"), "1e9").text, "16");
    EXPECT_EQ(typedValue(named("samples"), "8.5").text, "");
}

TEST_F(TypedValues, BeyondTheRangeBecomeTheNearestWithinAndSaySo) {
    const TypedValue far = typedValue(named("epsilon"), "99999");
    EXPECT_EQ(far.text, "10");
    EXPECT_EQ(far.problem, "some.epsilon takes 1e-06 to 10 m: of 99999 it has taken 10.");
    EXPECT_EQ(typedValue(named("layers"), "-3").text, "1");
    EXPECT_EQ(typedValue(named("layers"), "1000").text, "64");
    const TypedValue grid = typedExtent(named("photons"), {99999, 0});
    EXPECT_EQ(grid.text, "16384x1");
    EXPECT_NE(grid.problem.find("99999x0"), std::string::npos) << grid.problem;
}

}  // namespace
}  // namespace kaustik::gui
