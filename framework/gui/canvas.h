// SPDX-License-Identifier: MIT
// Images as the window shows them: values of any range become colours on the device, by exposure or
// by false colours; what is no number is flagged. Lives in the window's context.
#pragma once

#include <array>
#include <cstdint>

#include "framework/gl/objects.h"
#include "framework/gl/program.h"
#include "framework/gui/look.h"
#include "framework/gui/texture_content.h"
#include "framework/image/image.h"

namespace kaustik::gui {

// How values become colours.
struct ToneMapping {
    bool isEncoded = false;  // display-encoded already: shown as it is, but for the channel
    bool leavesOut = false;  // values that are NaN are none, and not flagged
    ValueKind kind = ValueKind::color;
    Channel channel = Channel::color;
    float exposureStops = 0.0f;  // linear values are multiplied by 2^exposure, then encoded
    bool isFalseColor = false;   // of the channel, the luminance or the length, from low to high
    Scale scale = Scale::linear;
    float low = 0.0f;
    float high = 1.0f;
    friend bool operator==(const ToneMapping&, const ToneMapping&) = default;
};

class Canvas {
  public:
    Canvas();

    // Shows `image` in a slot; uploads it only if `version` is another than before.
    void show(std::size_t slot, const Image& image, std::uint64_t version,
              const ToneMapping& mapping);
    // The mapped texture, top row first, as ImGui takes it, to be drawn `zoom` window pixels a
    // pixel: pixels stay pixels where they are enlarged.
    [[nodiscard]] void* texture(std::size_t slot, float zoom) const;
    // The same read back: RGB, display-encoded; waits for the device.
    [[nodiscard]] Image read(std::size_t slot) const;
    // The first slots are the two sides of the split, then small pictures of a pass's textures,
    // then those to choose by.
    static constexpr std::size_t kSides = 2;
    static constexpr std::size_t kThumbnails = 24;
    static constexpr std::size_t kFirstChoice = kSides + kThumbnails;
    static constexpr std::size_t kChoices = 64;
    static constexpr std::size_t kSlots = kFirstChoice + kChoices;

  private:
    struct Slot {
        gl::Object<gl::detail::deleteTexture> values;
        gl::Object<gl::detail::deleteTexture> mapped;
        gl::FramebufferObject framebuffer;
        std::uint64_t version = 0;
        int width = 0;
        int height = 0;
        int channels = 0;
        ToneMapping mapping;
    };
    void upload(Slot& slot, const Image& image);
    void map(Slot& slot);

    std::array<Slot, kSlots> slots_;
    gl::Object<gl::detail::deleteTexture> palette_;
    gl::VertexArrayObject vertexArray_;
    gl::Program program_;
};

}  // namespace kaustik::gui
