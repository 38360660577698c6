// SPDX-License-Identifier: MIT
#include "framework/gl/loop_words.h"

#include <algorithm>
#include <utility>

namespace kaustik::gl {
namespace {

constexpr std::size_t kWordBytes = sizeof(std::uint32_t);
constexpr std::size_t kWordsAtStart = 64;
constexpr GLbitfield kMapping = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;

}  // namespace

LoopWords::~LoopWords() {
    for (const Slot& slot : ring_) {
        if (slot.fence != nullptr) glDeleteSync(slot.fence);
    }
}

// What was copied in this frame stays.
void LoopWords::enlarge(Slot& slot) {
    const std::size_t capacity = std::max(2 * slot.capacity, kWordsAtStart);
    const auto bytes = static_cast<GLsizeiptr>(capacity * kWordBytes);
    GLuint id = 0;
    glCreateBuffers(1, &id);
    Object<detail::deleteBuffer> larger(id);
    glNamedBufferStorage(id, bytes, nullptr, kMapping);
    if (slot.count > 0) {
        glCopyNamedBufferSubData(slot.buffer.id(), id, 0, 0,
                                 static_cast<GLsizeiptr>(slot.count * kWordBytes));
    }
    slot.buffer = std::move(larger);
    slot.capacity = capacity;
    slot.words = static_cast<const std::uint32_t*>(glMapNamedBufferRange(id, 0, bytes, kMapping));
}

void LoopWords::copy(const Buffer& from, std::size_t word) {
    Slot& slot = ring_[frame_ % kFramesInFlight];
    // Of four frames ago: the device is done with it, or so far behind that waiting is right.
    read(slot, true);
    if (slot.count == slot.capacity) enlarge(slot);
    glCopyNamedBufferSubData(from.id(), slot.buffer.id(), static_cast<GLintptr>(word * kWordBytes),
                             static_cast<GLintptr>(slot.count * kWordBytes), kWordBytes);
    ++slot.count;
}

void LoopWords::endFrame() {
    Slot& slot = ring_[frame_ % kFramesInFlight];
    if (slot.count == 0 || slot.fence != nullptr) return;
    slot.fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    ++frame_;
}

void LoopWords::read(Slot& slot, bool waits) {
    if (slot.fence == nullptr) return;
    const GLuint64 forever = GL_TIMEOUT_IGNORED;
    GLenum state = glClientWaitSync(slot.fence, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
    if (state == GL_TIMEOUT_EXPIRED && waits)
        state = glClientWaitSync(slot.fence, GL_SYNC_FLUSH_COMMANDS_BIT, forever);
    if (state == GL_TIMEOUT_EXPIRED) return;
    const bool isAtEnd =
        slot.words != nullptr && std::all_of(slot.words, slot.words + slot.count,
                                             [](std::uint32_t word) { return word == 0; });
    cutShort_ += isAtEnd ? 0 : 1;
    glDeleteSync(std::exchange(slot.fence, nullptr));
    slot.count = 0;
}

std::size_t LoopWords::takeCutShort(bool waits) {
    for (Slot& slot : ring_)
        read(slot, waits);
    return std::exchange(cutShort_, 0);
}

}  // namespace kaustik::gl
