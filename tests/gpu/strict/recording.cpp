// SPDX-License-Identifier: MIT
// libepoxy calls each function by a pointer of its own, which is replaced here.
#include "tests/gpu/strict/recording.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <cstring>

namespace kaustik::test {
namespace {

Recording* current = nullptr;

std::string kindOf(GLenum type) {
    switch (type) {
        case GL_VERTEX_SHADER:
            return "vert";
        case GL_GEOMETRY_SHADER:
            return "geom";
        case GL_FRAGMENT_SHADER:
            return "frag";
        default:
            return "comp";
    }
}

}  // namespace

// What OpenGL's functions are while a recording lives.
struct Recording::Hooks {
    static void shaderSource(GLuint shader, GLsizei count, const GLchar* const* texts,
                             const GLint*) {
        GLint type = 0;
        current->getShader_(shader, GL_SHADER_TYPE, &type);
        RecordedStage& stage = current->stages_[shader];
        stage = {kindOf(static_cast<GLenum>(type)), ""};
        for (GLsizei i = 0; i < count; ++i)
            stage.text += texts[i];
    }
    static void attachShader(GLuint program, GLuint shader) {
        current->attached_[program].push_back(current->stages_[shader]);
    }
    static void objectLabel(GLenum identifier, GLuint name, GLsizei length, const GLchar* label) {
        if (identifier == GL_PROGRAM) {
            const std::string text(label, static_cast<std::size_t>(length));
            current->names_[name] = text;
            current->programs_.emplace(std::move(current->attached_[name]), text);
            current->attached_.erase(name);
        }
    }
    static void useProgram(GLuint program) { current->used_ = program; }
    static void dispatchCompute(GLuint x, GLuint y, GLuint z) {
        const std::array<GLuint, 3> groups = {x, y, z};
        for (std::size_t i = 0; i < groups.size(); ++i) {
            Dispatch& largest = current->largest_[i];
            if (groups[i] > largest.groups) largest = {groups[i], current->names_[current->used_]};
        }
    }
    // Of one texel, which costs no time: nothing is stored in them.
    static void textureStorage2D(GLuint texture, GLsizei, GLenum format, GLsizei, GLsizei) {
        current->storage2D_(texture, 1, format, 1, 1);
    }
    static void textureStorage3D(GLuint texture, GLsizei, GLenum format, GLsizei, GLsizei,
                                 GLsizei layers) {
        current->storage3D_(texture, 1, format, 1, 1, layers);
    }
    static void succeeded(GLuint, GLenum, GLint* value) { *value = GL_TRUE; }
    static GLint noLocation(GLuint, const GLchar*) { return -1; }
    static GLuint noIndex(GLuint, const GLchar*) { return GL_INVALID_INDEX; }
    static GLuint noResource(GLuint, GLenum, const GLchar*) { return GL_INVALID_INDEX; }
    // Nothing was counted: loops end.
    static void zeros(GLuint, GLintptr, GLsizeiptr bytes, void* data) {
        std::memset(data, 0, static_cast<std::size_t>(bytes));
    }
};

namespace {

template <class... In>
void doNothing(In...) {}

}  // namespace

Recording::Recording() {
    assert(current == nullptr);
    current = this;
    // What is in the store would not be compiled.
    ::setenv("KAUSTIK_PROGRAM_CACHE", "0", 1);
    // libepoxy looks a function up when it is first called, by the pointer that is replaced below.
    const GLuint shader = glCreateShader(GL_VERTEX_SHADER);
    GLint type = 0;
    glGetShaderiv(shader, GL_SHADER_TYPE, &type);
    glDeleteShader(shader);
    getShader_ = glGetShaderiv;
    for (const GLenum target : {GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY}) {
        GLuint texture = 0;
        glCreateTextures(target, 1, &texture);
        if (target == GL_TEXTURE_2D) {
            glTextureStorage2D(texture, 1, GL_R8, 1, 1);
        } else {
            glTextureStorage3D(texture, 1, GL_R8, 1, 1, 1);
        }
        glDeleteTextures(1, &texture);
    }
    storage2D_ = glTextureStorage2D;
    storage3D_ = glTextureStorage3D;
    const auto replace = [this]<class Function>(Function& function, Function by) {
        restores_.emplace_back([&function, before = function] { function = before; });
        function = by;
    };
    replace(glShaderSource, &Hooks::shaderSource);
    replace(glAttachShader, &Hooks::attachShader);
    replace(glObjectLabel, &Hooks::objectLabel);
    replace(glUseProgram, &Hooks::useProgram);
    replace(glTextureStorage2D, &Hooks::textureStorage2D);
    replace(glTextureStorage3D, &Hooks::textureStorage3D);
    replace(glCompileShader, &doNothing<GLuint>);
    replace(glLinkProgram, &doNothing<GLuint>);
    replace(glDetachShader, &doNothing<GLuint, GLuint>);
    replace(glGetShaderiv, &Hooks::succeeded);
    replace(glGetProgramiv, &Hooks::succeeded);
    replace(glGetUniformLocation, &Hooks::noLocation);
    replace(glGetUniformBlockIndex, &Hooks::noIndex);
    replace(glGetProgramResourceIndex, &Hooks::noResource);
    replace(glGetNamedBufferSubData, &Hooks::zeros);
    replace(glDispatchCompute, &Hooks::dispatchCompute);
    replace(glDispatchComputeIndirect, &doNothing<GLintptr>);
    replace(glDrawArraysInstanced, &doNothing<GLenum, GLint, GLsizei, GLsizei>);
    replace(glDrawArraysIndirect, &doNothing<GLenum, const void*>);
    replace(glMultiDrawElementsIndirect, &doNothing<GLenum, GLenum, const void*, GLsizei, GLsizei>);
    // Nor is memory touched: what is in it decides nothing.
    replace(glClearTexImage, &doNothing<GLuint, GLint, GLenum, GLenum, const void*>);
    replace(glClearNamedBufferData, &doNothing<GLuint, GLenum, GLenum, GLenum, const void*>);
    replace(glClearNamedFramebufferfv, &doNothing<GLuint, GLenum, GLint, const GLfloat*>);
    replace(glTextureSubImage2D,
            &doNothing<GLuint, GLint, GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, const void*>);
    replace(glTextureSubImage3D, &doNothing<GLuint, GLint, GLint, GLint, GLint, GLsizei, GLsizei,
                                            GLsizei, GLenum, GLenum, const void*>);
    replace(glCopyImageSubData,
            &doNothing<GLuint, GLenum, GLint, GLint, GLint, GLint, GLuint, GLenum, GLint, GLint,
                       GLint, GLint, GLsizei, GLsizei, GLsizei>);
    replace(glGetTextureImage, &doNothing<GLuint, GLint, GLenum, GLenum, GLsizei, void*>);
    replace(glGetTextureSubImage, &doNothing<GLuint, GLint, GLint, GLint, GLint, GLsizei, GLsizei,
                                             GLsizei, GLenum, GLenum, GLsizei, void*>);
    replace(glMemoryBarrier, &doNothing<GLbitfield>);
    replace(glBeginTransformFeedback, &doNothing<GLenum>);
    replace(glEndTransformFeedback, &doNothing<>);
}

Recording::~Recording() {
    for (const std::function<void()>& restore : restores_)
        restore();
    current = nullptr;
}

}  // namespace kaustik::test
