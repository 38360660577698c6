// SPDX-License-Identifier: MIT
// An OpenGL error fails a run with and without --gl-debug, which names the pass.
#include <gtest/gtest.h>

#include <cstdlib>

#include "framework/pipeline/frame_builder.h"
#include "techniques/register_all.h"
#include "tests/gpu/app/command_line.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::test {
namespace {

// A node that asks OpenGL for what there is not.
CausticMap enableNothing(FrameBuilder& frame, const params::NoParams&, Hits hits, Surfaces surfaces,
                         CausticMap before) {
    return frame.pass<CausticMap>(
        "reconstruct.wrong", "a test",
        [&](graph::PassSetup& setup, CausticMap& data) {
            data.maps = {FluxMap::deposit(setup,
                                          before.maps.empty() ? FluxMap{} : before.maps.front(),
                                          surfaces.eye, {}, "caustic.flux")};
            data.ledger = hits.incoming.ledger;
        },
        [](const CausticMap& data, gl::PassContext& context) {
            context.texture(data.maps.front().flux).clear({0, 0, 0, 0});
            glEnable(0xdead);
        });
}

class GlDebug : public testing::Test {
  protected:
    GlDebug() {
        ::setenv("KAUSTIK_GL_DEBUG", "0", 1);
        registry_.node<ReconstructStage>("wrong", {"An error.", "a test", "For this test."},
                                         &enableNothing);
        registry_.technique({"wrong", "An error.", "a test", {{"reconstruct", "wrong"}}, {}});
    }
    [[nodiscard]] std::string errorOf(std::vector<const char*> more) const {
        const TemporaryFolder folder;
        const std::string out = (folder / "out").string();
        std::vector<const char*> arguments = {
            "run",   "flat-water", "--technique", "wrong", "--size",
            "16x12", "--set",      "photons=8x8", "--set", "shadow.map.size=64",
            "--out", out.c_str()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const CommandResult result = runCommandLine(registry_, arguments);
        EXPECT_EQ(result.exitCode, 1);
        EXPECT_FALSE(std::filesystem::exists(folder / "out/report.json"));
        return result.err;
    }

  private:
    Registry registry_ = registerAll();
};

TEST_F(GlDebug, NamesThePassOfAnOpenGlError) {
    const std::string message = errorOf({"--gl-debug"});
    EXPECT_NE(message.find("OpenGL error in pass 'reconstruct.wrong': "), std::string::npos)
        << message;
    EXPECT_EQ(message.find("--gl-debug"), std::string::npos) << message;
    ::setenv("KAUSTIK_GL_DEBUG", "1", 1);
    EXPECT_EQ(errorOf({}), message);
}

TEST_F(GlDebug, WithoutItAnOpenGlErrorStillFailsTheRunAndSaysHowToFindItsPass) {
    const std::string message = errorOf({});
    EXPECT_NE(message.find("OpenGL error 0x500 in a frame"), std::string::npos) << message;
    EXPECT_NE(message.find("--gl-debug names the pass"), std::string::npos) << message;
}

}  // namespace
}  // namespace kaustik::test
