// SPDX-License-Identifier: MIT
// Flat faces are found from triangles alone: all of a plane, a box or a room, none of what is
// curved, has a hole, or lies on itself.
#include "framework/scene/flat_faces.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "framework/scene/shapes/height_field.h"
#include "framework/scene/shapes/shapes.h"

namespace kaustik::scene {
namespace {

double areaOf(const Parallelogram& face) {
    return glm::length(glm::cross(face.edgeU, face.edgeV));
}
glm::dvec3 middleOf(const Parallelogram& face) {
    return face.corner + 0.5 * (face.edgeU + face.edgeV);
}

TEST(FlatFaces, APlaneIsOneWhateverItsCells) {
    for (const unsigned cells : {1u, 2u, 7u, 40u}) {
        const std::vector<Parallelogram> faces = flatFaces(makePlane({{3.0, 2.0}, {cells, cells}}));
        ASSERT_EQ(faces.size(), 1u) << cells;
        EXPECT_NEAR(areaOf(faces[0]), 6.0, 1e-6);
        EXPECT_LT(glm::length(middleOf(faces[0])), 1e-6);
        EXPECT_LT(glm::length(faces[0].normal - glm::dvec3(0, 1, 0)), 1e-12);
    }
}

TEST(FlatFaces, ABoxHasThoseThatAreNotLeftOutAndTheirSides) {
    for (const bool inward : {false, true}) {
        BoxShape shape{{4.0, 1.5, 3.0}, inward, {}};
        EXPECT_EQ(flatFaces(makeBox(shape)).size(), 6u);
        shape.open[plusY] = true;
        const std::vector<Parallelogram> faces = flatFaces(makeBox(shape));
        ASSERT_EQ(faces.size(), 5u);
        double area = 0.0;
        for (const Parallelogram& face : faces) {
            area += areaOf(face);
            EXPECT_EQ(glm::dot(face.normal, middleOf(face)) < 0.0, inward);
        }
        EXPECT_NEAR(area, 12.0 + 2.0 * 6.0 + 2.0 * 4.5, 1e-5);
    }
}

TEST(FlatFaces, ABoxOfEightVerticesHasSix) {
    Mesh box;
    for (unsigned i = 0; i < 8; ++i)
        box.positions.emplace_back(i & 1u, (i >> 1u) & 1u, (i >> 2u) & 1u);
    box.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    EXPECT_EQ(flatFaces(box).size(), 6u);
}

TEST(FlatFaces, WhatIsCurvedOrHasAnotherOutlineHasNone) {
    EXPECT_TRUE(flatFaces(makeSphere({})).empty());
    EXPECT_TRUE(flatFaces(makeSphere({0.5, 1024})).empty());
    EXPECT_TRUE(flatFaces(makeCylinder({})).empty());
    EXPECT_TRUE(flatFaces(makePrism({})).empty());
    EXPECT_TRUE(flatFaces(Mesh{}).empty());
}

TEST(FlatFaces, APlaneWithAHoleOrATriangleTwiceIsNone) {
    Mesh plane = makePlane({{1.0, 1.0}, {4, 4}});
    Mesh twice = plane;
    twice.triangles.push_back(twice.triangles[5]);
    EXPECT_TRUE(flatFaces(twice).empty());
    plane.triangles.erase(plane.triangles.begin() + 10);
    EXPECT_TRUE(flatFaces(plane).empty());
}

TEST(FlatFaces, TrianglesWithoutAnAreaAreNotAsked) {
    Mesh plane = makePlane({{1.0, 1.0}, {2, 2}});
    plane.triangles.push_back({0, 1, 1});
    EXPECT_EQ(flatFaces(plane).size(), 1u);
}

TEST(FlatFaces, WaterIsFlatWhileItIsStill) {
    HeightField field{{4.0f, 3.0f}, {16, 12}, {}};
    EXPECT_EQ(flatFaces(makeHeightField(field, 0.0)).size(), 1u);
    field.waves.push_back({});
    EXPECT_TRUE(flatFaces(makeHeightField(field, 0.0)).empty());
}

TEST(FlatReceivers, LieWhereTheirObjectsDoAndTheOthersAreNamed) {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[1].kind = MaterialKind::dielectric;
    scene.meshes = {makePlane({{2.0, 2.0}, {1, 1}}), makeSphere({})};
    // Moved far away, sheared, and mirrored, which turns the winding round but not the outside.
    glm::dmat4 toWorld = glm::translate(glm::dmat4(1.0), glm::dvec3(1e5, 3.0, 0.0));
    toWorld[2] = glm::dvec4(0.5, 0.0, -2.0, 0.0);
    scene.objects = {{"floor", 0, 0, toWorld},
                     {"ball", 1, 0, glm::dmat4(1.0)},
                     {"water", 0, 1, glm::dmat4(1.0)}};
    const FlatReceivers flat = flatReceivers(scene);
    ASSERT_EQ(flat.faces.size(), 1u);
    EXPECT_EQ(flat.faces[0].material, 0u);
    EXPECT_LT(glm::length(middleOf(flat.faces[0].shape) - glm::dvec3(1e5, 3.0, 0.0)), 1e-6);
    EXPECT_NEAR(areaOf(flat.faces[0].shape), 8.0, 1e-6);
    EXPECT_LT(glm::length(flat.faces[0].shape.normal - glm::dvec3(0, 1, 0)), 1e-12);
    EXPECT_EQ(flat.isFlat, (std::vector<bool>{true, false, false}));
    EXPECT_EQ(flat.others, std::vector<std::string>{"ball"});
}

}  // namespace
}  // namespace kaustik::scene
