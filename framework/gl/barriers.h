// SPDX-License-Identifier: MIT
// Which glMemoryBarrier a command needs. OpenGL orders everything by itself but what shaders store
// to images and storage blocks: who reads that, in whatever way, needs a barrier of its own kind
// before it, and a store needs one after whatever shaders did to the same memory (OpenGL 4.5,
// section 7.12.2). So each barrier is put before the command that needs it, with no bit more.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <vector>

namespace kaustik::gl {

// How a command uses a texture or buffer; the value is the barrier that it needs.
enum class Use : GLbitfield {
    fetch = GL_TEXTURE_FETCH_BARRIER_BIT,
    image = GL_SHADER_IMAGE_ACCESS_BARRIER_BIT,
    storage = GL_SHADER_STORAGE_BARRIER_BIT,
    vertices = GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT,
    drawCommands = GL_COMMAND_BARRIER_BIT,
    target = GL_FRAMEBUFFER_BARRIER_BIT,
    capture = GL_TRANSFORM_FEEDBACK_BARRIER_BIT,
    queryResult = GL_QUERY_BUFFER_BARRIER_BIT,
    updateTexture = GL_TEXTURE_UPDATE_BARRIER_BIT,  // cleared, copied or read by the processor
    updateBuffer = GL_BUFFER_UPDATE_BARRIER_BIT,
};

// What a command does to one piece of memory, by its number.
struct Access {
    std::size_t slot;
    Use use;
    bool stores = false;  // a shader may write: of images and storage blocks only
};

class Barriers {
  public:
    explicit Barriers(std::size_t slotCount = 0) : slots_(slotCount) {}

    // The bits of the barrier that must come before a command, 0 for none; the command and the
    // barrier are then taken as issued.
    [[nodiscard]] GLbitfield before(const std::vector<Access>& accesses);

  private:
    // The barriers that have not been issued since the slot's last store, and since shaders last
    // read or stored it.
    struct Slot {
        GLbitfield sinceStore = 0;
        GLbitfield sinceAccess = 0;
    };
    std::vector<Slot> slots_;
};

}  // namespace kaustik::gl
