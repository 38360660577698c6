// SPDX-License-Identifier: MIT
// 'kaustik run' on a device that is lost, in its own words: one sentence and exit code 3.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "framework/gl/context.h"
#include "techniques/register_all.h"
#include "tests/gpu/app/command_line.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::test {
namespace {

// So often OpenGL is asked whether the device was lost until it was.
int questionsLeft = 0;

TEST(LostDevice, EndsARunWithOneSentenceAndExitCode3) {
    {
        const auto context = gl::Context::createHeadless();
        if (!context->info().robust) GTEST_SKIP() << "this driver does not tell";
        static_cast<void>(glGetGraphicsResetStatus());  // libepoxy looks it up
    }
    const Registry registry = registerAll();
    const auto before = glGetGraphicsResetStatus;
    glGetGraphicsResetStatus = []() -> GLenum {
        return questionsLeft-- <= 0 ? GL_INNOCENT_CONTEXT_RESET : GL_NO_ERROR;
    };
    int kept = 0;
    int lost = 0;
    for (int questions = 0;; ++questions) {
        SCOPED_TRACE(questions);
        const TemporaryFolder folder;
        const std::string out = (folder / "out").string();
        questionsLeft = questions;
        const CommandResult result = runCommandLine(
            registry, {"run", "flat-water", "--size", "24x18", "--set", "photons=16x16", "--set",
                       "shadow.map.size=64", "--frames", "2", "--warmup", "0", "--device-model",
                       "1000GB/s", "--out", out.c_str()});
        if (result.exitCode == 0) break;
        ++lost;
        EXPECT_EQ(result.exitCode, 3) << result.err;
        EXPECT_EQ(result.out, "");
        EXPECT_EQ(result.err.find("kaustik: The device was lost "), 0u) << result.err;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "out/report.json"));
        const bool isKept = std::filesystem::exists(folder / "out/unfinished/report.json");
        EXPECT_EQ(result.err.find(out + "/unfinished.\n") != std::string::npos, isKept)
            << result.err;
        kept += isKept ? 1 : 0;
    }
    glGetGraphicsResetStatus = before;
    EXPECT_GT(kept, 3);
    EXPECT_GT(lost, kept) << "there is nothing to keep before the first frame";
}

}  // namespace
}  // namespace kaustik::test
