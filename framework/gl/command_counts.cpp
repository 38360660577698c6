// SPDX-License-Identifier: MIT
// What a command does to memory, where accesses are counted.
#include <array>
#include <cstdint>
#include <vector>

#include "framework/gl/access_counter.h"
#include "framework/gl/command.h"
#include "framework/gl/executor.h"

namespace kaustik::gl {

void Command::countCommand() {
    AccessCounter* const counter = context_.counter();
    if (counter == nullptr) return;
    counter->apply(freeStorageUnit_);
    counter->addCommand();
}

void Command::countTargets(const std::vector<Attachment>& attachments) {
    AccessCounter* const counter = context_.counter();
    if (counter == nullptr) return;
    std::vector<GLuint> colors;
    GLuint depth = 0;
    for (const Attachment& attachment : attachments) {
        if (attachment.isDepth) {
            depth = depthTest_ == DepthTest::none ? 0 : attachment.texture->id();
        } else {
            colors.push_back(attachment.texture->id());
        }
    }
    const bool isPlain = attachments.front().texture->desc().layers == 0;
    counter->bindTargets(colors, depth, isPlain ? 0 : attachments.front().layer,
                         blend_ != Blend::none);
}

void Command::countClear(const Target& target) {
    AccessCounter* const counter = context_.counter();
    // What is cleared within bounds is drawn to, as a rule.
    if (counter == nullptr || clearsInScissor_) return;
    const bool isWhole = target.texture->desc().layers == 0 || target.layer == kAllLayers;
    if (isWhole) {
        counter->addWholeTexture("cleared", target.texture->id());
    } else {
        counter->addLayer("cleared", target.texture->id(), target.layer);
    }
}

// Of the indexed draws that stand in a buffer.
void Command::countVertices(const Buffer& commands, std::size_t first, std::size_t count) {
    AccessCounter* const counter = context_.counter();
    if (counter == nullptr) return;
    std::vector<GLuint> words(5 * count);
    const std::size_t bytes = words.size() * sizeof(GLuint);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(commands.id(), static_cast<GLintptr>(first * 5 * sizeof(GLuint)),
                            static_cast<GLsizeiptr>(bytes), words.data());
    std::uint64_t indices = 0;
    for (std::size_t i = 0; i < words.size(); i += 5)
        indices += words[i + 1] > 0 ? words[i] : 0;
    counter->bindVertices(indices * sizeof(GLuint));
}

void Command::countIndirectGroups(GLuint commands, std::size_t offset) {
    AccessCounter* const counter = context_.counter();
    if (counter == nullptr) return;
    std::array<GLuint, 3> groupCounts{};
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(commands, static_cast<GLintptr>(offset), sizeof(groupCounts),
                            groupCounts.data());
    counter->addWorkGroups(std::uint64_t{groupCounts[0]} * groupCounts[1] * groupCounts[2]);
}

}  // namespace kaustik::gl
