// SPDX-License-Identifier: MIT
// What the texels of a graph's texture mean, for whoever looks at one: names and units of its
// channels, the space that it is in, and what its layers are of. Textures are known by their names,
// which say what they hold (framework/transport/texels.h has the same for shaders).
#pragma once

#include <string>
#include <vector>

#include "framework/graph/resource.h"

namespace kaustik::gui {

// Where a texel lies. eye: a pixel of the picture. light, cube: a texel of a light's view, or of
// the faces around a body. list: a photon, in the order of its list. other: a grid of its own.
enum class TextureSpace { eye, light, cube, list, other };
[[nodiscard]] const char* describe(TextureSpace space);  // "the eye's view"

// color: linear RGB of one unit. vector: x, y, z of one unit. single: channels that have nothing to
// do with each other, of which one is looked at. sums: words of 64-bit fixed point
// (transport::kFluxWords), which are RGB once they are put together.
enum class ValueKind { color, vector, single, sums };

struct ChannelContent {
    std::string name;
    std::string unit;  // "" for a number
    friend bool operator==(const ChannelContent&, const ChannelContent&) = default;
};

struct TextureContent {
    std::string quantity;  // "irradiance"
    ValueKind kind = ValueKind::single;
    TextureSpace space = TextureSpace::other;
    std::vector<ChannelContent> channels;  // of the values as they are shown
    bool isKnown = true;                   // else all of it is guessed by the format
    // Of its first channel, which all of a colour or a vector have.
    [[nodiscard]] const std::string& unit() const;
};

// Of a texture of the graph by its full name, "hits.flux_1".
[[nodiscard]] TextureContent contentOf(const std::string& name, const graph::TextureDesc& desc);
// Of the picture, display-encoded.
[[nodiscard]] TextureContent pictureContent();

// "m²", "W/m²": of a channel next to its name: "depth, m"; "share" where there is no unit.
[[nodiscard]] std::string labelOf(const ChannelContent& channel);

}  // namespace kaustik::gui
