// SPDX-License-Identifier: MIT
// OpenGL objects that delete themselves; moved, never copied. Direct state access throughout.
#pragma once

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "framework/graph/resource.h"

namespace kaustik::gl {

// A name and the function that deletes it.
template <void (*Delete)(GLuint)>
class Object {
  public:
    Object() = default;
    explicit Object(GLuint id) : id_(id) {}
    Object(Object&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Object& operator=(Object&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~Object() {
        if (id_ != 0) Delete(id_);
    }
    [[nodiscard]] GLuint id() const { return id_; }
    [[nodiscard]] bool valid() const { return id_ != 0; }

  private:
    GLuint id_ = 0;
};

namespace detail {
void deleteTexture(GLuint id);
void deleteBuffer(GLuint id);
void deleteFramebuffer(GLuint id);
void deleteVertexArray(GLuint id);
void deleteProgram(GLuint id);
void deleteShader(GLuint id);
void deleteQuery(GLuint id);
}  // namespace detail

using FramebufferObject = Object<detail::deleteFramebuffer>;
using VertexArrayObject = Object<detail::deleteVertexArray>;
using ProgramObject = Object<detail::deleteProgram>;
using ShaderObject = Object<detail::deleteShader>;
using QueryObject = Object<detail::deleteQuery>;

// The OpenGL names of a graph format.
struct FormatInfo {
    GLenum internalFormat;
    GLenum format;
    GLenum type;
    int channels;
    bool isInteger;
};
[[nodiscard]] FormatInfo formatInfo(graph::Format format);

// A texture of a graph description; nearest sampling, clamped to the edge. An image texture has
// mip levels instead, and is sampled trilinearly and repeated.
class Texture {
  public:
    Texture() = default;
    Texture(const graph::TextureDesc& desc, const std::string& label, bool isImage = false);
    [[nodiscard]] GLuint id() const { return object_.id(); }
    [[nodiscard]] const graph::TextureDesc& desc() const { return desc_; }
    void clear(const graph::ClearValue& value) const;
    // Replaces one layer of an RGBA array texture; bottom row first.
    void upload(int layer, const std::vector<float>& rgba) const;
    void generateMipmaps() const;
    // Copies all layers to a texture of the same description.
    void copyTo(const Texture& target) const;
    // All layers as floats (integers are converted), channels interleaved, bottom row first.
    // Waits for the device.
    [[nodiscard]] std::vector<float> read() const;
    // The first rows of a plain texture of floats, to read and to write; four channels.
    [[nodiscard]] std::vector<glm::vec4> readRows(int rows) const;
    void writeRows(const std::vector<glm::vec4>& texels) const;
    // All layers of a texture of whole numbers, exactly and in the same order. Throws GraphError
    // where the texture does not have whole numbers.
    [[nodiscard]] std::vector<std::uint32_t> readWords() const;

  private:
    Object<detail::deleteTexture> object_;
    graph::TextureDesc desc_;
};

class Buffer {
  public:
    Buffer() = default;
    Buffer(std::size_t bytes, const void* data, const std::string& label);
    template <class T>
    Buffer(const std::vector<T>& values, const std::string& label)
        : Buffer(values.size() * sizeof(T), values.data(), label) {}
    [[nodiscard]] GLuint id() const { return object_.id(); }
    [[nodiscard]] std::size_t bytes() const { return bytes_; }
    void upload(std::size_t offset, std::size_t byteCount, const void* data) const;
    // All of these, to its begin.
    template <class T>
    void upload(const std::vector<T>& values) const {
        if (!values.empty()) upload(0, values.size() * sizeof(T), values.data());
    }
    void clear() const;
    // Copies everything to a buffer that is at least as large.
    void copyTo(const Buffer& target) const;
    // A buffer texture of it, of 32 bits a channel: shaders fetch as many words at once as it has
    // channels. Throws GraphError where a device allows no texture as long as it.
    [[nodiscard]] GLuint texels(graph::Format format) const;
    // Waits for the device.
    template <class T>
    [[nodiscard]] std::vector<T> read() const {
        return readFirst<T>(bytes_ / sizeof(T));
    }
    // So many, from its begin.
    template <class T>
    [[nodiscard]] std::vector<T> readFirst(std::size_t count) const {
        std::vector<T> values(std::min(count, bytes_ / sizeof(T)));
        readBytes(values.data(), values.size() * sizeof(T));
        return values;
    }

  private:
    void readBytes(void* destination, std::size_t byteCount) const;
    Object<detail::deleteBuffer> object_;
    std::size_t bytes_ = 0;
    mutable std::map<graph::Format, Object<detail::deleteTexture>> texels_;  // made when asked for
};

[[nodiscard]] FramebufferObject makeFramebuffer();
[[nodiscard]] VertexArrayObject makeVertexArray();
[[nodiscard]] QueryObject makeTimestampQuery();
// A query that counts the points that transform feedback has written.
[[nodiscard]] QueryObject makeCaptureQuery();

}  // namespace kaustik::gl
