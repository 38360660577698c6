// SPDX-License-Identifier: MIT
#include "framework/gl/device_needs.h"

namespace kaustik::gl {

const std::vector<DeviceNeed>& deviceNeeds() {
#define KAUSTIK_LIMIT(name) #name, GL_##name
    static const std::vector<DeviceNeed> needs = {
        {"images in a compute shader", KAUSTIK_LIMIT(MAX_COMPUTE_IMAGE_UNIFORMS), 8},
        {"images in a fragment shader", KAUSTIK_LIMIT(MAX_FRAGMENT_IMAGE_UNIFORMS), 8},
        {"storage blocks in a compute shader", KAUSTIK_LIMIT(MAX_COMPUTE_SHADER_STORAGE_BLOCKS), 8},
        {"storage blocks in a vertex shader", KAUSTIK_LIMIT(MAX_VERTEX_SHADER_STORAGE_BLOCKS), 8},
        {"storage blocks in a geometry shader", KAUSTIK_LIMIT(MAX_GEOMETRY_SHADER_STORAGE_BLOCKS),
         8},
        {"storage blocks in a fragment shader", KAUSTIK_LIMIT(MAX_FRAGMENT_SHADER_STORAGE_BLOCKS),
         8},
        {"images, blocks and targets together", KAUSTIK_LIMIT(MAX_COMBINED_SHADER_OUTPUT_RESOURCES),
         16},
        {"textures in a shader", KAUSTIK_LIMIT(MAX_TEXTURE_IMAGE_UNITS), 16},
        {"threads in a work group", KAUSTIK_LIMIT(MAX_COMPUTE_WORK_GROUP_INVOCATIONS), 1024},
        {"bytes that a work group shares", KAUSTIK_LIMIT(MAX_COMPUTE_SHARED_MEMORY_SIZE), 32768},
    };
#undef KAUSTIK_LIMIT
    return needs;
}

int givenOf(const DeviceNeed& need) {
    GLint given = 0;
    glGetIntegerv(need.query, &given);
    return given;
}

}  // namespace kaustik::gl
