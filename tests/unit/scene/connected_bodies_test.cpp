// SPDX-License-Identifier: MIT
#include "framework/scene/connected_bodies.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "framework/scene/shapes/shapes.h"

namespace kaustik::scene {
namespace {

using Groups = std::vector<std::vector<std::size_t>>;

// Balls of glass with a radius of 1 and a ball of another size.
class ConnectedBodies : public ::testing::Test {
  protected:
    Scene scene;
    void SetUp() override {
        scene.meshes.push_back(makeSphere({}));
        Material glass;
        glass.kind = MaterialKind::dielectric;
        scene.materials.push_back(glass);
        Material wall;
        wall.kind = MaterialKind::lambertian;
        scene.materials.push_back(wall);
        const Bounds box = objectBounds(scene, {"ball", 0, 0, glm::dmat4(1.0)});
        unit_ = 2.0 / (box.maximum.x - box.minimum.x);
    }
    void add(const glm::dvec3& center, double radius, std::uint32_t material = 0) {
        const glm::dmat4 toWorld =
            glm::scale(glm::translate(glm::dmat4(1.0), center), glm::dvec3(radius * unit_));
        scene.objects.push_back({"ball", 0, material, toWorld});
    }

  private:
    double unit_ = 1.0;
};

TEST_F(ConnectedBodies, AreApartWhereOnlyTheirBoxesOverlap) {
    add({0, 0, 0}, 1.0);
    add({1.3, 1.3, 1.3}, 1.0);  // 2.25 away
    EXPECT_EQ(connectedBodies(scene), (Groups{{0}, {1}}));
}

TEST_F(ConnectedBodies, AreOneWhereTheyMeet) {
    add({0, 0, 0}, 1.0);
    add({1.1, 1.1, 1.1}, 1.0);  // 1.9 away
    EXPECT_EQ(connectedBodies(scene), (Groups{{0, 1}}));
}

TEST_F(ConnectedBodies, AreOneWhereOneLiesInTheOther) {
    add({0, 0, 0}, 1.0);
    add({0.2, 0.1, 0}, 0.5);
    EXPECT_EQ(connectedBodies(scene), (Groups{{0, 1}}));
    std::swap(scene.objects[0], scene.objects[1]);
    EXPECT_EQ(connectedBodies(scene), (Groups{{0, 1}}));
}

TEST_F(ConnectedBodies, AreJoinedByWhatMeetsBoth) {
    add({0, 0, 0}, 1.0);
    add({9, 0, 0}, 1.0);
    add({3, 0, 0}, 1.0);
    add({1.5, 0, 0}, 0.7);
    EXPECT_EQ(connectedBodies(scene), (Groups{{0, 2, 3}, {1}}));
}

TEST_F(ConnectedBodies, AreDielectricsAlone) {
    add({0, 0, 0}, 1.0);
    add({0.5, 0, 0}, 1.0, 1);
    EXPECT_EQ(connectedBodies(scene), (Groups{{0}}));
    EXPECT_EQ(connectedBodies({}), Groups{});
}

}  // namespace
}  // namespace kaustik::scene
