// SPDX-License-Identifier: MIT
// What every program of the project keeps to, of which OpenGL promises little. The test
// StrictCompiler holds the programs of all mixtures to these numbers.
#pragma once

#include <epoxy/gl.h>

#include <string>
#include <vector>

namespace kaustik::gl {

struct DeviceNeed {
    std::string what;  // "storage blocks in a compute shader"
    std::string name;  // as OpenGL has it, without GL_
    GLenum query = 0;
    int needed = 0;  // at most
};
[[nodiscard]] const std::vector<DeviceNeed>& deviceNeeds();

// What the current context's device gives of it.
[[nodiscard]] int givenOf(const DeviceNeed& need);

}  // namespace kaustik::gl
