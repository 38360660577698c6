// SPDX-License-Identifier: MIT
// Hands what a command was told to OpenGL, and draws or dispatches.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <glm/gtc/type_ptr.hpp>

#include "framework/core/error.h"
#include "framework/gl/access_counter.h"
#include "framework/gl/command.h"
#include "framework/gl/executor.h"

namespace kaustik::gl {
namespace {

void setUniform(GLuint program, GLint location, const Command::Value& value) {
    struct Setter {
        GLuint program;
        GLint at;
        void operator()(int v) const { glProgramUniform1i(program, at, v); }
        void operator()(unsigned v) const { glProgramUniform1ui(program, at, v); }
        void operator()(float v) const { glProgramUniform1f(program, at, v); }
        void operator()(const glm::vec2& v) const { glProgramUniform2f(program, at, v.x, v.y); }
        void operator()(const glm::vec3& v) const {
            glProgramUniform3f(program, at, v.x, v.y, v.z);
        }
        void operator()(const glm::vec4& v) const {
            glProgramUniform4f(program, at, v.x, v.y, v.z, v.w);
        }
        void operator()(const glm::ivec2& v) const { glProgramUniform2i(program, at, v.x, v.y); }
        void operator()(const glm::mat3& v) const {
            glProgramUniformMatrix3fv(program, at, 1, GL_FALSE, glm::value_ptr(v));
        }
        void operator()(const glm::mat4& v) const {
            glProgramUniformMatrix4fv(program, at, 1, GL_FALSE, glm::value_ptr(v));
        }
    };
    std::visit(Setter{program, location}, value);
}

// Along each axis: all that OpenGL promises (table 23.64) and that Mesa gives.
constexpr int kMaxGroups = 65535;

int groups(int count, int local) {
    return (count + local - 1) / local;
}

}  // namespace

Program& Command::bind() {
    AccessCounter* const counter = context_.counter();
    Program& program = counter != nullptr ? counter->program(key_) : context_.programs().get(key_);
    std::vector<Access> accesses = accesses_;
    glUseProgram(program.id());
    const auto isLeftOut = [&](const auto& bound) {
        return bound.isOffered && !program.declares(bound.name);
    };
    for (const Uniform& uniform : uniforms_) {
        if (isLeftOut(uniform)) continue;
        const GLint location = program.uniform(uniform.name);
        if (location >= 0) setUniform(program.id(), location, uniform.value);
    }
    // Units go to what the program has.
    GLuint unit = 0;
    for (const Bound& bound : textures_) {
        if (isLeftOut(bound)) continue;
        const GLint location = program.uniform(bound.name);
        if (location < 0) continue;
        if (bound.access) accesses.push_back(*bound.access);
        glBindTextureUnit(unit, bound.id);
        if (counter != nullptr && bound.buffer != 0) {
            counter->bindTexels(bound.name, bound.buffer, bound.id);
        } else if (counter != nullptr) {
            counter->bindTexture(bound.name, bound.id);
        }
        glProgramUniform1i(program.id(), location, static_cast<GLint>(unit++));
    }
    unit = 0;
    for (const BoundImage& bound : images_) {
        if (isLeftOut(bound)) continue;
        const GLint location = program.uniform(bound.name);
        if (location < 0) continue;
        if (std::any_of(textures_.begin(), textures_.end(),
                        [&](const Bound& other) { return other.name == bound.name; })) {
            throw GraphError(fmt::format("Pass '{}' binds '{}' both as a texture and as an image.",
                                         context_.passName(), bound.name));
        }
        accesses.push_back(bound.access);
        glBindImageTexture(unit, bound.texture->id(), 0, GL_TRUE, 0,
                           bound.access.stores ? GL_READ_WRITE : GL_READ_ONLY,
                           formatInfo(bound.texture->desc().format).internalFormat);
        if (counter != nullptr) counter->bindTexture(bound.name, bound.texture->id());
        glProgramUniform1i(program.id(), location, static_cast<GLint>(unit++));
    }
    unit = 0;
    for (const Bound& bound : storage_) {
        if (isLeftOut(bound)) continue;
        const GLuint index = program.storageBlock(bound.name);
        if (index == GL_INVALID_INDEX) continue;
        if (bound.access) accesses.push_back(*bound.access);
        glShaderStorageBlockBinding(program.id(), index, unit);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, unit++, bound.id);
        if (counter != nullptr) counter->bindBuffer(bound.name, bound.id);
    }
    freeStorageUnit_ = unit;
    unit = 0;
    for (const Bound& bound : uniformBlocks_) {
        if (isLeftOut(bound)) continue;
        const GLuint index = program.uniformBlock(bound.name);
        if (index == GL_INVALID_INDEX) continue;
        glUniformBlockBinding(program.id(), index, unit);
        glBindBufferBase(GL_UNIFORM_BUFFER, unit++, bound.id);
    }
    context_.order(accesses);
    return program;
}

void Command::bindTargets() {
    std::vector<Attachment> attachments;
    for (const Target& target : targets_) {
        attachments.push_back({target.texture, target.layer, false});
    }
    const bool hasAllLayers = !targets_.empty() && targets_.front().layer == kAllLayers;
    if (depth_.texture != nullptr)
        attachments.push_back({depth_.texture, hasAllLayers ? kAllLayers : depth_.layer, true});
    if (attachments.empty()) {
        throw GraphError(
            fmt::format("Pass '{}' draws {} to nothing: target() or depth() is missing.",
                        context_.passName(), fmt::join(key_.files, " + ")));
    }
    const GLuint framebuffer = context_.framebuffer(attachments);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    const auto boundClear = [&] {
        if (!clearsInScissor_) {
            glDisable(GL_SCISSOR_TEST);
            return;
        }
        glEnable(GL_SCISSOR_TEST);
        glScissor(scissor_->x, scissor_->y, scissor_->z, scissor_->w);
    };
    for (std::size_t i = 0; i < targets_.size(); ++i) {
        if (!targets_[i].clear) continue;
        boundClear();
        countClear(targets_[i]);
        glClearNamedFramebufferfv(framebuffer, GL_COLOR, static_cast<GLint>(i),
                                  targets_[i].value.data());
        targets_[i].clear = false;  // a command may draw more than once
    }
    if (depth_.clear) {
        boundClear();
        glDepthMask(GL_TRUE);
        countClear(depth_);
        glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, depth_.value.data());
        depth_.clear = false;
    }
    countTargets(attachments);
    if (viewport_.z < 0) {
        const graph::TextureDesc& desc = attachments.front().texture->desc();
        viewport_ = {0, 0, desc.width, desc.height};
    }
    glViewport(viewport_.x, viewport_.y, viewport_.z, viewport_.w);
}

void Command::bindState() {
    glDisable(GL_CULL_FACE);
    if (scissor_) {
        glEnable(GL_SCISSOR_TEST);
        glScissor(scissor_->x, scissor_->y, scissor_->z, scissor_->w);
    } else {
        glDisable(GL_SCISSOR_TEST);
    }
    if (depthTest_ == DepthTest::none) {
        glDisable(GL_DEPTH_TEST);
    } else {
        glEnable(GL_DEPTH_TEST);
        glDepthMask(GL_TRUE);
        glDepthFunc(depthTest_ == DepthTest::nearer           ? GL_LESS
                    : depthTest_ == DepthTest::nearerReversed ? GL_GREATER
                                                              : GL_GEQUAL);
    }
    if (blend_ == Blend::none) {
        glDisable(GL_BLEND);
    } else {
        glEnable(GL_BLEND);
        glBlendEquation(GL_FUNC_ADD);
        glBlendFunc(GL_ONE, GL_ONE);
    }
}

void Command::draw() {
    const std::string vertexShader = "framework/fullscreen.vert";
    key_.files.insert(key_.files.begin(), vertexShader);
    drawArrays(GL_TRIANGLES, 3);
}

void Command::drawArrays(GLenum mode, int count, int instances) {
    if (context_.list(key_)) return;
    bind();
    bindTargets();
    bindState();
    glBindVertexArray(context_.emptyVertexArray());
    countCommand();
    glDrawArraysInstanced(mode, 0, count, instances);
}

void Command::drawIndexedIndirect(GLuint vertexArray, const Buffer& commands, std::size_t first,
                                  std::size_t count) {
    if (context_.list(key_)) return;
    bind();
    bindTargets();
    bindState();
    if (count > 0) {
        constexpr std::size_t kCommandBytes = 5 * sizeof(GLuint);
        glBindVertexArray(vertexArray);
        glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.id());
        countVertices(commands, first, count);
        countCommand();
        glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                                    reinterpret_cast<const void*>(first * kCommandBytes),
                                    static_cast<GLsizei>(count), 0);
    }
}

void Command::dispatch(int groupsX, int groupsY, int groupsZ) {
    if (std::max({groupsX, groupsY, groupsZ}) > kMaxGroups) {
        throw GraphError(
            fmt::format("Pass '{}' dispatches {} in {} x {} x {} workgroups; a device may have no "
                        "more than {} along an axis. dispatchOver() of one number with a shader "
                        "that includes include/thread.glsl has no such limit.",
                        context_.passName(), fmt::join(key_.files, " + "), groupsX, groupsY,
                        groupsZ, kMaxGroups));
    }
    if (context_.list(key_)) return;
    bind();
    if (groupsX > 0 && groupsY > 0 && groupsZ > 0) {
        countCommand();
        if (AccessCounter* const counter = context_.counter()) {
            counter->addWorkGroups(static_cast<std::uint64_t>(groupsX) *
                                   static_cast<std::uint64_t>(groupsY) *
                                   static_cast<std::uint64_t>(groupsZ));
        }
        glDispatchCompute(static_cast<GLuint>(groupsX), static_cast<GLuint>(groupsY),
                          static_cast<GLuint>(groupsZ));
    }
}

GLuint Command::indirect(const graph::ResourceRef& commands) {
    accesses_.push_back(context_.access(commands, Use::drawCommands));
    return context_.bufferOf(accesses_.back()).id();
}

void Command::dispatchIndirect(const graph::ResourceRef& commands, std::size_t offset) {
    const GLuint buffer = indirect(commands);
    if (context_.list(key_)) return;
    bind();
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, buffer);
    countCommand();
    countIndirectGroups(buffer, offset);
    glDispatchComputeIndirect(static_cast<GLintptr>(offset));
}

void Command::drawIndirect(GLenum mode, const graph::ResourceRef& commands, std::size_t offset) {
    const GLuint buffer = indirect(commands);
    if (context_.list(key_)) return;
    bind();
    bindTargets();
    bindState();
    glBindVertexArray(context_.emptyVertexArray());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer);
    countCommand();
    glDrawArraysIndirect(mode, reinterpret_cast<const void*>(offset));
}

void Command::captureIndirect(GLenum mode, const graph::ResourceRef& commands, std::size_t offset,
                              const std::vector<graph::ResourceRef>& streams,
                              const graph::ResourceRef& counts) {
    const GLuint buffer = indirect(commands);
    std::vector<GLuint> captured;
    for (const graph::ResourceRef& stream : streams) {
        accesses_.push_back(context_.access(stream, Use::capture));
        captured.push_back(context_.bufferOf(accesses_.back()).id());
    }
    accesses_.push_back(context_.access(counts, Use::queryResult));
    const GLuint results = context_.bufferOf(accesses_.back()).id();
    if (context_.list(key_)) return;
    bind();
    glBindFramebuffer(GL_FRAMEBUFFER, context_.framebuffer({}));
    glBindVertexArray(context_.emptyVertexArray());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer);
    glEnable(GL_RASTERIZER_DISCARD);
    std::vector<QueryObject> queries;
    for (GLuint stream = 0; stream < captured.size(); ++stream) {
        glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, stream, captured[stream]);
        queries.push_back(makeCaptureQuery());
        glBeginQueryIndexed(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, stream, queries.back().id());
    }
    countCommand();
    glBeginTransformFeedback(GL_POINTS);
    glDrawArraysIndirect(mode, reinterpret_cast<const void*>(offset));
    glEndTransformFeedback();
    for (GLuint stream = 0; stream < captured.size(); ++stream)
        glEndQueryIndexed(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, stream);
    glDisable(GL_RASTERIZER_DISCARD);
    for (GLuint stream = 0; stream < captured.size(); ++stream) {
        glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, stream, 0);
        glGetQueryBufferObjectuiv(queries[stream].id(), results, GL_QUERY_RESULT,
                                  static_cast<GLintptr>(stream * sizeof(GLuint)));
    }
}

void Command::dispatchOver(int countX, int localX, int countY, int localY) {
    if (localX < 1 || localY < 1) {
        throw GraphError(fmt::format("Pass '{}' dispatches {} in groups of {}x{}.",
                                     context_.passName(), fmt::join(key_.files, " + "), localX,
                                     localY));
    }
    const int x = groups(countX, localX);
    const int y = groups(countY, localY);
    // Threads of one number each go on along y (include/thread.glsl).
    const bool isLine = localY == 1 && countY == 1;
    if (isLine && x > kMaxGroups) return dispatch(kMaxGroups, groups(x, kMaxGroups));
    dispatch(x, y);
}

}  // namespace kaustik::gl
