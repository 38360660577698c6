// SPDX-License-Identifier: MIT
#include "framework/render/view.h"

#include <gtest/gtest.h>

namespace kaustik::render::test {
namespace {

const glm::dvec3 kPosition(1.8, 2.2, 3.2);
const glm::dvec3 kDirection(-1.8, -2.0, -3.2);
const glm::dvec3 kUp(0.0, 1.0, 0.0);

TEST(LookAlong, TurnsTheDirectionOntoTheAxisAndThePositionIntoTheOrigin) {
    const glm::dmat4 toView = lookAlong(kPosition, kDirection, kUp);
    const glm::dvec3 origin(toView * glm::dvec4(kPosition, 1.0));
    const glm::dvec3 axis = glm::dmat3(toView) * glm::normalize(kDirection);
    EXPECT_LT(glm::length(origin), 1e-15);
    EXPECT_LT(glm::length(axis - glm::dvec3(0.0, 0.0, -1.0)), 1e-15);
    const glm::dvec3 up = glm::dmat3(toView) * kUp;
    EXPECT_NEAR(up.x, 0.0, 1e-15);
    EXPECT_GT(up.y, 0.0);
    EXPECT_NEAR(glm::determinant(toView), 1.0, 1e-15);
}

// By a place to look at, position + direction, what is left of the direction far out is rounded.
TEST(LookAlong, TurnsTheSameWhereverItIs) {
    const glm::dmat3 here(lookAlong(kPosition, kDirection, kUp));
    for (const double factor : {128.0, 1e-6, 1e9})
        EXPECT_EQ(here, glm::dmat3(lookAlong(factor * kPosition, kDirection, kUp))) << factor;
}

// Powers of two scale without rounding.
TEST(LookAlong, ScalesWithThePosition) {
    const glm::dmat4 once = lookAlong(kPosition, kDirection, kUp);
    const glm::dmat4 often = lookAlong(128.0 * kPosition, 128.0 * kDirection, kUp);
    EXPECT_EQ(glm::dmat3(once), glm::dmat3(often));
    EXPECT_EQ(128.0 * glm::dvec3(once[3]), glm::dvec3(often[3]));
}

TEST(LookAlong, TakesAnotherUpWhereItIsParallel) {
    for (const glm::dvec3 direction : {kUp, -2.0 * kUp}) {
        const glm::dmat4 toView = lookAlong(kPosition, direction, kUp);
        const glm::dvec3 axis = glm::dmat3(toView) * glm::normalize(direction);
        EXPECT_LT(glm::length(axis - glm::dvec3(0.0, 0.0, -1.0)), 1e-15);
    }
}

}  // namespace
}  // namespace kaustik::render::test
