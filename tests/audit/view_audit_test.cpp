// SPDX-License-Identifier: MIT
// Errors of the view's exits, judged by hand: four pixels, of which one sees nothing specular.
#include "framework/audit/view_audit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace kaustik::audit {
namespace {

class ExitErrorsOf : public testing::Test {
  protected:
    ExitErrorsOf() : position_(4, 1, 4), direction_(4, 1, 4) {
        reference_.exitPosition = Image(4, 1, 4);
        reference_.exitDirection = Image(4, 1, 4);
        reference_.mask = Image(4, 1, 1);
        for (int x = 0; x < 3; ++x) {
            reference_.mask.at(x, 0, 0) = 1.0f;
            put(reference_.exitPosition, x, {0, 0, -2, 2});
            put(reference_.exitDirection, x, {0, 0, -1, 1});
            put(position_, x, {0, 0, -2, 2});
            put(direction_, x, {0, 0, -1, 1});
        }
        view_.tangents = glm::dvec2(1.0);
        view_.width = 100;
        view_.height = 100;
    }
    static void put(Image& image, int x, const glm::vec4& value) {
        for (int c = 0; c < 4; ++c)
            image.at(x, 0, c) = value[c];
    }
    [[nodiscard]] ViewAudit audit() const {
        return auditView(position_, direction_, reference_, view_);
    }
    Image position_;
    Image direction_;
    reference::ViewReference reference_;
    render::EyeView view_;
};

TEST_F(ExitErrorsOf, AreZeroWhereAllIsRight) {
    const ViewAudit found = audit();
    EXPECT_EQ(found.pixels, 3u);
    EXPECT_EQ(found.interfacesRight, 3u);
    EXPECT_EQ(found.lost, 0u);
    EXPECT_EQ(found.all.directionDegrees, std::vector<double>(3, 0.0));
    EXPECT_EQ(toJson(found).at("exit_position_m").at("p99"), 0.0);
}

TEST_F(ExitErrorsOf, AreAnglesMetresAndPixels) {
    // 30 degrees aside, and 0.4 m aside at 2 m, where a pixel covers 0.04 m.
    put(direction_, 1, {0.5f, 0.0f, -std::sqrt(0.75f), 1.0f});
    put(position_, 1, {0.4f, 0.0f, -2.0f, 4.0f});
    const ViewAudit found = audit();
    EXPECT_NEAR(found.all.directionDegrees.back(), 30.0, 1e-5);
    EXPECT_NEAR(found.all.positionMeters.back(), 0.4, 1e-6);
    EXPECT_NEAR(found.all.positionPixels.back(), 10.0, 1e-5);
    // Of another number of interfaces.
    EXPECT_EQ(found.interfacesRight, 2u);
    EXPECT_EQ(found.sameInterfaces.directionDegrees.back(), 0.0);
}

TEST_F(ExitErrorsOf, TellLostRaysAndWhatIsNoNumberApart) {
    put(direction_, 0, {0, 0, -1, 0});
    put(position_, 1, {std::numeric_limits<float>::quiet_NaN(), 0, 0, 2});
    // The exact ray itself is caught: nothing to compare with, nothing lost.
    put(reference_.exitDirection, 2, {0, 0, 0, 0});
    const ViewAudit found = audit();
    EXPECT_EQ(found.lost, 1u);
    EXPECT_EQ(found.notANumber, 1u);
    EXPECT_TRUE(found.all.directionDegrees.empty());
    EXPECT_TRUE(toJson(found).at("exit_direction_deg").at("median").is_null());
}

}  // namespace
}  // namespace kaustik::audit
