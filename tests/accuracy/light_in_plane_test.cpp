// SPDX-License-Identifier: MIT
// A lamp that lies exactly in a surface: to be lit at grazing incidence is not to be lit, and what
// is not lit throws no shadow. So the surface neither takes nor stops any of its light.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "framework/reference/light_tracing.h"
#include "tests/accuracy/path_fixture.h"

namespace kaustik::reference {
namespace {

constexpr double kIntensity = 10.0;  // W/sr
const glm::dvec3 kBall(0.0, 1.0, 0.0);
constexpr double kRadius = 0.5;

scene::Material chalk() {
    scene::Material material;
    material.albedo = glm::vec3(0.5f);
    return material;
}

// A glass ball over a plane of that material through the origin, and a lamp.
scene::Scene ballOver(const scene::Material& material, const glm::dvec3& lamp) {
    scene::Scene scene = sceneOf(scene::makePlane({{8.0, 8.0}, {3, 3}}), material);
    scene::SphereShape ball;
    ball.radius = kRadius;
    ball.segments = 256;
    addObject(scene, scene::makeSphere(ball), glass(1.5), kBall);
    scene::Light light;
    light.kind = scene::LightKind::point;
    light.position = lamp;
    light.power = glm::vec3(static_cast<float>(kIntensity));
    scene.lights.push_back(light);
    scene.camera.position = {0.0, 2.0, 4.0};
    return scene;
}

double emittedWatts(const scene::Scene& scene) {
    const EmbreeScene embree(scene);
    LightTraceSettings settings;
    settings.width = settings.height = 2;
    settings.photonsPerBatch = 1u << 16;
    PixelSums sums = makeLightTraceSums(embree, settings);
    RunOptions options;
    options.stop.batches = 4;
    lightTrace(embree, settings, options, sums);
    return sums.energy().watts[transport::kAccountEmitted];
}

// What a lamp sends to the ball: by its solid angle.
double wattsToBall(const glm::dvec3& lamp) {
    const double sine = kRadius / glm::length(kBall - lamp);
    return kIntensity * 2.0 * std::numbers::pi * (1.0 - std::sqrt(1.0 - sine * sine));
}

// The ball has 256 segments: its outline is smaller than a circle by 1e-4. One photon in each cell
// of a grid of 2^16 over the cone around the ball: of the 800 cells on its rim each is right or
// wrong by half a cell at most, 800 of them by the root of that, 2e-4 of all; the mean of four by
// half as much.
constexpr double kTolerance = 5e-4;

TEST(LightInAPlane, ShinesOnWhatIsAboveIt) {
    // Along an edge of the plane's triangles, inside of one, and where many meet.
    for (const glm::dvec3& lamp :
         {glm::dvec3(1, 0, 1), glm::dvec3(1.1, 0, 0.3), glm::dvec3(4.0 / 3.0, 0, -4.0 / 3.0)}) {
        const double expected = wattsToBall(lamp);
        EXPECT_NEAR(emittedWatts(ballOver(chalk(), lamp)), expected, kTolerance * expected);
    }
}

TEST(LightInAPlane, ShinesOnWhatIsAboveItWhereRoundingPutsItBelow) {
    // Turned and moved, the plane's corners are rounded to 32 bits, and the lamp is not in it any
    // more.
    scene::Scene scene = ballOver(chalk(), {1.0, 0.0, 1.0});
    for (int step = 1; step <= 5; ++step) {
        const double angle = 1.2 * step;
        const glm::dmat4 turn = glm::translate(glm::dmat4(1.0), glm::dvec3(3.7, -2.1, 5.3)) *
                                glm::rotate(glm::dmat4(1.0), angle, glm::dvec3(0.36, 0.48, 0.8));
        scene::Scene turned = scene;
        for (scene::Object& object : turned.objects)
            object.toWorld = turn * object.toWorld;
        turned.lights[0].position = glm::dvec3(turn * glm::dvec4(scene.lights[0].position, 1.0));
        const double expected = wattsToBall(scene.lights[0].position);
        EXPECT_NEAR(emittedWatts(turned), expected, kTolerance * expected) << "turned by " << angle;
    }
}

TEST(LightInAPlane, SendsNothingThroughASpecularSurfaceThatItLiesIn) {
    // Half of its light goes down, along the plane there is none: only the ball takes any.
    const glm::dvec3 lamp(1.0, 0.0, 1.0);
    const double expected = wattsToBall(lamp);
    // The cells are those of all directions here, of which the ball takes 1400: 130 are on its rim,
    // and right or wrong by half a cell, in the mean of four batches 2e-3 of all. Three times that.
    EXPECT_NEAR(emittedWatts(ballOver(mirror(), lamp)), expected, 6e-3 * expected);
}

TEST(LightInAPlane, IsBlockedWhenItLiesBelow) {
    // A tenth of a millimetre, in a scene of 8 m: a hundred times what rounding makes of it.
    EXPECT_EQ(emittedWatts(ballOver(chalk(), {1.0, -1e-4, 1.0})), 0.0);
    const double expected = wattsToBall({1.0, 1e-4, 1.0});
    EXPECT_NEAR(emittedWatts(ballOver(chalk(), {1.0, 1e-4, 1.0})), expected, kTolerance * expected);
}

}  // namespace
}  // namespace kaustik::reference
