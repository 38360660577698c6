// SPDX-License-Identifier: MIT
// Runs a compiled graph on OpenGL: allocates its slots, wraps every pass in a debug group and a
// timer of its name, and hands the passes their textures and buffers.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "framework/gl/command.h"
#include "framework/gl/context.h"
#include "framework/gl/objects.h"
#include "framework/gl/program.h"
#include "framework/gl/timers.h"
#include "framework/graph/graph.h"

namespace kaustik::gl {

struct Attachment {
    const Texture* texture;
    int layer;
    bool isDepth;
};

class Executor;

// What an execute function is handed.
class PassContext : public graph::ExecuteContext {
  public:
    explicit PassContext(Executor& executor) : executor_(executor) {}

    [[nodiscard]] Command fullscreen(const std::string& fragmentShader);
    [[nodiscard]] Command compute(const std::string& computeShader);
    [[nodiscard]] Command shaders(std::vector<std::string> files);

    [[nodiscard]] const Texture& texture(const graph::ResourceRef& handle) const;
    [[nodiscard]] const Buffer& buffer(const graph::ResourceRef& handle) const;

    // For Command.
    [[nodiscard]] ProgramCache& programs();
    [[nodiscard]] GLuint framebuffer(const std::vector<Attachment>& attachments);
    [[nodiscard]] GLuint emptyVertexArray() const;

  private:
    Executor& executor_;
};

class Executor {
  public:
    Executor(Context& context, ProgramCache& programs);

    // Takes over a compiled graph; slots that match the last one's are kept.
    // Throws DeviceError when the device has no memory for it.
    void prepare(graph::Compiled compiled);
    [[nodiscard]] const graph::Compiled& compiled() const { return compiled_; }

    // Fills every texture with NaN and every buffer with all-ones bits before its first writer
    // runs, so that a test sees who reads what nobody wrote.
    void poisonTransients(bool poison) { poison_ = poison; }

    // Runs all passes once. Throws what a pass throws, and DeviceError for OpenGL errors. `goesOn`
    // is asked before each pass, by its number; where it says no, the frame ends there and has no
    // time, and the result is false.
    bool runFrame(PassTimer& timer, const std::function<bool(std::size_t)>& goesOn = {});

    [[nodiscard]] const Texture& texture(const graph::ResourceRef& handle) const;
    [[nodiscard]] const Buffer& buffer(const graph::ResourceRef& handle) const;

  private:
    friend class PassContext;
    struct Physical {
        Texture texture;
        Buffer buffer;
        graph::ResourceDesc desc;
    };
    void clearSlot(std::size_t slot, const graph::ClearValue& value) const;
    GLuint framebuffer(const std::vector<Attachment>& attachments);

    Context& context_;
    ProgramCache& programs_;
    graph::Compiled compiled_;
    std::vector<Physical> slots_;
    std::map<std::vector<std::tuple<GLuint, int, bool>>, FramebufferObject> framebuffers_;
    VertexArrayObject emptyVertexArray_;
    bool poison_ = false;
};

}  // namespace kaustik::gl
