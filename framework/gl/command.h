// SPDX-License-Identifier: MIT
// One draw or dispatch, put together by name and issued by its last call:
//
//     context.fullscreen("gather/screen.frag")
//         .define("HAS_INTENSITY")
//         .target(data.irradiance)
//         .draw();
//
// It starts with what its pass has bound by name (graph::PassSetup) and what is bound to all
// (Globals); of both it uses what the shaders declare.
// A command sets all the state it depends on and leaves none behind, and waits for what it depends
// on (barriers.h). Textures and buffers that are not of the graph are only read.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "framework/gl/barriers.h"
#include "framework/gl/program.h"
#include "framework/params/field.h"

namespace kaustik::gl {

class PassContext;
struct Attachment;

// What shaders of every pass may declare, by name; all of it outlives the executor's frames.
struct Globals {
    std::vector<std::pair<std::string, const Buffer*>> uniforms;
    std::vector<std::pair<std::string, const Buffer*>> storage;
    std::vector<std::pair<std::string, const Texture*>> textures;
    std::vector<std::pair<std::string, float>> values;
    std::vector<std::string> defines;
};

enum class Blend { none, add };
// nearer: the smaller value wins (distances); nearerReversed: the larger one (reversed z);
// atReversed: that or the same one, for surfaces that the buffer holds already.
enum class DepthTest { none, nearer, nearerReversed, atReversed };

class Command {
  public:
    Command(PassContext& context, std::vector<std::string> files);

    // Inputs. Texture samplers, images and blocks are named as in the shader.
    Command& texture(const std::string& name, const graph::ResourceRef& handle);
    Command& texture(const std::string& name, const Texture& texture);
    // Binds an image that the command reads, and may write where the pass has declared that it
    // writes it. A storage block is bound in the same way.
    Command& image(const std::string& name, const graph::ResourceRef& handle);
    Command& storage(const std::string& block, const graph::ResourceRef& handle);
    Command& storage(const std::string& block, const Buffer& buffer);
    // A samplerBuffer's: a buffer that is read alone, four words at a time. What a software
    // rasteriser fetches so takes it a third of the time that words of a block take.
    Command& texels(const std::string& name, const graph::ResourceRef& handle,
                    graph::Format format);
    Command& texels(const std::string& name, const Buffer& buffer, graph::Format format);
    Command& uniforms(const std::string& block, const Buffer& buffer);

    // What shaders use if they declare it, in place of what is bound to all.
    Command& offer(const std::string& block, const Buffer& buffer);

    using Value = std::variant<int, unsigned, float, glm::vec2, glm::vec3, glm::vec4, glm::ivec2,
                               glm::mat3, glm::mat4>;
    Command& set(const std::string& name, Value value);
    Command& offer(const std::string& name, Value value);
    // Every field of a parameter struct as a uniform: scope "trace.lines", field "width" is
    // `trace_lines_width`; a choice also declares a constant a name: `trace_test_epsilon`.
    template <class Params>
    Command& params(const std::string& scope, Params value) {
        return fields(scope, params::fieldsOf(value));
    }
    // `#define NAME` for variants.
    Command& define(const std::string& name);

    // Outputs, in the order of the fragment shader's locations; `layer` of an array texture, or all
    // of them, of which a geometry shader takes one. The depth has as many as the first target.
    static constexpr int kAllLayers = -1;
    Command& target(const graph::ResourceRef& handle, int layer = 0);
    Command& depth(const graph::ResourceRef& handle, DepthTest test, int layer = 0);
    // Clears the last target (or depth) before drawing; GraphError where there is none yet.
    Command& clear(graph::ClearValue value = {0.0f, 0.0f, 0.0f, 0.0f});
    Command& blend(Blend blend);
    // Default: the whole of the first target.
    Command& viewport(int x, int y, int width, int height);
    // Draws to these pixels alone; all of a target is cleared nevertheless. Default: no bounds.
    Command& scissor(glm::ivec2 first, glm::ivec2 end);
    // The same, and clears these pixels alone: what lies around them stays as it is.
    Command& bounds(glm::ivec2 first, glm::ivec2 end);

    // The last calls. A draw without a target is a GraphError.
    void draw();  // fullscreen
    void drawArrays(GLenum mode, int count, int instances = 1);
    // Indexed triangles with the vertex array bound by the caller-supplied function.
    void drawIndexedIndirect(GLuint vertexArray, const Buffer& commands, std::size_t first,
                             std::size_t count);
    void dispatch(int groupsX, int groupsY = 1, int groupsZ = 1);
    // Workgroups of `local` threads that cover `count`.
    void dispatchOver(int countX, int localX, int countY = 1, int localY = 1);
    // Workgroups in the numbers that stand at `offset` of a buffer, three uints.
    void dispatchIndirect(const graph::ResourceRef& commands, std::size_t offset);
    // Draws with count, instances, first vertex and first instance taken from a buffer.
    void drawIndirect(GLenum mode, const graph::ResourceRef& commands, std::size_t offset);
    // Draws what a geometry shader's streams capture in buffers, instead of rasterising it, and
    // writes how many points each stream had, a uint each, to `counts`.
    void captureIndirect(GLenum mode, const graph::ResourceRef& commands, std::size_t offset,
                         const std::vector<graph::ResourceRef>& streams,
                         const graph::ResourceRef& counts);

  private:
    // `access`: of the graph's memory, where it is that.
    struct Bound {
        std::string name;
        GLuint id;
        std::optional<Access> access;
        bool isOffered = false;  // by the pass or to all: a program need not declare it
        GLuint buffer = 0;       // of a texture whose texels are a buffer's
    };
    struct BoundImage {
        std::string name;
        const Texture* texture;
        Access access;
        bool isOffered = false;
    };
    struct Target {
        const Texture* texture;
        int layer;
        bool clear;
        graph::ClearValue value;
    };
    struct Uniform {
        std::string name;
        Value value;
        bool isOffered = false;
    };
    Command& fields(const std::string& scope, const std::vector<params::Field>& fields);
    const Texture& textureToDrawTo(const graph::ResourceRef& handle);
    Program& bind();
    GLuint indirect(const graph::ResourceRef& commands);
    // These do nothing unless accesses are counted.
    void countCommand();  // just before it is issued
    void countTargets(const std::vector<Attachment>& attachments);
    void countClear(const Target& target);
    void countVertices(const Buffer& commands, std::size_t first, std::size_t count);
    void countIndirectGroups(GLuint commands, std::size_t offset);
    void bindTargets();
    void bindState();

    PassContext& context_;
    ProgramKey key_;
    std::vector<Access> accesses_;  // of the graph's memory, whatever the program declares
    std::vector<Bound> textures_;
    std::vector<BoundImage> images_;
    std::vector<Bound> storage_;
    std::vector<Bound> uniformBlocks_;
    std::vector<Uniform> uniforms_;
    std::vector<Target> targets_;
    Target depth_{nullptr, 0, false, {}};
    DepthTest depthTest_ = DepthTest::none;
    Blend blend_ = Blend::none;
    glm::ivec4 viewport_{0, 0, -1, -1};
    std::optional<glm::ivec4> scissor_;
    bool clearsInScissor_ = false;
    bool lastIsDepth_ = false;
    bool offers_ = false;
    GLuint freeStorageUnit_ = 0;
};

}  // namespace kaustik::gl
