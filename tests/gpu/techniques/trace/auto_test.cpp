// SPDX-License-Identifier: MIT
// trace.auto: by the processor where the device is one and nothing moves, else on the device; the
// same hits, and what was made of the scene is kept while settings change.
#include <algorithm>
#include <functional>
#include <memory>
#include <string>

#include "framework/run/settings.h"
#include "techniques/tracing/bvh_rays.h"
#include "tests/gpu/fixture.h"
#include "tests/wavy_water.h"

namespace kaustik::test {
namespace {

constexpr const char* kBall = R"(
name = "ball"
[camera]
position = [0, 2, 3]
target = [0, 0, 0]
vertical_fov_degrees = 45
[[light]]
name = "sun"
type = "directional"
direction = [0, -1, 0]
irradiance = 1000
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[material]]
name = "grey"
type = "lambertian"
albedo = 0.5
[[object]]
name = "floor"
shape = "plane"
material = "grey"
size = [4, 4]
[[object]]
name = "ball"
shape = "sphere"
material = "glass"
position = [0, 0.7, 0]
radius = 0.4
segments = 48
)";

bool runs(const Frame& frame, const std::string& pass) {
    const auto& steps = frame.renderer().compiled().steps;
    return std::any_of(steps.begin(), steps.end(),
                       [&](const auto& step) { return step.name == pass; });
}

Frame rendered(const scene::Scene& scene, const std::string& tracer) {
    return {scene, 64, 48, {{"trace", tracer}, {"emit.photons", "64x64"}}, {}, false, "exact_rays"};
}

TEST(TraceAuto, TracesStillScenesWhereItIsSoonerAndMovingOnesOnTheDevice) {
    const bool onProcessor = context().info().isSoftware && !lacksExactTracer();
    const scene::Scene ball = sceneFromText(kBall);
    const Frame still = rendered(ball, "auto");
    EXPECT_EQ(runs(still, "trace.raytraced"), onProcessor);
    EXPECT_EQ(runs(still, "trace.bvh"), !onProcessor);
    const scene::Scene water = sceneFromText(kWavyWater);
    const Frame moving = rendered(water, "auto");
    EXPECT_TRUE(runs(moving, "trace.bvh"));
    EXPECT_FALSE(runs(moving, "trace.raytraced"));
}

TEST(TraceAuto, TakesTheDevicesWayWhereItIsAskedForWhatAGpuIsGiven) {
    const Registry registry = registerAll();
    const scene::Scene ball = sceneFromText(kBall);
    RenderSettings settings = run::makeSettings({.technique = "exact_rays"}, registry);
    run::setSize(settings, {32, 24});
    settings.asOnGpu = true;
    Renderer renderer(context(), registry, ball, settings);
    const graph::Compiled compiled = renderer.compile(Purpose::picture);
    EXPECT_TRUE(std::any_of(compiled.steps.begin(), compiled.steps.end(),
                            [](const auto& step) { return step.name == "trace.bvh"; }));
}

TEST(TraceAuto, MakesThePictureOfTheTracerThatItTakes) {
    const scene::Scene ball = sceneFromText(kBall);
    const Frame chosen = rendered(ball, "auto");
    const Frame named = rendered(ball, runs(chosen, "trace.bvh") ? "bvh" : "raytraced");
    EXPECT_EQ(chosen.causticIrradiance().values, named.causticIrradiance().values);
}

TEST(FrameBuilder, KeepsWhatNodesMakeOfTheSceneWhenSettingsChange) {
    int ofFrame = 0;
    int ofScene = 0;
    const auto count = [](int& counter) {
        return [&counter] { return std::make_shared<int>(++counter); };
    };
    Registry registry = registerAll();
    registry.node<TraceStage>(
        "counting", {"By the hierarchy; counts.", "a test"}, {.reach = TracerReach::everything},
        std::function(
            [&](FrameBuilder& frame, const params::NoParams&, Photons photons, Surfaces surfaces) {
                static_cast<void>(frame.once<int>("of the frame", count(ofFrame)));
                static_cast<void>(frame.onceForScene<int>("of the scene", count(ofScene)));
                return hitsByBvh(frame, photons, surfaces.geometry);
            }));
    const scene::Scene scene = sceneFromText(kBall);
    RenderSettings settings = run::makeSettings(
        {.technique = "exact_rays", .assignments = {{"trace", "counting", "test"}}}, registry);
    run::setSize(settings, {32, 24});
    Renderer renderer(context(), registry, scene, settings);
    renderer.build(Purpose::picture);
    EXPECT_EQ(ofFrame, 1);
    EXPECT_EQ(ofScene, 1);
    settings.params.set("emit.photons", "32x32", "test");
    renderer.update(settings);
    renderer.build(Purpose::picture);
    EXPECT_EQ(ofFrame, 2);
    EXPECT_EQ(ofScene, 1);
}

}  // namespace
}  // namespace kaustik::test
