// SPDX-License-Identifier: MIT
// The table, and where its numbers are written:
//
// promised: OpenGL 4.5 core profile, tables 23.55 to 23.72.
// a: Malt pull request 175 (github.com/bnpr/Malt/pull/175), all limits of NVIDIA's Linux driver.
// b: yuzu pull request 4092 (github.com/yuzu-emu/yuzu/pull/4092): 8 image units with NVIDIA's and
//    Intel's own drivers; RPCS3 pull request 12676 (github.com/RPCS3/rpcs3/pull/12676) says the
//    same of NVIDIA's compute shaders.
// c: Mesa's radeonsi, src/gallium/drivers/radeonsi/si_state.h: SI_NUM_SHADER_BUFFERS 16, of which
//    src/mesa/state_tracker/st_extensions.c keeps half for atomic counters; SI_NUM_IMAGES 16;
//    SI_NUM_SAMPLERS 32; SI_NUM_CONST_BUFFERS 16, the first for uniforms outside of blocks. "Too
//    many compute shader storage blocks (9/8)" (github.com/servo/pathfinder/issues/373). All stages
//    together are the sum of what st_extensions.c adds up. Newer ones give more: 32 buffers.
// d: xemu issue 84 (github.com/xemu-project/xemu/issues/84), Intel HD 4600 with Intel's own driver.
// e: Mesa's iris, src/gallium/drivers/iris/iris_context.h: IRIS_MAX_SSBOS 16, IRIS_MAX_IMAGES 64,
//    added up as in c.
// f: asked of llvmpipe, Mesa 22.3.6.
// g: asked of an H100 by the driver 580.159.04. An image counts there where it is declared, used or
//    not (error C7624).
//
// AMD's Windows driver is not among them: no source of its limits was found, and the program needs
// EGL without a window, which that one has not.
#include "tests/gpu/strict/driver_limits.h"

#include <algorithm>
#include <cassert>

namespace kaustik::test {
namespace {

constexpr int kUnknown = DriverLimit::kUnknown;

// Its name and its number.
#define LIMIT(name) #name, GL_##name

}  // namespace

int DriverLimit::least() const {
    int least = given.front() == kUnknown ? promised : given.front();
    for (const int value : given)
        least = std::min(least, value == kUnknown ? promised : value);
    return least;
}

const std::vector<DriverLimit>& driverLimits() {
    static const std::vector<DriverLimit> table = {
        // name, promised, {NVIDIA, AMD, Intel, llvmpipe}, sources, axis
        {LIMIT(MAX_COMPUTE_IMAGE_UNIFORMS), 8, {8, 16, 8, 32}, "a b c f g"},
        {LIMIT(MAX_VERTEX_IMAGE_UNIFORMS), 0, {kUnknown, 16, kUnknown, 32}, "c f"},
        {LIMIT(MAX_GEOMETRY_IMAGE_UNIFORMS), 0, {kUnknown, 16, kUnknown, 32}, "c f"},
        {LIMIT(MAX_FRAGMENT_IMAGE_UNIFORMS), 8, {8, 16, 8, 32}, "b c f"},
        {LIMIT(MAX_COMBINED_IMAGE_UNIFORMS), 8, {kUnknown, 96, kUnknown, 192}, "c f"},
        {LIMIT(MAX_IMAGE_UNITS), 8, {8, kUnknown, 8, 192}, "b f"},

        {LIMIT(MAX_COMPUTE_SHADER_STORAGE_BLOCKS), 8, {16, 8, 16, 16}, "a c d f"},
        {LIMIT(MAX_VERTEX_SHADER_STORAGE_BLOCKS), 0, {16, 8, 16, 16}, "a c d f"},
        {LIMIT(MAX_GEOMETRY_SHADER_STORAGE_BLOCKS), 0, {16, 8, 16, 16}, "a c d f"},
        {LIMIT(MAX_FRAGMENT_SHADER_STORAGE_BLOCKS), 8, {16, 8, 16, 16}, "a c d f"},
        {LIMIT(MAX_COMBINED_SHADER_STORAGE_BLOCKS), 8, {96, 40, 80, 80}, "a c d f"},
        {LIMIT(MAX_SHADER_STORAGE_BUFFER_BINDINGS), 8, {kUnknown, 40, 16, 80}, "c d f"},

        // Images, storage blocks and what a fragment shader writes, of all stages.
        {LIMIT(MAX_COMBINED_SHADER_OUTPUT_RESOURCES), 8, {16, 144, 472, 280}, "a c e f"},
        {LIMIT(MAX_DRAW_BUFFERS), 8, {8, kUnknown, kUnknown, 8}, "a f"},

        {LIMIT(MAX_COMPUTE_UNIFORM_BLOCKS), 14, {14, 15, kUnknown, 15}, "a c f"},
        {LIMIT(MAX_VERTEX_UNIFORM_BLOCKS), 14, {14, 15, kUnknown, 15}, "a c f"},
        {LIMIT(MAX_GEOMETRY_UNIFORM_BLOCKS), 14, {14, 15, kUnknown, 15}, "a c f"},
        {LIMIT(MAX_FRAGMENT_UNIFORM_BLOCKS), 14, {14, 15, kUnknown, 15}, "a c f"},
        {LIMIT(MAX_COMBINED_UNIFORM_BLOCKS), 70, {84, 90, kUnknown, 90}, "a c f"},

        {LIMIT(MAX_COMPUTE_TEXTURE_IMAGE_UNITS), 16, {32, 32, kUnknown, 32}, "a c f"},
        {LIMIT(MAX_VERTEX_TEXTURE_IMAGE_UNITS), 16, {32, 32, kUnknown, 32}, "a c f"},
        {LIMIT(MAX_GEOMETRY_TEXTURE_IMAGE_UNITS), 16, {32, 32, kUnknown, 32}, "a c f"},
        {LIMIT(MAX_TEXTURE_IMAGE_UNITS), 16, {32, 32, kUnknown, 32}, "a c f"},
        {LIMIT(MAX_COMBINED_TEXTURE_IMAGE_UNITS), 96, {192, 192, kUnknown, 192}, "a c f"},

        {LIMIT(MAX_COMPUTE_UNIFORM_COMPONENTS), 512, {2048, kUnknown, kUnknown, 16384}, "a f"},
        {LIMIT(MAX_VERTEX_UNIFORM_COMPONENTS), 1024, {kUnknown, kUnknown, kUnknown, 16384}, "f"},
        {LIMIT(MAX_GEOMETRY_UNIFORM_COMPONENTS), 512, {kUnknown, kUnknown, kUnknown, 16384}, "f"},
        {LIMIT(MAX_FRAGMENT_UNIFORM_COMPONENTS), 1024, {kUnknown, kUnknown, kUnknown, 16384}, "f"},

        {LIMIT(MAX_COMPUTE_WORK_GROUP_COUNT), 65535, {kUnknown, kUnknown, kUnknown, 65535}, "f", 0},
        {LIMIT(MAX_COMPUTE_WORK_GROUP_SIZE), 1024, {kUnknown, kUnknown, kUnknown, 1024}, "f", 0},
        {LIMIT(MAX_COMPUTE_WORK_GROUP_SIZE), 1024, {kUnknown, kUnknown, kUnknown, 1024}, "f", 1},
        {LIMIT(MAX_COMPUTE_WORK_GROUP_SIZE), 64, {kUnknown, kUnknown, kUnknown, 1024}, "f", 2},
        {LIMIT(MAX_COMPUTE_WORK_GROUP_INVOCATIONS), 1024, {1024, kUnknown, kUnknown, 1024}, "a f"},
        {LIMIT(MAX_COMPUTE_SHARED_MEMORY_SIZE), 32768, {49152, kUnknown, kUnknown, 32768}, "a f"},
    };
    return table;
}

const DriverLimit& driverLimit(const std::string& name, int axis) {
    const std::vector<DriverLimit>& table = driverLimits();
    const auto row = std::find_if(table.begin(), table.end(), [&](const DriverLimit& limit) {
        return limit.name == name && limit.axis == axis;
    });
    assert(row != table.end());
    return *row;
}

}  // namespace kaustik::test
