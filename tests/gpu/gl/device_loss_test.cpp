// SPDX-License-Identifier: MIT
// A device that is lost ends a frame with one sentence, in whichever pass that happens, and once it
// is back the same frame is rendered.
#include <epoxy/gl.h>

#include <set>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/scene/files/scene_file.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

// Says at its n-th call, counted from 0, that the device was lost. libepoxy calls the driver by a
// pointer that is replaced here.
int callsLeft = 0;
GLenum lostAtLast() {
    return callsLeft-- == 0 ? GL_GUILTY_CONTEXT_RESET : GL_NO_ERROR;
}

class LossAfter {
  public:
    explicit LossAfter(int calls) {
        static_cast<void>(glGetGraphicsResetStatus());  // libepoxy looks it up
        before_ = glGetGraphicsResetStatus;
        callsLeft = calls;
        glGetGraphicsResetStatus = &lostAtLast;
    }
    ~LossAfter() { glGetGraphicsResetStatus = before_; }
    LossAfter(const LossAfter&) = delete;
    LossAfter& operator=(const LossAfter&) = delete;

  private:
    PFNGLGETGRAPHICSRESETSTATUSPROC before_;
};

TEST(DeviceLoss, InAnyPassOfAFrameIsOneSentenceThatNamesIt) {
    if (!context().info().robust) GTEST_SKIP() << "this driver does not tell";
    const scene::Scene scene =
        scene::loadSceneFile(projectRoot() / "experiments/scenes/glass-sphere.toml");
    Frame frame(scene, 32, 24, {{"emit.photons", "16x16"}});
    Renderer& renderer = frame.renderer();
    const std::vector<float> whole = renderer.texture(renderer.outputs().caustic.irradiance).read();
    const std::size_t steps = renderer.compiled().steps.size();
    ASSERT_GT(steps, 10u);
    std::set<std::string> named;
    for (std::size_t step = 0; step < steps; ++step) {
        const LossAfter loss(static_cast<int>(step));
        gl::PassTimer timer(gl::TimerMode::finish);
        try {
            renderer.renderFrame(timer);
            ADD_FAILURE() << "no error in step " << step;
        } catch (const DeviceError& error) {
            const std::string message = error.what();
            EXPECT_EQ(error.exitCode(), 3) << message;
            EXPECT_NE(message.find("The device was lost in pass '"), std::string::npos) << message;
            named.insert(message);
        }
    }
    EXPECT_GT(named.size(), 10u);
    gl::PassTimer timer(gl::TimerMode::finish);
    renderer.renderFrame(timer);
    EXPECT_EQ(renderer.texture(renderer.outputs().caustic.irradiance).read(), whole);
}

}  // namespace
}  // namespace kaustik::test
