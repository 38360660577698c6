// SPDX-License-Identifier: MIT
#include "framework/certify/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "framework/certify/integration.h"
#include "tests/unit/certify/double_double.h"

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

// The same cut with 106 bits.
struct ExactPolygon {
    std::vector<DoubleDouble> x{0.0, 1.0, 0.0};
    std::vector<DoubleDouble> y{0.0, 0.0, 1.0};

    void cut(const HalfPlane& line) {
        const std::vector<DoubleDouble> fromX = std::exchange(x, {});
        const std::vector<DoubleDouble> fromY = std::exchange(y, {});
        const DoubleDouble zero(0.0);
        for (std::size_t i = 0; i < fromX.size(); ++i) {
            const std::size_t j = (i + 1) % fromX.size();
            const auto at = [&](std::size_t k) {
                return DoubleDouble(line.value) + DoubleDouble(line.slopeX) * fromX[k] +
                       DoubleDouble(line.slopeY) * fromY[k];
            };
            const DoubleDouble a = at(i);
            const DoubleDouble b = at(j);
            if (zero <= a) {
                x.push_back(fromX[i]);
                y.push_back(fromY[i]);
            }
            if ((zero <= a) == (zero <= b)) continue;
            const DoubleDouble t = a / (a - b);
            x.push_back(fromX[i] + t * (fromX[j] - fromX[i]));
            y.push_back(fromY[i] + t * (fromY[j] - fromY[i]));
        }
    }
    // Of value + slopes p over the polygon.
    [[nodiscard]] DoubleDouble integral(const TaylorModel& model) const {
        DoubleDouble sum(0.0);
        for (std::size_t i = 1; i + 1 < x.size(); ++i) {
            const DoubleDouble twice =
                (x[i] - x[0]) * (y[i + 1] - y[0]) - (x[i + 1] - x[0]) * (y[i] - y[0]);
            const DoubleDouble mean = DoubleDouble(model.value) +
                                      (DoubleDouble(model.slope[0]) * (x[0] + x[i] + x[i + 1]) +
                                       DoubleDouble(model.slope[1]) * (y[0] + y[i] + y[i + 1])) /
                                          DoubleDouble(3.0);
            sum = sum + twice * mean * DoubleDouble(0.5);
        }
        return sum;
    }
};

// Lines that have no band but what evaluating them is rounded by (as modelOf gives it), many of
// them nearly through corners and nearly along sides.
TEST(Polygon, HoldsTheExactIntegralWhateverIsRounded) {
    std::mt19937_64 generator(11);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    std::uniform_int_distribution<int> count(1, 12);
    std::uniform_int_distribution<int> kind(0, 2);
    int tight = 0;
    int kept = 0;
    for (int i = 0; i < 20000; ++i) {
        Polygon inner = Polygon::cell();
        Polygon outer = Polygon::cell();
        ExactPolygon truth;
        const int cuts = count(generator);
        for (int k = 0; k < cuts; ++k) {
            HalfPlane line = randomLine(generator, 0.0);
            if (kind(generator) == 0 && !inner.isEmpty()) {
                // Through two corners, but for 1e-15.
                const Point& p = inner[0];
                const Point& q = inner[1];
                line.slopeX = -(q.y - p.y) + 1e-15 * number(generator);
                line.slopeY = q.x - p.x;
                line.value = -(line.slopeX * p.x + line.slopeY * p.y);
            }
            const double scale = std::exp2(20.0 * number(generator));
            line.value *= scale;
            line.slopeX *= scale;
            line.slopeY *= scale;
            const double rounded =
                0x1p-49 * (std::fabs(line.value) + std::fabs(line.slopeX) + std::fabs(line.slopeY));
            line.low = -rounded;
            line.high = rounded;
            inner.cut(line, Side::inner);
            outer.cut(line, Side::outer);
            truth.cut(line);
        }
        TaylorModel model;
        model.value = 2.0 + number(generator);
        model.slope = {number(generator), number(generator)};
        const DoubleDouble exact = truth.integral(model);
        ASSERT_TRUE(DoubleDouble(integralBound(model, inner, false)) <= exact) << i;
        ASSERT_TRUE(exact <= DoubleDouble(integralBound(model, outer, true))) << i;
        if (exact.high > 1e-3) {
            ++kept;
            if (integralBound(model, outer, true) - integralBound(model, inner, false) < 1e-10)
                ++tight;
        }
    }
    EXPECT_GT(kept, 1000);
    EXPECT_EQ(tight, kept);
}

TEST(Polygon, HasTheMomentsOfTheTriangle) {
    const Polygon::Moments moments = Polygon::cell().moments();
    EXPECT_DOUBLE_EQ(moments.area, 0.5);
    EXPECT_DOUBLE_EQ(moments.x, 1.0 / 6.0);
    EXPECT_DOUBLE_EQ(moments.y, 1.0 / 6.0);
}

}  // namespace
}  // namespace kaustik::certify
