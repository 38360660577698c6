// SPDX-License-Identifier: MIT
// What a linked program takes, counted by hand, and what is said of a device that gives less.
#include "framework/gl/program_needs.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "framework/gl/program.h"
#include "framework/run/program_account.h"
#include "framework/run/settings.h"
#include "tests/gpu/fixture.h"
#include "tests/wavy_water.h"

namespace kaustik::test {
namespace {
namespace fs = std::filesystem;

class ProgramNeeds : public testing::Test {
  protected:
    ProgramNeeds()
        : folder_(fs::temp_directory_path() / ("kaustik-needs-" + std::to_string(::getpid()))) {
        fs::create_directories(folder_);
        static_cast<void>(context());
    }
    ~ProgramNeeds() override { fs::remove_all(folder_); }
    [[nodiscard]] std::map<GLenum, int> taken(const std::vector<std::string>& names,
                                              const std::vector<std::string>& texts) const {
        gl::ProgramKey key;
        std::vector<gl::StageText> stages;
        for (std::size_t i = 0; i < names.size(); ++i) {
            std::ofstream(folder_ / names[i]) << texts[i];
            key.files.push_back((folder_ / names[i]).string());
            stages.push_back({names[i], texts[i]});
        }
        const gl::Program program(key);
        return gl::takenBy(program.id(), stages);
    }
    fs::path folder_;
};

TEST_F(ProgramNeeds, AreCountedInComputeShaders) {
    const auto counts =
        taken({"a.comp"}, {"layout(local_size_x = 8, local_size_y = 4) in;\n"
                           "layout(r32f) uniform image2D one;\n"
                           "layout(r32ui) uniform uimage2DArray other;\n"
                           "uniform sampler2D from;\n"
                           "uniform usampler2DArray fromWords[2];\n"
                           "uniform uvec2 notOne;\n"
                           "layout(std430) buffer A { uint a[]; };\n"
                           "layout(std430) buffer B { uint b[]; };\n"
                           "layout(std430) buffer C { uint c[]; };\n"
                           "void main() {\n"
                           "    vec4 read = texelFetch(from, ivec2(notOne), 0);\n"
                           "    read += vec4(texelFetch(fromWords[a[1] & 1u], ivec3(0), 0));\n"
                           "    imageStore(one, ivec2(0), read);\n"
                           "    imageStore(other, ivec3(0), uvec4(b[0]));\n"
                           "    c[0] = a[0];\n"
                           "}\n"});
    EXPECT_EQ(counts.at(GL_MAX_COMPUTE_IMAGE_UNIFORMS), 2);
    EXPECT_EQ(counts.at(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS), 3);
    EXPECT_EQ(counts.at(GL_MAX_COMBINED_SHADER_OUTPUT_RESOURCES), 5);
    EXPECT_EQ(counts.at(GL_MAX_TEXTURE_IMAGE_UNITS), 3);
    EXPECT_EQ(counts.at(GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS), 32);
    EXPECT_FALSE(counts.contains(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS));
}

TEST_F(ProgramNeeds, AreCountedByStage) {
    const auto counts =
        taken({"a.vert", "a.frag"}, {"layout(std430) buffer A { vec4 a[]; };\n"
                                     "layout(std430) buffer B { vec4 b[]; };\n"
                                     "void main() { gl_Position = a[gl_VertexID] + b[0]; }\n",
                                     "layout(std430) buffer B { vec4 b[]; };\n"
                                     "layout(rgba32f) uniform image2D picture;\n"
                                     "layout(location = 0) out vec4 first;\n"
                                     "layout(location = 1) out vec4 second;\n"
                                     "void main() {\n"
                                     "    first = imageLoad(picture, ivec2(0));\n"
                                     "    second = b[0];\n"
                                     "    gl_FragDepth = 0.5;\n"
                                     "}\n"});
    EXPECT_EQ(counts.at(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS), 2);
    EXPECT_EQ(counts.at(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS), 1);
    EXPECT_EQ(counts.at(GL_MAX_FRAGMENT_IMAGE_UNIFORMS), 1);
    // Two blocks, an image, two targets.
    EXPECT_EQ(counts.at(GL_MAX_COMBINED_SHADER_OUTPUT_RESOURCES), 5);
    EXPECT_FALSE(counts.contains(GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS));
}

TEST_F(ProgramNeeds, ThatADeviceLacksAreNamedWithBothNumbers) {
    const std::map<GLenum, int> counts = {{GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, 4},
                                          {GL_MAX_COMPUTE_IMAGE_UNIFORMS, 8}};
    const auto given = [](const gl::DeviceNeed& need) {
        return need.query == GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS ? 0 : 8;
    };
    EXPECT_EQ(gl::lackedBy(counts, given),
              std::vector<std::string>{"4 storage blocks in a vertex shader, of 0 here"});
    EXPECT_TRUE(gl::lackedBy(counts, [](const gl::DeviceNeed&) { return 8; }).empty());
}

// On a device that gives no storage blocks to vertex shaders, which OpenGL allows: the passes that
// draw triangles are named, and no other.
TEST_F(ProgramNeeds, OfAFrameAreKnownBeforeItIsRendered) {
    const Registry registry = registerAll();
    const scene::Scene scene = sceneFromText(kWavyWater);
    RenderSettings settings = run::makeSettings(
        {.technique = "screen_space_photons", .assignments = {{"emit.photons", "16x16", "test"}}},
        registry);
    run::setSize(settings, {32, 24});
    Renderer renderer(context(), registry, scene, settings);
    renderer.build(Purpose::picture);
    run::ProgramAccount here;
    here.add(renderer);
    EXPECT_GT(here.count(), 15u);
    EXPECT_TRUE(here.problems().empty()) << here.text("a frame");
    EXPECT_NE(here.text("a frame").find(" programs of a frame fit this device"), std::string::npos);

    run::ProgramAccount elsewhere([](const gl::DeviceNeed& need) {
        return need.query == GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS ? 0 : gl::givenOf(need);
    });
    elsewhere.add(renderer);
    EXPECT_EQ(elsewhere.count(), here.count());
    bool namesReceivers = false;
    for (const std::string& problem : elsewhere.problems()) {
        EXPECT_NE(problem.find(".vert"), std::string::npos) << problem;
        EXPECT_NE(problem.find("in a vertex shader, of 0 here"), std::string::npos) << problem;
        namesReceivers = namesReceivers || problem.find("(eye.receivers)") != std::string::npos;
    }
    EXPECT_TRUE(namesReceivers) << elsewhere.text("a frame");
    EXPECT_LT(elsewhere.problems().size(), here.count());
}

}  // namespace
}  // namespace kaustik::test
