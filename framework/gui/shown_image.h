// SPDX-License-Identifier: MIT
// What is on the screen, as one description: which values, of what, in which unit and space, of
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
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> metadata(
        const Document& document) const;
    [[nodiscard]] bool contains(glm::ivec2 pixel) const;
};

// Both sides of the split, and what a difference is to be taken of.
struct Showing {
    std::optional<ShownImage> main;
    std::optional<ShownImage> compared;    // to the right of the split, where there is one
    std::string words;                     // in the place of an image
    std::optional<ShownImage> subtrahend;  // where a difference is asked for
    std::string comparedProblem;  // why nothing is to the right of the split although asked for
};

// `reference`: of the same document as the result, or nothing is shown of it.
[[nodiscard]] Showing showingOf(const ShownRequest& requested, const FrameResult& result,
                                const ReferenceState& reference);

// How good a reference is: "8 million photons, its own noise 2.1 %".
[[nodiscard]] std::string noteOf(const ReferenceState& reference);

// Why two images cannot stand next to each other at one scale; "" where they can.
[[nodiscard]] std::string whyNotComparable(const ShownImage& a, const ShownImage& b);

// The range and the exposure that a look has over these values.
[[nodiscard]] ToneMapping mappingOf(const Look& look, const TextureContent& content,
                                    const Histogram& histogram, bool isEncoded);

// The name of what a look's channel shows: "depth, m".
[[nodiscard]] std::string channelLabel(const TextureContent& content, Channel channel);

}  // namespace kaustik::gui
