// SPDX-License-Identifier: MIT
// An image on the screen, as one description: which values, of what, in which unit and space, of
// which frame, and how they become colours. Picture, caption, numbers, colour bar and saved files
// are all made of it, so that they cannot differ. Knows no window.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/gui/canvas.h"
#include "framework/gui/shown.h"

namespace kaustik::gui {

// The look of images of error, which are no texture of the graph.
inline constexpr const char* kErrorResource = "error";
inline constexpr const char* kDifferenceResource = "difference";

// A scale with the colours of an image next to it.
struct ColorBar {
    bool isFalseColor = false;
    Scale scale = Scale::linear;
    double low = 0.0;  // of the channel's unit
    double high = 1.0;
    std::string label;  // "caustic irradiance, W/m²"
    // Whether the image has values beyond the ends, which have the colours of these.
    bool clipsLow = false;
    bool clipsHigh = false;
    struct Tick {
        double place = 0.0;  // from 0 to 1
        std::string label;
    };
    std::vector<Tick> ticks;
    // Their labels are of this power of ten, so that very small and very large ones are short.
    int power = 0;
    // Display-encoded, at a place from 0 to 1.
    [[nodiscard]] std::array<float, 3> colorAt(double place) const;
};

struct ShownImage {
    std::string resource;  // whose look it has: a texture's name, "" the picture, "error"
    std::string source;    // "A", "B", "reference", … ; "" where there is only one
    std::string layerName;
    TextureContent content;
    std::string place;  // "the eye's view"
    // What is not as was asked for: "quick picture", "from before the last change"; else "".
    std::string age;
    std::string note;                   // of the reference: its photons and its own error
    std::shared_ptr<const void> owner;  // of the values, where the image has to keep them
    const Image* values = nullptr;      // never null
    std::uint64_t version = 0;          // of the values: no others have it
    // What it was rendered by, and, of a difference, what was taken off; a reference has no
    // technique.
    std::shared_ptr<const PictureOrigin> origin;
    std::shared_ptr<const PictureOrigin> originOfSubtrahend;
    std::vector<ViewedTexture::Region> regions;
    Histogram histogram;  // of what is looked at
    Look look;
    ToneMapping mapping;        // that follows of the look and the values
    bool takesOverlay = false;  // it is a picture by the eye: what is drawn over that fits

    [[nodiscard]] std::string name() const { return resource.empty() ? "picture" : resource; }
    // One line: what it is, of what, in which unit.
    [[nodiscard]] std::string caption() const;
    // The pixel, and each channel with its name and unit; "" where there is no value.
    [[nodiscard]] std::string valuesAt(glm::ivec2 pixel) const;
    // The same for in the pixel: numbers alone, a line each.
    [[nodiscard]] std::string numbersAt(glm::ivec2 pixel) const;
    // None of what is display-encoded.
    [[nodiscard]] std::optional<ColorBar> colorBar() const;
    // Channels by name that a look may choose.
    [[nodiscard]] std::vector<std::pair<Channel, std::string>> channels() const;
    // What a file of it says of itself.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> metadata() const;
    // What it was rendered by: "pool, exact_rays, emit.photons=64x64, 400×300 px"; of a difference
    // both.
    [[nodiscard]] std::string identity() const;
    [[nodiscard]] bool contains(glm::ivec2 pixel) const;
};

// "10⁻⁴".
[[nodiscard]] std::string powerText(int exponent);
// Round numbers on a scale from `low` to `high`, at their places.
[[nodiscard]] std::vector<ColorBar::Tick> ticksOn(Scale scale, double low, double high);

// The range and the exposure that a look has over these values.
[[nodiscard]] ToneMapping mappingOf(const Look& look, const TextureContent& content,
                                    const Histogram& histogram, bool isEncoded);

// Of what a look shows of it: all channels of colour, one of them, or what they are together.
[[nodiscard]] const Histogram& histogramFor(Histograms& histograms, const Image& values,
                                            const TextureContent& content, const Look& look);

// The channel that is looked at by itself; -1: all of a colour or a vector.
[[nodiscard]] int singleChannel(const TextureContent& content, Channel channel);

// The name of what a look's channel shows: "depth, m".
[[nodiscard]] std::string channelLabel(const TextureContent& content, Channel channel);

}  // namespace kaustik::gui
