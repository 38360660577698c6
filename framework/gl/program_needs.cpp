// SPDX-License-Identifier: MIT
#include "framework/gl/program_needs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <regex>
#include <string>

namespace kaustik::gl {
namespace {

bool isBetween(GLenum type, GLenum first, GLenum last) {
    return type >= first && type <= last;
}

bool isImage(GLenum type) {
    return isBetween(type, GL_IMAGE_1D, GL_UNSIGNED_INT_IMAGE_2D_MULTISAMPLE_ARRAY);
}

bool isSampler(GLenum type) {
    // Three vectors have their numbers among those of samplers.
    return isBetween(type, GL_SAMPLER_1D, GL_SAMPLER_2D_RECT_SHADOW) ||
           (isBetween(type, GL_SAMPLER_1D_ARRAY, GL_UNSIGNED_INT_SAMPLER_BUFFER) &&
            !isBetween(type, GL_UNSIGNED_INT_VEC2, GL_UNSIGNED_INT_VEC4)) ||
           isBetween(type, GL_SAMPLER_CUBE_MAP_ARRAY, GL_UNSIGNED_INT_SAMPLER_CUBE_MAP_ARRAY) ||
           isBetween(type, GL_SAMPLER_2D_MULTISAMPLE, GL_UNSIGNED_INT_SAMPLER_2D_MULTISAMPLE_ARRAY);
}

// A stage: by which property a resource says that it uses it, and the limits on what it uses.
struct StageLimits {
    GLenum referencedBy;
    GLenum blocks;
    GLenum images;
};
constexpr std::array<StageLimits, 4> kStages = {{
    {GL_REFERENCED_BY_VERTEX_SHADER, GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS,
     GL_MAX_VERTEX_IMAGE_UNIFORMS},
    {GL_REFERENCED_BY_GEOMETRY_SHADER, GL_MAX_GEOMETRY_SHADER_STORAGE_BLOCKS,
     GL_MAX_GEOMETRY_IMAGE_UNIFORMS},
    {GL_REFERENCED_BY_FRAGMENT_SHADER, GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS,
     GL_MAX_FRAGMENT_IMAGE_UNIFORMS},
    {GL_REFERENCED_BY_COMPUTE_SHADER, GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS,
     GL_MAX_COMPUTE_IMAGE_UNIFORMS},
}};

constexpr std::size_t kComputeStage = 3;

std::size_t numberOf(const StageText& stage) {
    const std::string& file = stage.file;
    return file.ends_with(".vert")   ? 0
           : file.ends_with(".geom") ? 1
           : file.ends_with(".frag") ? 2
                                     : kComputeStage;
}

std::string blockName(GLuint program, GLuint index) {
    std::array<char, 256> text{};
    GLsizei length = 0;
    glGetProgramResourceName(program, GL_SHADER_STORAGE_BLOCK, index,
                             static_cast<GLsizei>(text.size()), &length, text.data());
    const std::string name(text.data(), static_cast<std::size_t>(length));
    return name.substr(0, name.find('['));
}

bool declaresBlock(const std::string& text, const std::string& name) {
    return std::regex_search(text, std::regex("\\bbuffer\\s+" + name + "\\b"));
}

// What each active resource of an interface says of itself.
template <std::size_t count, class Take>
void forEachResource(GLuint program, GLenum interface, const std::array<GLenum, count>& properties,
                     Take take) {
    GLint resources = 0;
    glGetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &resources);
    for (GLint i = 0; i < resources; ++i) {
        std::array<GLint, count> values{};
        glGetProgramResourceiv(program, interface, static_cast<GLuint>(i),
                               static_cast<GLsizei>(count), properties.data(),
                               static_cast<GLsizei>(count), nullptr, values.data());
        take(values);
    }
}

}  // namespace

std::map<GLenum, int> takenBy(GLuint program, const std::vector<StageText>& stages) {
    std::map<GLenum, int> taken;
    std::array<int, kStages.size()> samplers{};
    int outputs = 0;
    constexpr std::array<GLenum, 6> kOfUniforms = {kStages[0].referencedBy,
                                                   kStages[1].referencedBy,
                                                   kStages[2].referencedBy,
                                                   kStages[3].referencedBy,
                                                   GL_TYPE,
                                                   GL_ARRAY_SIZE};
    forEachResource(program, GL_UNIFORM, kOfUniforms, [&](const auto& values) {
        const auto type = static_cast<GLenum>(values[4]);
        const int count = values[5];
        outputs += isImage(type) ? count : 0;
        for (std::size_t stage = 0; stage < kStages.size(); ++stage) {
            if (values[stage] == GL_FALSE) continue;
            if (isImage(type)) taken[kStages[stage].images] += count;
            if (isSampler(type)) samplers[stage] += count;
        }
    });
    for (const StageText& stage : stages)
        taken[kStages[numberOf(stage)].blocks] = 0;
    constexpr std::array<GLenum, 4> kOfBlocks = {kStages[0].referencedBy, kStages[1].referencedBy,
                                                 kStages[2].referencedBy, kStages[3].referencedBy};
    GLuint index = 0;
    forEachResource(program, GL_SHADER_STORAGE_BLOCK, kOfBlocks, [&](const auto& values) {
        ++outputs;
        const std::string name = blockName(program, index++);
        const bool isForgotten = std::count(values.begin(), values.end(), GL_FALSE) == 4;
        for (const StageText& stage : stages) {
            const std::size_t number = numberOf(stage);
            const bool isUsed =
                isForgotten ? declaresBlock(stage.text, name) : values[number] != GL_FALSE;
            taken[kStages[number].blocks] += isUsed ? 1 : 0;
        }
    });
    // Those that go to targets; gl_FragDepth has no location.
    constexpr std::array<GLenum, 2> kOfOutputs = {GL_REFERENCED_BY_FRAGMENT_SHADER, GL_LOCATION};
    forEachResource(program, GL_PROGRAM_OUTPUT, kOfOutputs, [&](const auto& values) {
        outputs += values[0] != GL_FALSE && values[1] >= 0 ? 1 : 0;
    });
    taken[GL_MAX_COMBINED_SHADER_OUTPUT_RESOURCES] = outputs;
    taken[GL_MAX_TEXTURE_IMAGE_UNITS] = *std::max_element(samplers.begin(), samplers.end());
    if (numberOf(stages.front()) == kComputeStage) {
        std::array<GLint, 3> group{};
        glGetProgramiv(program, GL_COMPUTE_WORK_GROUP_SIZE, group.data());
        taken[GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS] = group[0] * group[1] * group[2];
    }
    return taken;
}

std::vector<std::string> lackedBy(const std::map<GLenum, int>& taken, const Given& given) {
    std::vector<std::string> lacked;
    for (const DeviceNeed& need : deviceNeeds()) {
        const auto known = taken.find(need.query);
        if (known == taken.end()) continue;
        const int here = given(need);
        if (known->second > here)
            lacked.push_back(fmt::format("{} {}, of {} here", known->second, need.what, here));
    }
    return lacked;
}

}  // namespace kaustik::gl
