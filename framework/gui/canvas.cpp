// SPDX-License-Identifier: MIT
#include "framework/gui/canvas.h"

#include <cmath>
#include <vector>

namespace kaustik::gui {
namespace {

constexpr int kPaletteSize = 256;

gl::Object<gl::detail::deleteTexture> makeTexture(GLenum format, int width, int height) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &id);
    gl::Object<gl::detail::deleteTexture> texture(id);
    glTextureStorage2D(id, 1, format, width, height);
    glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

}  // namespace

Canvas::Canvas()
    : palette_(makeTexture(GL_RGBA8, kPaletteSize, 2)),
      vertexArray_(gl::makeVertexArray()),
      program_({{"framework/fullscreen.vert", "gui/tone.frag"}, ""}) {
    std::vector<float> colors;
    for (const Scale scale : {Scale::linear, Scale::symmetric}) {
        for (int i = 0; i < kPaletteSize; ++i) {
            for (const float c : falseColor(scale, double(i) / (kPaletteSize - 1)))
                colors.push_back(c);
        }
    }
    glTextureSubImage2D(palette_.id(), 0, 0, 0, kPaletteSize, 2, GL_RGB, GL_FLOAT, colors.data());
}

void Canvas::show(std::size_t slotIndex, const Image& image, std::uint64_t version,
                  const ToneMapping& mapping) {
    Slot& slot = slots_[slotIndex];
    const bool isNew = slot.version != version || slot.width != image.width ||
                       slot.height != image.height || slot.channels != image.channels;
    if (isNew) {
        upload(slot, image);
        slot.version = version;
    }
    if (isNew || !(slot.mapping == mapping)) {
        slot.mapping = mapping;
        map(slot);
    }
}

void* Canvas::texture(std::size_t slot, float zoom) const {
    const GLuint id = slots_[slot].mapped.id();
    // One filter for both: a software rasteriser pays for choosing between two at each pixel.
    const GLint filter = zoom < 1.0f ? GL_LINEAR : GL_NEAREST;
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, filter);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, filter);
    return reinterpret_cast<void*>(static_cast<std::uintptr_t>(id));
}

Image Canvas::read(std::size_t slotIndex) const {
    const Slot& slot = slots_[slotIndex];
    Image image(slot.width, slot.height, 3);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glGetTextureImage(slot.mapped.id(), 0, GL_RGB, GL_FLOAT,
                      static_cast<GLsizei>(image.values.size() * sizeof(float)),
                      image.values.data());
    return image;
}

void Canvas::upload(Slot& slot, const Image& image) {
    static constexpr std::array<GLenum, 4> kStored = {GL_R32F, GL_RG32F, GL_RGB32F, GL_RGBA32F};
    static constexpr std::array<GLenum, 4> kGiven = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
    const auto format = static_cast<std::size_t>(image.channels - 1);
    if (slot.width != image.width || slot.height != image.height ||
        slot.channels != image.channels || !slot.values.valid()) {
        slot.values = makeTexture(kStored[format], image.width, image.height);
        slot.mapped = makeTexture(GL_RGBA8, image.width, image.height);
        slot.framebuffer = gl::makeFramebuffer();
        glNamedFramebufferTexture(slot.framebuffer.id(), GL_COLOR_ATTACHMENT0, slot.mapped.id(), 0);
        slot.width = image.width;
        slot.height = image.height;
        slot.channels = image.channels;
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage2D(slot.values.id(), 0, 0, 0, image.width, image.height, kGiven[format],
                        GL_FLOAT, image.values.data());
}

void Canvas::map(Slot& slot) {
    const ToneMapping& mapping = slot.mapping;
    glBindFramebuffer(GL_FRAMEBUFFER, slot.framebuffer.id());
    glViewport(0, 0, slot.width, slot.height);
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glUseProgram(program_.id());
    glBindTextureUnit(0, slot.values.id());
    glBindTextureUnit(1, palette_.id());
    glUniform1i(program_.uniform("values"), 0);
    glUniform1i(program_.uniform("palette"), 1);
    glUniform1i(program_.uniform("channels"), slot.channels);
    glUniform1i(program_.uniform("channel"), static_cast<int>(mapping.channel));
    // Sums are put together by the time that they are shown.
    const int kind = mapping.kind == ValueKind::vector   ? 1
                     : mapping.kind == ValueKind::single ? 2
                                                         : 0;
    glUniform1i(program_.uniform("kind"), kind);
    glUniform1i(program_.uniform("scale"), static_cast<int>(mapping.scale));
    glUniform1i(program_.uniform("leavesOut"), mapping.leavesOut ? 1 : 0);
    glUniform1i(program_.uniform("isEncoded"), mapping.isEncoded ? 1 : 0);
    glUniform1i(program_.uniform("isFalseColor"), mapping.isFalseColor ? 1 : 0);
    glUniform1f(program_.uniform("gain"), std::exp2(mapping.exposureStops));
    glUniform2f(program_.uniform("range"), mapping.low, mapping.high);
    glBindVertexArray(vertexArray_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    glUseProgram(0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace kaustik::gui
