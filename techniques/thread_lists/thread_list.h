// SPDX-License-Identifier: MIT
// A list of work for compute threads that a shader makes on the device, so that those alone run
// that have any: a software rasteriser lets all threads of a group go the longest of their ways,
// and a GPU does so for each warp. In the buffer: include/thread_list.glsl, then a number each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "framework/gl/command.h"
#include "framework/graph/graph.h"

namespace kaustik {

// As shaders/include/thread_list.glsl has it.
struct ThreadListHeader {
    std::uint32_t count, groupsX, groupsY, groupsZ;
};

class ThreadList {
  public:
    // Declares a pass' own buffer, the storage block `block` of its shaders.
    static ThreadList create(graph::PassSetup& setup, const char* block, const std::string& name,
                             std::size_t capacity);
    // Nothing is listed.
    void clear(gl::PassContext& context) const;
    // All is listed: commands may be dispatched.
    void close(gl::PassContext& context) const;
    void dispatchOver(gl::Command command) const;

    // What holds it, to be read back: its header first.
    [[nodiscard]] const graph::Buffer<std::uint32_t>& buffer() const { return list_; }
    // The numbers in what was read.
    [[nodiscard]] static std::span<const std::uint32_t> listedIn(
        std::span<const std::uint32_t> buffer);

  private:
    void countGroups(gl::PassContext& context, int isListed) const;
    graph::Buffer<std::uint32_t> list_;
};

}  // namespace kaustik
