// SPDX-License-Identifier: MIT
// Every program of every mixture is GLSL 4.50 to a strict compiler, and takes no more of anything
// than each vendor's drivers give. Drivers forgive what others refuse: that a program runs here
// says little of elsewhere.
#include "tests/gpu/strict/strict_compiler.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <map>

#include "framework/core/files.h"
#include "framework/gl/device_needs.h"
#include "framework/run/settings.h"
#include "framework/scene/files/scene_file.h"
#include "tests/gpu/fixture.h"
#include "tests/gpu/strict/driver_limits.h"
#include "tests/gpu/strict/mixtures.h"

namespace kaustik::test {
namespace {

std::string joined(const std::vector<std::string>& texts) {
    return fmt::format("{}", fmt::join(texts, "; "));
}

class StrictCompiler : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_EQ(joined(missingTools()), "")
            << "is not installed; experiments/install_packages.sh does that";
    }
    // What is wrong with a compute shader.
    static std::string problemOf(const std::string& text) {
        const CheckedProgram checked =
            checkPrograms({{{"comp", "#version 450 core\n" + text}}}).front();
        return checked.problem + joined(beyondDriverLimits(checked.stages));
    }
    // All programs that were recorded; their names.
    static std::vector<std::string> expectTaken(const Recording& recording) {
        std::map<RecordedProgram, std::string> distinct;
        for (const auto& [program, name] : recording.programs())
            distinct.emplace(withoutUnused(program), name);
        std::vector<RecordedProgram> programs;
        std::vector<std::string> names;
        for (const auto& [program, name] : distinct) {
            programs.push_back(program);
            names.push_back(name);
        }
        const std::vector<CheckedProgram> checked = checkPrograms(programs);
        for (std::size_t i = 0; i < programs.size(); ++i) {
            EXPECT_EQ(checked[i].problem, "") << names[i];
            EXPECT_EQ(joined(beyondDriverLimits(checked[i].stages)), "") << names[i];
        }
        return names;
    }
};

TEST_F(StrictCompiler, TakesEveryProgramOfEveryMixture) {
    static_cast<void>(context());
    const Recording recording;
    const MixtureCount count = renderMixtures();
    const std::vector<std::string> names = expectTaken(recording);
    std::cout << fmt::format("  {} programs of {} mixtures ({} refused); {} pairs, {} never meet\n",
                             names.size(), count.frames, count.refused, count.pairs, count.apart);
}

// Those of a tile of the screen and of a frame that takes its hits, by tracer.
TEST_F(StrictCompiler, TakesTheProgramsOfTiles) {
    const Registry registry = registerAll();
    const scene::Scene scene = scene::loadScene("glass-sphere");
    static_cast<void>(context());
    const Recording recording;
    for (const char* tracer :
         {"hierarchical", "hierarchical_compute", "march", "march_compute", "lines"}) {
        RenderSettings settings = run::makeSettings(
            {.technique = "screen_space_photons",
             .assignments = {{"trace", tracer, "test"}, {"emit.photons", "32x32", "test"}}},
            registry);
        run::setSize(settings, {64, 48});
        const ScreenTile tile = withBorder(tileOf({1, 2}, 64, 48), 4, 64, 48);
        settings.tiles = std::make_shared<TileFrame>(TileFrame{{RoundOfHits{}}, tile});
        Renderer renderer(context(), registry, scene, settings);
        renderer.build(Purpose::picture);
        gl::PassTimer timer(gl::TimerMode::finish);
        renderer.renderFrame(timer);
    }
    const std::vector<std::string> names = expectTaken(recording);
    EXPECT_NE(std::find(names.begin(), names.end(), "framework/tile_hits.comp"), names.end());
}

// By all that sends photons on, and onto the screen, a light's map and a cube's.
TEST_F(StrictCompiler, TakesTheProgramsOfLampsWhoseLightIsWidened) {
    const Registry registry = registerAll();
    const scene::Scene scene =
        scene::loadScene((projectRoot() / "experiments/lamps/panel_ball.toml").string());
    static_cast<void>(context());
    const Recording recording;
    for (const char* technique : {"exact_rays", "caustic_triangles"}) {
        for (const char* specular : {"interface", "split", "two_interfaces", "deferred"}) {
            RenderSettings settings = run::makeSettings(
                {.technique = technique,
                 .assignments = {{"specular", specular, "test"},
                                 {"reconstruct.triangles.light_size", "widened", "test"},
                                 {"emit.photons", "32x32", "test"}}},
                registry);
            run::setSize(settings, {64, 48});
            settings.asOnGpu = true;
            Renderer renderer(context(), registry, scene, settings);
            renderer.build(Purpose::picture);
            gl::PassTimer timer(gl::TimerMode::finish);
            renderer.renderFrame(timer);
        }
    }
    const std::vector<std::string> names = expectTaken(recording);
    EXPECT_NE(std::find(names.begin(), names.end(), "emit/light_spread.comp"), names.end());
}

TEST_F(StrictCompiler, TakesAPlainProgram) {
    EXPECT_EQ(problemOf("layout(local_size_x = 64) in;\n"
                        "layout(rgba32f) uniform image2D picture;\n"
                        "uniform float gain;\n"
                        "shared float sums[64];\n"
                        "void main() {\n"
                        "    sums[gl_LocalInvocationIndex] = gain;\n"
                        "    imageStore(picture, ivec2(0), vec4(sums[0]));\n"
                        "}\n"),
              "");
}

// What this machine's driver compiles and others do not.
TEST_F(StrictCompiler, RefusesAMemberCalledAsAMethod) {
    const std::string problem = problemOf(
        "layout(local_size_x = 1) in;\n"
        "layout(std430) buffer Lengths { float lengths[]; };\n"
        "struct Way { float length; };\n"
        "void main() {\n"
        "    Way way = Way(1.0);\n"
        "    lengths[0] = way.length;\n"
        "}\n");
    EXPECT_NE(problem.find("lengths[0] = way.length;"), std::string::npos) << problem;
}

TEST_F(StrictCompiler, CountsWhatAProgramTakes) {
    const auto withBlocks = [](int count) {
        std::string blocks;
        std::string uses;
        for (int i = 0; i < count; ++i) {
            blocks += fmt::format("layout(std430) buffer B{0} {{ uint b{0}[]; }};\n", i);
            uses += fmt::format("    b{}[0] = 1u;\n", i);
        }
        // What is declared and not used takes nothing.
        return "layout(local_size_x = 1) in;\n" + blocks +
               "layout(std430) buffer Unused { uint unused[]; };\nvoid main() {\n" + uses + "}\n";
    };
    EXPECT_EQ(problemOf(withBlocks(8)), "");
    EXPECT_EQ(problemOf(withBlocks(9)),
              "MAX_COMPUTE_SHADER_STORAGE_BLOCKS is 8 where 9 are used; "
              "MAX_SHADER_STORAGE_BUFFER_BINDINGS is 8 where 9 are used");
    EXPECT_EQ(problemOf("layout(local_size_x = 1) in;\n"
                        "layout(r32f) writeonly uniform image2D pictures[9];\n"
                        "uniform int which;\n"
                        "void main() { imageStore(pictures[which], ivec2(0), vec4(1)); }\n"),
              "MAX_COMPUTE_IMAGE_UNIFORMS is 8 where 9 are used; "
              "MAX_IMAGE_UNITS is 8 where 9 are used; "
              "MAX_COMBINED_IMAGE_UNIFORMS is 8 where 9 are used");
    // An image that is declared counts all the same (driver_limits.cpp, g).
    const auto withUnusedImages = [](int count) {
        std::string images;
        for (int i = 0; i < count; ++i)
            images += fmt::format("layout(r32f) writeonly uniform image2D unused{};\n", i);
        return "layout(local_size_x = 1) in;\nuniform sampler2D from;\n"
               "layout(r32f) writeonly uniform image2D picture;\n" +
               images +
               "void main() { imageStore(picture, ivec2(0), texelFetch(from, ivec2(0), 0)); }\n";
    };
    EXPECT_EQ(problemOf(withUnusedImages(7)), "");
    EXPECT_EQ(problemOf(withUnusedImages(8)),
              "MAX_COMPUTE_IMAGE_UNIFORMS is 8 where 9 are used; "
              "MAX_IMAGE_UNITS is 8 where 9 are used; "
              "MAX_COMBINED_IMAGE_UNIFORMS is 8 where 9 are used");
    EXPECT_EQ(problemOf("layout(local_size_x = 32, local_size_y = 32) in;\n"
                        "shared vec4 sums[2049];\n"
                        "layout(std430) buffer Sums { vec4 sum; };\n"
                        "void main() {\n"
                        "    sums[gl_LocalInvocationIndex] = sum;\n"
                        "    sum = sums[0];\n"
                        "}\n"),
              "MAX_COMPUTE_SHARED_MEMORY_SIZE is 32768 where 32784 are used");
}

// So that 'kaustik check' says of a device what these tests hold the programs to.
TEST(DriverLimits, AreWhatCheckAsksDevicesFor) {
    for (const gl::DeviceNeed& need : gl::deviceNeeds())
        EXPECT_EQ(need.needed, driverLimit(need.name).least()) << need.name;
}

// Where a device gives less, the table is wrong, or the device one of which it does not know.
TEST(DriverLimits, AreNoMoreThanThisDeviceGives) {
    static_cast<void>(context());
    for (const DriverLimit& limit : driverLimits()) {
        GLint given = -1;
        if (limit.axis < 0) {
            glGetIntegerv(limit.query, &given);
        } else {
            glGetIntegeri_v(limit.query, static_cast<GLuint>(limit.axis), &given);
        }
        EXPECT_GE(given, limit.least()) << limit.name;
    }
}

}  // namespace
}  // namespace kaustik::test
