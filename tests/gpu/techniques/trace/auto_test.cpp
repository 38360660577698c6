// SPDX-License-Identifier: MIT
// trace.auto: by the processor where the device is one, else on the device; the same hits, where
// water moves too, and what was made of the scene is kept while settings change.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "framework/numerics/cases/scene_text.h"
#include "framework/run/settings.h"
#include "framework/scene/shapes/height_field.h"
#include "techniques/tracing/bvh_rays.h"
#include "tests/gpu/fixture.h"
#include "tests/wavy_water.h"

namespace kaustik::test {
namespace {

scene::Scene ballOfGlass() {
    const numerics::CameraText camera{{0.0, 2.0, 3.0}, {0.0, 0.0, 0.0}, 45.0, 0.01};
    return numerics::makeScene(camera, numerics::sun({0.0, -1.0, 0.0}) +
                                           numerics::floorPlane("floor", "grey", 4, {0, 0, 0}) +
                                           numerics::object("ball", "sphere", "glass", {0, 0.7, 0},
                                                            "radius = 0.4\nsegments = 48"));
}

bool runs(const Frame& frame, const std::string& pass) {
    const auto& steps = frame.renderer().compiled().steps;
    return std::any_of(steps.begin(), steps.end(),
                       [&](const auto& step) { return step.name == pass; });
}

Frame rendered(const scene::Scene& scene, const std::string& tracer) {
    return {scene, 64, 48, {{"trace", tracer}, {"emit.photons", "64x64"}}, {}, false, "exact_rays"};
}

TEST(TraceAuto, TracesOnTheProcessorWhereItIsTheDevice) {
    const bool onProcessor = context().info().isSoftware && !lacksExactTracer();
    for (const scene::Scene& scene : {ballOfGlass(), sceneFromText(kWavyWater)}) {
        const Frame frame = rendered(scene, "auto");
        EXPECT_EQ(runs(frame, "trace.raytraced"), onProcessor) << scene.name;
        EXPECT_EQ(runs(frame, "trace.bvh"), !onProcessor) << scene.name;
        EXPECT_EQ(runs(frame, "geometry.embree"), onProcessor && scene.name == "wavy");
    }
}

// Its hierarchy is that of the first moment, fitted to the water of each later one.
TEST(TraceRaytraced, FindsWaterWhereItHasMovedTo) {
    if (lacksExactTracer()) GTEST_SKIP() << "built without Embree";
    const Registry registry = registerAll();
    scene::Scene scene = sceneFromText(kWavyWater);
    const auto settings = [&](const std::string& tracer) {
        RenderSettings made = run::makeSettings(
            {.technique = "exact_rays",
             .assignments = {{"trace", tracer, "test"}, {"emit.photons", "64x64", "test"}}},
            registry);
        run::setSize(made, {64, 48});
        return made;
    };
    const auto irradiance = [](Renderer& renderer) {
        renderer.build(Purpose::picture);
        gl::PassTimer untimed(gl::TimerMode::finish);
        renderer.renderFrame(untimed);
        return renderer.texture(renderer.outputs().caustic.irradiance).read();
    };
    const auto difference = [](const std::vector<float>& a, const std::vector<float>& b) {
        double sum = 0.0;
        double of = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            sum += std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
            of += std::abs(static_cast<double>(b[i]));
        }
        return sum / of;
    };
    Renderer moving(context(), registry, scene, settings("raytraced"));
    std::vector<float> before = irradiance(moving);
    for (const double time : {0.1, 7.3}) {
        scene::setTime(scene, time);
        moving.update(settings("raytraced"));
        const std::vector<float> found = irradiance(moving);
        Renderer byDevice(context(), registry, scene, settings("bvh"));
        EXPECT_LT(difference(found, irradiance(byDevice)), 1e-4) << time;
        EXPECT_GT(difference(found, before), 0.02) << time;
        before = found;
    }
}

TEST(TraceAuto, TakesTheDevicesWayWhereItIsAskedForWhatAGpuIsGiven) {
    const Registry registry = registerAll();
    const scene::Scene ball = ballOfGlass();
    RenderSettings settings =
        run::makeSettings({.technique = "exact_rays", .assignments = {}}, registry);
    run::setSize(settings, {32, 24});
    settings.asOnGpu = true;
    Renderer renderer(context(), registry, ball, settings);
    const graph::Compiled compiled = renderer.compile(Purpose::picture);
    EXPECT_TRUE(std::any_of(compiled.steps.begin(), compiled.steps.end(),
                            [](const auto& step) { return step.name == "trace.bvh"; }));
}

TEST(TraceAuto, MakesThePictureOfTheTracerThatItTakes) {
    const scene::Scene ball = ballOfGlass();
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
        "counting", {"By the hierarchy; counts.", "a test", ""}, {.reach = TracerReach::everything},
        std::function(
            [&](FrameBuilder& frame, const params::NoParams&, Photons photons, Surfaces surfaces) {
                static_cast<void>(frame.once<int>("of the frame", count(ofFrame)));
                static_cast<void>(frame.onceForScene<int>("of the scene", count(ofScene)));
                return hitsByBvh(frame, photons, surfaces.geometry);
            }));
    const scene::Scene scene = ballOfGlass();
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
