// SPDX-License-Identifier: MIT
// Runs a compiled graph on OpenGL: allocates its slots, wraps every pass in a debug group and a
// timer of its name, and hands the passes their textures and buffers.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "framework/gl/barriers.h"
#include "framework/gl/command.h"
#include "framework/gl/context.h"
#include "framework/gl/loop_words.h"
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

class AccessCounter;
class Executor;

// What an execute function is handed. Whatever it asks for must be what its pass has declared; else
// a GraphError names the pass and the resource.
class PassContext : public graph::ExecuteContext {
  public:
    PassContext(Executor& executor, const graph::Step& step, bool isRepeated)
        : executor_(executor), step_(step), isRepeated_(isRepeated) {}

    // Whether the pass has run in this frame before: a loop has come round.
    [[nodiscard]] bool isRepeated() const { return isRepeated_; }

    [[nodiscard]] Command fullscreen(const std::string& fragmentShader);
    [[nodiscard]] Command compute(const std::string& computeShader);
    [[nodiscard]] Command shaders(std::vector<std::string> files);

    // Whether only the programs of the pass are asked for (Executor::listPrograms): commands do
    // nothing then, and what is read or copied without one is not what it will be.
    [[nodiscard]] bool isListing() const;

    // Whether what the pass makes is read after the frame: saved, shown, scanned or audited.
    [[nodiscard]] bool isKept(const graph::ResourceRef& handle) const;

    // The texture or buffer behind a handle, for what uses it without a Command. A texture is
    // cleared or copied at once; a buffer is used by what is issued next, in the way that `use`
    // says.
    [[nodiscard]] const Texture& texture(const graph::ResourceRef& handle) const;
    [[nodiscard]] const Buffer& buffer(const graph::ResourceRef& handle,
                                       Use use = Use::updateBuffer) const;

    // The members from here on are for Command.
    [[nodiscard]] const std::string& passName() const { return step_.name; }
    [[nodiscard]] const std::vector<graph::Binding>& bindings() const { return step_.bindings; }
    [[nodiscard]] const std::vector<std::string>& defines() const { return step_.defines; }
    [[nodiscard]] const Globals& globals() const;
    [[nodiscard]] Access access(const graph::ResourceRef& handle, Use use) const;
    [[nodiscard]] const Texture& textureOf(const Access& access) const;
    [[nodiscard]] const Buffer& bufferOf(const Access& access) const;
    // Waits for what the accesses depend on; to be called just before they happen.
    void order(const std::vector<Access>& accesses) const;
    [[nodiscard]] ProgramCache& programs();
    [[nodiscard]] GLuint framebuffer(const std::vector<Attachment>& attachments);
    [[nodiscard]] GLuint emptyVertexArray() const;
    // Null unless accesses are counted.
    [[nodiscard]] AccessCounter* counter() const;
    // Notes a command's program where that is all that is asked for; false: it is to be issued.
    [[nodiscard]] bool list(const ProgramKey& key);

  private:
    Executor& executor_;
    const graph::Step& step_;
    bool isRepeated_;
};

// A program, and the pass that asks for it first.
struct UsedProgram {
    ProgramKey key;
    std::string pass;
};

class Executor {
  public:
    Executor(Context& context, ProgramCache& programs);

    // Takes over a compiled graph; slots that match the last one's are kept.
    // Throws DeviceError when the device has no memory for it.
    void prepare(graph::Compiled compiled);
    [[nodiscard]] const graph::Compiled& compiled() const { return compiled_; }

    // What every command may use from now on.
    void bindToAll(Globals globals) { globals_ = std::move(globals); }

    // Fills every texture with NaN and every buffer with all-ones bits before its first writer
    // runs, so that a test sees reads of what has not been written.
    void poisonTransients(bool poison) { poison_ = poison; }

    // From now on every pass is counted, or none where null; it must outlive the frames.
    void countAccesses(AccessCounter* counter) { counter_ = counter; }

    // The programs that a frame may ask for, in the order of their passes: nothing is drawn or
    // dispatched for that, and nothing compiled. Clears happen, so what textures and buffers held
    // is gone but for what the next frame is to find.
    [[nodiscard]] std::vector<UsedProgram> listPrograms();

    // Runs all passes once. In the first frame of a graph the processor waits for a word that says
    // whether a loop comes round; in those that follow, loops that may run idle run as often as in
    // the one before, which is the same frame, and nothing waits (takeCutShort). Throws what a pass
    // throws, and DeviceError for OpenGL errors: after the pass that made one where the context
    // debugs, else at the frame's end. `shouldContinue` is asked before each pass, by its number;
    // where it says no, the frame ends there and has no time, and the result is false.
    bool runFrame(PassTimer& timer, const std::function<bool(std::size_t)>& shouldContinue = {});

    // Frames of this graph, since the last call, in which a loop was left before its end, as far as
    // is known by now; with `waits`, all. The next frame waits for its loops again.
    [[nodiscard]] std::size_t takeCutShort(bool waits = false);

    // What was asked for, as the last frame has left it; GraphError for the rest.
    [[nodiscard]] const Texture& texture(const graph::ResourceRef& handle) const;
    [[nodiscard]] const Buffer& buffer(const graph::ResourceRef& handle) const;

  private:
    friend class PassContext;
    struct Physical {
        Texture texture;
        Buffer buffer;
        graph::ResourceDesc desc;
        std::string persistentName;  // of the resource whose it is from frame to frame
    };
    void clearSlot(std::size_t slot, const graph::ClearValue& value);
    void poison(const graph::Step& step, bool isRepeated);
    [[nodiscard]] bool isLoopRepeated(const graph::Loop& loop);
    void order(const std::vector<Access>& accesses);
    // Which loop comes round after a step, if any. How often loops run is noted in `runs`.
    struct LoopRuns {
        std::vector<std::size_t> finished;  // how often it has run, each time that it was begun
        std::size_t current = 0;
    };
    void noteCutShort(bool waits);
    const graph::Loop* repeatedLoop(std::size_t step, std::vector<LoopRuns>& runs);
    GLuint framebuffer(const std::vector<Attachment>& attachments);

    Context& context_;
    ProgramCache& programs_;
    Globals globals_;
    graph::Compiled compiled_;
    std::vector<Physical> slots_;
    Barriers barriers_;
    std::map<std::vector<std::tuple<GLuint, int, bool>>, FramebufferObject> framebuffers_;
    VertexArrayObject emptyVertexArray_;
    AccessCounter* counter_ = nullptr;
    bool poison_ = false;
    std::vector<UsedProgram>* listed_ = nullptr;  // while programs are listed
    bool isFresh_ = true;                         // no frame has been run since prepare()
    std::vector<LoopRuns> loopRuns_;              // of the last frame
    LoopWords loopWords_;
    std::size_t cutShort_ = 0;  // frames, until they are taken
    bool waitsNext_ = false;    // for its loops, since one was cut short
    bool trustsLoops_ = false;  // in this frame
};

}  // namespace kaustik::gl
