// SPDX-License-Identifier: MIT
// OpenGL promises 65,535 workgroups along an axis, and drivers give no more along y and z.
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>

#include "framework/core/error.h"
#include "framework/gl/executor.h"
#include "tests/gpu/fixture.h"
#include "tests/gpu/strict/driver_limits.h"
#include "tests/gpu/strict/recording.h"

namespace kaustik::test {
namespace {

// Runs one pass; numbers of threads that went wrong of what it wrote, or the error.
std::string runOver(int count, const std::function<void(gl::Command&)>& dispatch) {
    struct Data {
        graph::Buffer<std::uint32_t> numbers;
    };
    const std::filesystem::path shader =
        std::filesystem::temp_directory_path() /
        ("kaustik-numbers-" + std::to_string(::getpid()) + ".comp");
    std::ofstream(shader)
        << "#include \"include/thread.glsl\"\n"
           "layout(std430) buffer Numbers { uint numbers[]; };\n"
           "uniform int count;\n"
           "void main() {\n"
           "    uint number = threadNumber();\n"
           "    if (number < uint(count)) atomicAdd(numbers[number], number + 1u);\n"
           "}\n";
    graph::Graph graph;
    const Data& data = graph.addPass<Data, gl::PassContext>(
        {"stage.counts", ""},
        [&](graph::PassSetup& setup, Data& made) {
            made.numbers = setup.storage(
                "Numbers",
                setup.createBuffer<std::uint32_t>("numbers", static_cast<std::size_t>(count)));
        },
        [&](const Data& made, gl::PassContext& pass) {
            pass.buffer(made.numbers).clear();
            gl::Command command = pass.compute(shader.string());
            command.set("count", count);
            dispatch(command);
        });
    graph.request(data.numbers);
    gl::ProgramCache programs;
    gl::Executor executor(context(), programs);
    executor.prepare(graph.compile());
    gl::PassTimer timer(gl::TimerMode::finish);
    std::string problem;
    try {
        executor.runFrame(timer);
        const auto numbers = executor.buffer(data.numbers).read<std::uint32_t>();
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < numbers.size(); ++i)
            wrong += numbers[i] == i + 1 ? 0 : 1;
        if (wrong > 0) problem = std::to_string(wrong) + " threads ran not once";
    } catch (const Error& error) {
        problem = error.what();
    }
    std::filesystem::remove(shader);
    return problem;
}

TEST(Dispatch, OverMoreNumbersThanWorkgroupsGoAlongAnAxisRunsEachOnce) {
    for (const int count : {1, 64, 65, 65535 * 64, 65535 * 64 + 1, 3 * 65535 * 64 - 7}) {
        SCOPED_TRACE(count);
        EXPECT_EQ(runOver(count, [&](gl::Command& command) { command.dispatchOver(count, 64); }),
                  "");
    }
}

TEST(Dispatch, OfMoreWorkgroupsThanThereMayBeNamesPassAndShader) {
    const std::string problem =
        runOver(64, [](gl::Command& command) { command.dispatch(1, 65536); });
    EXPECT_NE(problem.find("'stage.counts'"), std::string::npos) << problem;
    EXPECT_NE(problem.find("kaustik-numbers-"), std::string::npos) << problem;
    EXPECT_NE(problem.find("65535"), std::string::npos) << problem;
}

// 2048² vertices are 65,536 workgroups, and as many bytes as every device allows in a block.
TEST(Dispatch, OfWaterOf2047CellsASideFits) {
    const scene::Scene scene = sceneFromText(R"(
name = "sea"
[camera]
position = [0, 2, 3]
[[light]]
name = "sun"
type = "directional"
direction = [0, -1, 0]
irradiance = 100
[[material]]
name = "water"
type = "dielectric"
ior = 1.333
[[material]]
name = "grey"
type = "lambertian"
albedo = 0.5
[[object]]
name = "floor"
shape = "plane"
material = "grey"
size = [3, 3]
position = [0, -1, 0]
[[object]]
name = "sea"
shape = "water"
material = "water"
size = [2, 2]
cells = [2047, 2047]
waves = [{amplitude = 0.01, wavelength = 0.9}]
)");
    static_cast<void>(context());
    const Recording recording;
    const Frame frame(scene, 16, 12, {{"emit.photons", "16x16"}});
    const int most = driverLimit("MAX_COMPUTE_WORK_GROUP_COUNT", 0).least();
    for (const Recording::Dispatch& axis : recording.largest())
        EXPECT_LE(axis.groups, static_cast<GLuint>(most)) << axis.program;
    // Not one vertex is left out.
    EXPECT_GE(recording.largest()[0].groups * recording.largest()[1].groups, 65601u);
}

}  // namespace
}  // namespace kaustik::test
