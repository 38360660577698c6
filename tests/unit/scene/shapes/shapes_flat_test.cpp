// SPDX-License-Identifier: MIT
// Flat-faced shapes: everything is exact up to the rounding of positions to 32 bits.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "framework/core/error.h"
#include "framework/scene/shapes/shapes.h"
#include "tests/unit/scene/shapes/shapes_measures.h"

namespace kaustik::scene {
namespace {

// Positions are rounded to 2^-24 of their size; sums of a few of those stay below this.
constexpr double kRounding = 1e-6;

// Every edge is as long in uv as in space.
void expectUvInMeters(const Mesh& mesh) {
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t from = triangle[corner];
            const std::uint32_t to = triangle[(corner + 1) % 3];
            EXPECT_NEAR(glm::length(mesh.uvs[to] - mesh.uvs[from]),
                        glm::length(mesh.positions[to] - mesh.positions[from]), kRounding);
        }
    }
}

TEST(Plane, FacesUpAndIsAsLargeAsAskedFor) {
    const Mesh plane = makePlane({{4.0, 3.0}, {5, 2}});
    test::expectSound(plane);
    expectUvInMeters(plane);
    EXPECT_EQ(plane.triangles.size(), 20u);
    EXPECT_EQ(plane.positions.size(), 18u);
    EXPECT_NEAR(test::area(plane), 12.0, 12.0 * kRounding);
    EXPECT_FALSE(plane.closed);
    for (const glm::vec3& normal : plane.normals)
        EXPECT_EQ(normal, glm::vec3(0.0f, 1.0f, 0.0f));
    EXPECT_EQ(plane.positions.front(), glm::vec3(-2.0f, 0.0f, -1.5f));
    EXPECT_EQ(plane.positions.back(), glm::vec3(2.0f, 0.0f, 1.5f));
}

TEST(Box, IsClosedAndHasTheVolumeOfItsSides) {
    const Mesh box = makeBox({{1.0, 2.0, 3.0}});
    test::expectSound(box);
    expectUvInMeters(box);
    EXPECT_EQ(box.positions.size(), 24u);
    EXPECT_EQ(box.triangles.size(), 12u);
    EXPECT_TRUE(box.closed);
    EXPECT_TRUE(test::everyEdgeHasTwoTriangles(box));
    EXPECT_NEAR(test::volume(box), 6.0, 6.0 * kRounding);
    EXPECT_NEAR(test::area(box), 22.0, 22.0 * kRounding);
}

TEST(Box, TurnedInwardsShowsItsFacesToTheInside) {
    BoxShape shape{{1.0, 2.0, 3.0}};
    shape.inward = true;
    const Mesh room = makeBox(shape);
    test::expectSound(room);
    EXPECT_NEAR(test::volume(room), -6.0, 6.0 * kRounding);
    for (std::size_t i = 0; i < room.positions.size(); ++i) {
        EXPECT_LT(glm::dot(room.positions[i], room.normals[i]), 0.0f);
    }
}

TEST(Box, LeavesOutExactlyTheOpenFaces) {
    const std::array<glm::vec3, 6> outward{
        {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};
    for (const BoxFace face : {minusX, plusX, minusY, plusY, minusZ, plusZ}) {
        BoxShape shape;
        shape.open[face] = true;
        const Mesh box = makeBox(shape);
        EXPECT_FALSE(box.closed);
        EXPECT_EQ(box.triangles.size(), 10u);
        for (const glm::vec3& normal : box.normals)
            EXPECT_NE(normal, outward[face]);
    }
    BoxShape nothing;
    nothing.open.fill(true);
    EXPECT_THROW((void)makeBox(nothing), ConfigError);
}

TEST(Prism, HasItsApexAngleAndVolume) {
    for (const double apex : {20.0, 60.0, 90.0, 150.0}) {
        const Mesh prism = makePrism({apex, 0.8, 2.0});
        test::expectSound(prism);
        EXPECT_TRUE(prism.closed);
        EXPECT_TRUE(test::everyEdgeHasTwoTriangles(prism));
        EXPECT_EQ(prism.triangles.size(), 8u);
        const double expected = 0.8 * 0.8 * std::tan(glm::radians(apex) / 2.0) * 2.0;
        EXPECT_NEAR(test::volume(prism), expected, expected * kRounding);
        // The two faces at the apex: their outward normals enclose 180° minus the apex angle.
        const double cosine =
            glm::dot(glm::dvec3(prism.normals.at(0)), glm::dvec3(prism.normals.at(4)));
        EXPECT_NEAR(cosine, -std::cos(glm::radians(apex)), kRounding);
    }
}

TEST(FlatShapes, RejectWhatTheyCannotBe) {
    const double nan = std::nan("");
    EXPECT_THROW((void)makePlane({{0.0, 1.0}, {1, 1}}), ConfigError);
    EXPECT_THROW((void)makePlane({{1.0, nan}, {1, 1}}), ConfigError);
    EXPECT_THROW((void)makePlane({{1.0, 1.0}, {0, 1}}), ConfigError);
    EXPECT_THROW((void)makePlane({{1.0, 1.0}, {1, kMaximumCells + 1}}), ConfigError);
    EXPECT_THROW((void)makeBox({{1.0, -1.0, 1.0}}), ConfigError);
    EXPECT_THROW((void)makePrism({0.0, 1.0, 1.0}), ConfigError);
    EXPECT_THROW((void)makePrism({180.0, 1.0, 1.0}), ConfigError);
    EXPECT_THROW((void)makePrism({nan, 1.0, 1.0}), ConfigError);
}

}  // namespace
}  // namespace kaustik::scene
