// SPDX-License-Identifier: MIT
#include "framework/certify/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace kaustik::certify {
namespace {

HalfPlane randomLine(std::mt19937_64& generator, double band) {
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const double angle = 3.14159 * number(generator);
    const double x = 0.33 + 0.3 * number(generator);
    const double y = 0.33 + 0.3 * number(generator);
    return {-(std::cos(angle) * x + std::sin(angle) * y), std::cos(angle), std::sin(angle), -band,
            band};
}

// Whatever the truth within the band is, its area lies between.
TEST(Polygon, OfABandEnclosesEveryLineWithin) {
    std::mt19937_64 generator(2);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    for (int i = 0; i < 2000; ++i) {
        Polygon inner = Polygon::cell();
        Polygon outer = Polygon::cell();
        Polygon truth = Polygon::cell();
        for (int k = 0; k < 5; ++k) {
            const double band = 0.02;
            const HalfPlane line = randomLine(generator, band);
            inner.cut(line, Side::inner);
            outer.cut(line, Side::outer);
            truth.cut(line.value, line.slopeX, line.slopeY, band * share(generator));
        }
        ASSERT_LE(inner.moments().area, truth.moments().area + kAreaSlack);
        ASSERT_GE(outer.moments().area, truth.moments().area - kAreaSlack);
    }
}

TEST(Polygon, AndWhatIsTakenAwayAreTheWhole) {
    std::mt19937_64 generator(4);
    for (int i = 0; i < 2000; ++i) {
        Region region;
        Polygon within = Polygon::cell();
        for (int k = 0; k < 4; ++k) {
            region.push_back(randomLine(generator, 0.0));
            within.cut(region.back(), Side::outer);
        }
        Polygons left{Polygon::cell()};
        subtract(left, region, Side::outer);
        ASSERT_NEAR(areaOf(left) + within.moments().area, 0.5, 1e-13);
        if (within.isEmpty()) {
            ASSERT_EQ(left.size(), 1u);
        }
    }
}

TEST(Polygon, HasTheMomentsOfTheTriangle) {
    const Polygon::Moments moments = Polygon::cell().moments();
    EXPECT_DOUBLE_EQ(moments.area, 0.5);
    EXPECT_DOUBLE_EQ(moments.x, 1.0 / 6.0);
    EXPECT_DOUBLE_EQ(moments.y, 1.0 / 6.0);
}

}  // namespace
}  // namespace kaustik::certify
