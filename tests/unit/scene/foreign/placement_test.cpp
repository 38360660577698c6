// SPDX-License-Identifier: MIT
// Matrices as the keys of an object: what the keys say again is the matrix.
#include "framework/scene/foreign/foreign_placement.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

namespace kaustik::scene::test {
namespace {

// As a scene file has it: scaled, turned about the fixed axes x, y and z, and moved.
glm::dmat4 matrixOf(const Placement& placement) {
    const glm::dvec3 angles = glm::radians(placement.rotationDegrees);
    glm::dmat4 matrix = glm::translate(glm::dmat4(1.0), placement.position);
    matrix = glm::rotate(matrix, angles.z, glm::dvec3(0, 0, 1));
    matrix = glm::rotate(matrix, angles.y, glm::dvec3(0, 1, 0));
    matrix = glm::rotate(matrix, angles.x, glm::dvec3(1, 0, 0));
    matrix = glm::scale(matrix, placement.scale);
    return placement.isMirrored ? glm::scale(matrix, glm::dvec3(-1, 1, 1)) : matrix;
}

// Angles come from sines next to their top, where half of the digits are lost.
void expectSame(const glm::dmat4& a, const glm::dmat4& b) {
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j)
            EXPECT_NEAR(a[i][j], b[i][j], 1e-6) << i << " " << j;
    }
}

TEST(ForeignPlacement, SaysEveryRotationAndScale) {
    for (const double x : {-150.0, -90.0, 0.0, 30.0, 180.0}) {
        for (const double y : {-90.0, -20.0, 0.0, 90.0}) {
            for (const double z : {-45.0, 0.0, 90.0, 170.0}) {
                for (const double scale : {3.0, -3.0}) {
                    Placement wanted;
                    wanted.position = {1, -2, 3};
                    wanted.rotationDegrees = {x, y, z};
                    wanted.scale = {scale, 0.5, 2};
                    const glm::dmat4 matrix = matrixOf(wanted);
                    const auto found = placementOf(matrix);
                    ASSERT_TRUE(found) << x << " " << y << " " << z;
                    EXPECT_EQ(found->isMirrored, scale < 0);
                    EXPECT_GT(found->scale.x, 0);
                    expectSame(matrixOf(*found), matrix);
                }
            }
        }
    }
}

TEST(ForeignPlacement, IsNothingForWhatShearsOrIsFlat) {
    glm::dmat4 sheared(1.0);
    sheared[1][0] = 0.01;
    EXPECT_FALSE(placementOf(sheared));
    EXPECT_FALSE(placementOf(glm::scale(glm::dmat4(1.0), glm::dvec3(1, 0, 1))));
}

}  // namespace
}  // namespace kaustik::scene::test
