// SPDX-License-Identifier: MIT
// Counts what the passes of a frame do to memory, by shaders that count (counting_text.h). It takes
// many times as long as the frame does and makes the same picture. Not counted: uniforms, what is
// no array in storage blocks, commands of indirect draws and dispatches, and what transform
// feedback captures.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/gl/counting_text.h"
#include "framework/gl/objects.h"
#include "framework/gl/program.h"

namespace kaustik::gl {

// Of all runs of a pass in a frame.
struct PassAccesses {
    std::string name;
    // Bytes that the pass reads, and bytes that it writes, each counted once however often it does:
    // the least that memory has to move where nothing is kept from one pass to the next. What is
    // cleared is written.
    std::uint64_t readBytes = 0;
    std::uint64_t writtenBytes = 0;
    // Bytes that its threads ask for, each time: what a device without caches would move.
    std::uint64_t requestedReadBytes = 0;
    std::uint64_t requestedWrittenBytes = 0;
    std::uint64_t atomics = 0;
    std::uint64_t threads = 0;  // of all stages
    std::uint64_t workGroups = 0;
    std::uint64_t commands = 0;  // draws and dispatches
    std::uint64_t barriers = 0;
    std::uint64_t readBacks = 0;  // times that the processor waits for the device

    // By texture or buffer, under the name that the pass' shaders have for it.
    struct Resource {
        std::string name;
        std::uint64_t bytes = 0;  // all of it, as often as the pass has run
        std::uint64_t readBytes = 0;
        std::uint64_t writtenBytes = 0;
    };
    std::vector<Resource> resources;
};

class AccessCounter {
  public:
    // `programs`: those without counting, whose layouts the counting ones share.
    explicit AccessCounter(ProgramCache& programs);

    // What was counted since the last call, in the order of the passes' first runs.
    [[nodiscard]] std::vector<PassAccesses> take();

    // For the executor.
    void beginPass(const std::string& name);
    void endPass();
    void addBarrier();
    void addReadBack();

    // For Command: the counting program, and what is bound to it. Throws ShaderError.
    [[nodiscard]] Program& program(const ProgramKey& key);
    void bindTexture(const std::string& name, GLuint texture);
    void bindBuffer(const std::string& block, GLuint buffer);
    // A buffer that is fetched from by this buffer texture.
    void bindTexels(const std::string& name, GLuint buffer, GLuint texture);
    // Colours in their order, layers as Command has them; 0 for no depth.
    void bindTargets(const std::vector<GLuint>& colors, GLuint depth, int layer, bool blends);
    // The vertices that the bound vertex array's first binding has; `indexBytes` are read with
    // them.
    void bindVertices(std::uint64_t indexBytes);
    // Hands the program all that was bound since program(). `unit`: a storage binding that is free.
    void apply(GLuint unit);
    void addCommand() { ++here_.commands; }
    void addWorkGroups(std::uint64_t groups) { here_.workGroups += groups; }
    // All of it is written, as a clear does.
    void addWholeTexture(const std::string& name, GLuint texture);
    void addLayer(const std::string& name, GLuint texture, int layer);
    void addWholeBuffer(const std::string& name, GLuint buffer);

  private:
    struct Counting {
        Program program;
        std::vector<std::string> names;
    };
    // A texture or buffer that this run of a pass uses. Bits are of texels or of words.
    struct Used {
        std::string name;
        std::uint64_t elements;
        std::uint64_t bytesPerElement;
        glm::uvec4 shape;
        glm::uvec2 firstWord{~0u};
        bool isWrittenWhole = false;
    };
    using Key = std::pair<bool, GLuint>;  // whether it is a texture
    Used& use(const std::string& name, Key key);
    void number(std::size_t number, const Used& used);
    void reserve(std::size_t words);
    // Of the pass in passes_, where it is added if it is not there.
    std::size_t indexOf(const std::string& name);

    ProgramCache& programs_;
    std::map<ProgramKey, Counting> counting_;
    std::vector<PassAccesses> passes_;
    std::optional<std::size_t> lastEnded_;  // in passes_
    PassAccesses here_;
    std::map<Key, Used> used_;
    Buffer buffer_;  // kCountedShards * 4 words of sums, then bits
    std::size_t usedWords_ = 0;
    Counting* current_ = nullptr;
    std::vector<glm::uvec4> shapes_;
    std::vector<glm::uvec2> firsts_;
    int targetLayer_ = 0;
    bool blends_ = false;
};

}  // namespace kaustik::gl
