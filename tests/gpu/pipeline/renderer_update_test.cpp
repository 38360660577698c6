// SPDX-License-Identifier: MIT
// A renderer that takes over changes must show what a new one would.
#include <gtest/gtest.h>

#include "framework/core/error.h"
#include "framework/scene/scene_edits.h"
#include "tests/gpu/fixture.h"
#include "tests/wavy_water.h"

namespace kaustik::test {
namespace {

class RendererUpdate : public testing::Test {
  protected:
    [[nodiscard]] RenderSettings settings(const std::string& tracer, int width) const {
        RenderSettings settings;
        settings.technique = registry_.findTechnique("screen_space_photons");
        settings.params = registry_.makeParams(settings.technique);
        settings.params.set("trace", tracer, "test");
        settings.params.set("emit.photons", "32x32", "test");
        settings.params.set("shadow.map.size", "64", "test");
        settings.width = width;
        settings.height = 48;
        return settings;
    }
    [[nodiscard]] static std::vector<float> picture(Renderer& renderer) {
        renderer.build(Purpose::picture);
        gl::PassTimer timer(gl::TimerMode::finish);
        EXPECT_TRUE(renderer.renderFrame(timer));
        return renderer.texture(renderer.outputs().picture.radiance).read();
    }

    Registry registry_ = registerAll();
};

TEST_F(RendererUpdate, ShowsTheSameBitsAsANewRenderer) {
    scene::Scene scene = sceneFromText(kWavyWater);
    Renderer updated(context(), registry_, scene, settings("march", 64));
    const std::vector<float> before = picture(updated);

    scene::SceneEdits edits;
    edits.camera = scene.camera;
    edits.camera->position = {0.4, 1.7, 0.9};
    edits.lights["sun"].direction = glm::dvec3(-0.3, -1.0, 0.2);
    edits.waves["water"] = {{0.03f, 0.4f, 30.0f, 1.0f, -1.0f}};
    edits.timeSeconds = 0.7;
    applyEdits(scene, edits);
    updated.update(settings("hierarchical", 80));
    Renderer fresh(context(), registry_, scene, settings("hierarchical", 80));
    const std::vector<float> after = picture(updated);
    EXPECT_EQ(after, picture(fresh));
    EXPECT_NE(after, before);

    // And back again.
    applyEdits(scene, scene::SceneEdits());
    scene = sceneFromText(kWavyWater);
    updated.update(settings("march", 64));
    EXPECT_EQ(picture(updated), before);
}

// As when another node is chosen than the one whose pass is switched off.
TEST_F(RendererUpdate, PassesThatNoFrameHasCanBeForgotten) {
    const scene::Scene scene = sceneFromText(kWavyWater);
    RenderSettings off = settings("march", 64);
    off.disabledPasses = {"shadow.lookup", "compose.direct", "trace.lines"};
    Renderer renderer(context(), registry_, scene, off);
    EXPECT_THROW(renderer.build(Purpose::picture), ConfigError);
    EXPECT_EQ(renderer.forgetAbsentPasses(), std::vector<std::string>{"trace.lines"});
    EXPECT_TRUE(renderer.forgetAbsentPasses().empty());
    off.disabledPasses.erase("trace.lines");
    Renderer expected(context(), registry_, scene, off);
    EXPECT_EQ(picture(renderer), picture(expected));
    EXPECT_EQ(renderer.settings().disabledPasses, off.disabledPasses);
}

TEST_F(RendererUpdate, AFrameThatIsEndedEarlyHasNoTimeAndTheNextOneIsWhole) {
    const scene::Scene scene = sceneFromText(kWavyWater);
    Renderer renderer(context(), registry_, scene, settings("march", 64));
    const std::vector<float> whole = picture(renderer);
    gl::PassTimer timer(gl::TimerMode::finish);
    std::size_t requested = 0;
    EXPECT_FALSE(renderer.renderFrame(timer, [&](std::size_t step) {
        requested = step;
        return step < 3;
    }));
    EXPECT_EQ(requested, 3u);
    EXPECT_TRUE(timer.takeFinished(true).empty());
    EXPECT_TRUE(renderer.renderFrame(timer));
    EXPECT_EQ(timer.takeFinished(true).size(), 1u);
    EXPECT_EQ(renderer.texture(renderer.outputs().picture.radiance).read(), whole);
}

}  // namespace
}  // namespace kaustik::test
