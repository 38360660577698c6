// SPDX-License-Identifier: MIT
#include "framework/gl/objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "framework/core/error.h"

namespace kaustik::gl {
namespace detail {
void deleteTexture(GLuint id) {
    glDeleteTextures(1, &id);
}
void deleteBuffer(GLuint id) {
    glDeleteBuffers(1, &id);
}
void deleteFramebuffer(GLuint id) {
    glDeleteFramebuffers(1, &id);
}
void deleteVertexArray(GLuint id) {
    glDeleteVertexArrays(1, &id);
}
void deleteProgram(GLuint id) {
    glDeleteProgram(id);
}
void deleteShader(GLuint id) {
    glDeleteShader(id);
}
void deleteQuery(GLuint id) {
    glDeleteQueries(1, &id);
}
}  // namespace detail

FormatInfo formatInfo(graph::Format format) {
    using graph::Format;
    switch (format) {
        case Format::r32f:
            return {GL_R32F, GL_RED, GL_FLOAT, 1, false};
        case Format::rg32f:
            return {GL_RG32F, GL_RG, GL_FLOAT, 2, false};
        case Format::rgba32f:
            return {GL_RGBA32F, GL_RGBA, GL_FLOAT, 4, false};
        case Format::rgba16f:
            return {GL_RGBA16F, GL_RGBA, GL_FLOAT, 4, false};
        case Format::rgba8:
            return {GL_RGBA8, GL_RGBA, GL_FLOAT, 4, false};
        case Format::r32ui:
            return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 1, true};
        case Format::rg32ui:
            return {GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT, 2, true};
        case Format::rgba32ui:
            return {GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, 4, true};
        case Format::depth32f:
            return {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 1, false};
    }
    return {};
}

namespace {
GLuint createTexture(GLenum target) {
    GLuint id = 0;
    glCreateTextures(target, 1, &id);
    return id;
}
GLuint createBuffer() {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    return id;
}
}  // namespace

Texture::Texture(const graph::TextureDesc& desc, const std::string& label, bool isImage)
    : object_(createTexture(desc.layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D)), desc_(desc) {
    const FormatInfo info = formatInfo(desc.format);
    const auto side = static_cast<unsigned>(std::max(desc.width, desc.height));
    const auto levels = isImage ? static_cast<GLsizei>(std::bit_width(side)) : 1;
    if (desc.layers > 0) {
        glTextureStorage3D(id(), levels, info.internalFormat, desc.width, desc.height, desc.layers);
    } else {
        glTextureStorage2D(id(), levels, info.internalFormat, desc.width, desc.height);
    }
    glTextureParameteri(id(), GL_TEXTURE_MIN_FILTER,
                        isImage ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST);
    glTextureParameteri(id(), GL_TEXTURE_MAG_FILTER, isImage ? GL_LINEAR : GL_NEAREST);
    glTextureParameteri(id(), GL_TEXTURE_WRAP_S, isImage ? GL_REPEAT : GL_CLAMP_TO_EDGE);
    glTextureParameteri(id(), GL_TEXTURE_WRAP_T, isImage ? GL_REPEAT : GL_CLAMP_TO_EDGE);
    glObjectLabel(GL_TEXTURE, id(), static_cast<GLsizei>(label.size()), label.c_str());
}

void Texture::clear(const graph::ClearValue& value) const {
    const FormatInfo info = formatInfo(desc_.format);
    if (info.isInteger) {
        // What is not a number sets every bit.
        const auto whole = [](float v) { return v >= 0.0f ? static_cast<std::uint32_t>(v) : ~0u; };
        const std::array<std::uint32_t, 4> integers = {whole(value[0]), whole(value[1]),
                                                       whole(value[2]), whole(value[3])};
        glClearTexImage(id(), 0, info.format, info.type, integers.data());
    } else {
        glClearTexImage(id(), 0, info.format, info.type, value.data());
    }
}

void Texture::upload(int layer, const std::vector<float>& rgba) const {
    glTextureSubImage3D(id(), 0, 0, 0, layer, desc_.width, desc_.height, 1, GL_RGBA, GL_FLOAT,
                        rgba.data());
}

void Texture::generateMipmaps() const {
    glGenerateTextureMipmap(id());
}

void Texture::copyTo(const Texture& target) const {
    const GLenum kind = desc_.layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glCopyImageSubData(id(), kind, 0, 0, 0, 0, target.id(), kind, 0, 0, 0, 0, desc_.width,
                       desc_.height, std::max(desc_.layers, 1));
}

std::vector<float> Texture::read() const {
    const FormatInfo info = formatInfo(desc_.format);
    const std::size_t texels = static_cast<std::size_t>(desc_.width) *
                               static_cast<std::size_t>(desc_.height) *
                               static_cast<std::size_t>(std::max(desc_.layers, 1));
    const std::size_t count = texels * static_cast<std::size_t>(info.channels);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    std::vector<float> values(count);
    if (info.isInteger) {
        const std::vector<std::uint32_t> integers = readWords();
        std::transform(integers.begin(), integers.end(), values.begin(),
                       [](std::uint32_t v) { return static_cast<float>(v); });
    } else {
        glGetTextureImage(id(), 0, info.format, info.type,
                          static_cast<GLsizei>(count * sizeof(float)), values.data());
    }
    return values;
}

std::vector<glm::vec4> Texture::readRows(int rows) const {
    std::vector<glm::vec4> texels(static_cast<std::size_t>(desc_.width) *
                                  static_cast<std::size_t>(rows));
    if (texels.empty()) return texels;
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glGetTextureSubImage(id(), 0, 0, 0, 0, desc_.width, rows, 1, GL_RGBA, GL_FLOAT,
                         static_cast<GLsizei>(texels.size() * sizeof(glm::vec4)), texels.data());
    return texels;
}

void Texture::writeRows(const std::vector<glm::vec4>& texels) const {
    const auto rows = static_cast<GLsizei>(texels.size() / static_cast<std::size_t>(desc_.width));
    if (rows == 0) return;
    glTextureSubImage2D(id(), 0, 0, 0, desc_.width, rows, GL_RGBA, GL_FLOAT, texels.data());
}

std::vector<std::uint32_t> Texture::readWords() const {
    const FormatInfo info = formatInfo(desc_.format);
    if (!info.isInteger) {
        throw GraphError(
            fmt::format("A {} texture holds no whole numbers.", graph::formatName(desc_.format)));
    }
    const std::size_t texels = static_cast<std::size_t>(desc_.width) *
                               static_cast<std::size_t>(desc_.height) *
                               static_cast<std::size_t>(std::max(desc_.layers, 1));
    std::vector<std::uint32_t> words(texels * static_cast<std::size_t>(info.channels));
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glGetTextureImage(id(), 0, info.format, info.type,
                      static_cast<GLsizei>(words.size() * sizeof(std::uint32_t)), words.data());
    return words;
}

Buffer::Buffer(std::size_t bytes, const void* data, const std::string& label)
    : object_(createBuffer()), bytes_(bytes) {
    // A buffer of no bytes is an OpenGL error; an empty scene has empty lists.
    const std::size_t stored = std::max<std::size_t>(bytes, 16);
    glNamedBufferStorage(id(), static_cast<GLsizeiptr>(stored), nullptr, GL_DYNAMIC_STORAGE_BIT);
    if (bytes > 0 && data != nullptr) upload(0, bytes, data);
    glObjectLabel(GL_BUFFER, id(), static_cast<GLsizei>(label.size()), label.c_str());
}

void Buffer::upload(std::size_t offset, std::size_t byteCount, const void* data) const {
    glNamedBufferSubData(id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(byteCount),
                         data);
}

void Buffer::clear() const {
    const std::uint32_t zero = 0;
    glClearNamedBufferData(id(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
}

void Buffer::copyTo(const Buffer& target) const {
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glCopyNamedBufferSubData(id(), target.id(), 0, 0, static_cast<GLsizeiptr>(bytes_));
}

GLuint Buffer::texels(graph::Format format) const {
    Object<detail::deleteTexture>& view = texels_[format];
    if (!view.valid()) {
        const FormatInfo info = formatInfo(format);
        const std::size_t texels =
            bytes_ / (sizeof(float) * static_cast<std::size_t>(info.channels));
        GLint64 allowed = 0;
        glGetInteger64v(GL_MAX_TEXTURE_BUFFER_SIZE, &allowed);
        if (texels > static_cast<std::size_t>(allowed)) {
            throw GraphError(
                fmt::format("A buffer is to be fetched as {} texels, and this device allows {}.",
                            texels, allowed));
        }
        GLuint id = 0;
        glCreateTextures(GL_TEXTURE_BUFFER, 1, &id);
        view = Object<detail::deleteTexture>(id);
        glTextureBuffer(id, info.internalFormat, object_.id());
    }
    return view.id();
}

void Buffer::readBytes(void* destination, std::size_t byteCount) const {
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    if (byteCount > 0)
        glGetNamedBufferSubData(id(), 0, static_cast<GLsizeiptr>(byteCount), destination);
}

FramebufferObject makeFramebuffer() {
    GLuint id = 0;
    glCreateFramebuffers(1, &id);
    return FramebufferObject(id);
}

VertexArrayObject makeVertexArray() {
    GLuint id = 0;
    glCreateVertexArrays(1, &id);
    return VertexArrayObject(id);
}

QueryObject makeCaptureQuery() {
    GLuint id = 0;
    glCreateQueries(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, 1, &id);
    return QueryObject(id);
}

QueryObject makeTimestampQuery() {
    GLuint id = 0;
    glCreateQueries(GL_TIMESTAMP, 1, &id);
    return QueryObject(id);
}

}  // namespace kaustik::gl
