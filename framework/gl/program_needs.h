// SPDX-License-Identifier: MIT
// How much a linked program takes of what devices have little of, by OpenGL's own account of it.
#pragma once

#include <epoxy/gl.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "framework/gl/device_needs.h"

namespace kaustik::gl {

// A stage of a program: its file and its expanded text (loadShaderText).
struct StageText {
    std::string file;
    std::string text;
};

// By the query of a DeviceNeed. Memory that a work group shares is not among them: OpenGL does not
// tell it of a program, and does not link one that takes too much. Where a driver has forgotten
// which stage a block is of, it counts for all whose text has its name: Mesa's (22.3) does so of a
// vertex shader's block that is indexed by a variable.
[[nodiscard]] std::map<GLenum, int> takenBy(GLuint program, const std::vector<StageText>& stages);

// What a device gives of each; givenOf() of the current context's, or of one that is imagined.
using Given = std::function<int(const DeviceNeed& need)>;

// What a program takes more of than the device gives, as "9 storage blocks in a compute shader, of
// 8 here".
[[nodiscard]] std::vector<std::string> lackedBy(const std::map<GLenum, int>& taken,
                                                const Given& given = givenOf);

}  // namespace kaustik::gl
