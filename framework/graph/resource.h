// SPDX-License-Identifier: MIT
// What flows through the graph: descriptions of textures and buffers, and the typed handles that
// name one version of one of them. No OpenGL here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

namespace kaustik::graph {

enum class Format { r32f, rg32f, rgba32f, rgba16f, rgba8, r32ui, rg32ui, rgba32ui, depth32f };

[[nodiscard]] std::size_t bytesPerTexel(Format format);
[[nodiscard]] const char* formatName(Format format);

struct TextureDesc {
    int width = 1;
    int height = 1;
    Format format = Format::rgba32f;
    int layers = 0;  // 0: a plain 2D texture; else a 2D array
    friend bool operator==(const TextureDesc&, const TextureDesc&) = default;
    [[nodiscard]] std::size_t bytes() const;
};

struct BufferDesc {
    std::size_t byteCount = 0;
    friend bool operator==(const BufferDesc&, const BufferDesc&) = default;
    [[nodiscard]] std::size_t bytes() const { return byteCount; }
};

using ResourceDesc = std::variant<TextureDesc, BufferDesc>;
[[nodiscard]] std::size_t bytesOf(const ResourceDesc& desc);

// One version of one resource. Writing gives a new version; the old one is stale from then on.
struct ResourceRef {
    static constexpr std::uint32_t kNone = ~0u;
    std::uint32_t index = kNone;
    std::uint32_t version = 0;
    [[nodiscard]] bool valid() const { return index != kNone; }
    friend bool operator==(const ResourceRef&, const ResourceRef&) = default;
};

// Typed handles. `Content` says what one texel or element means:
//     struct ViewDepth { static constexpr Format format = Format::r32f; static constexpr
//                        const char* unit = "m"; };
template <class Content>
struct Texture : ResourceRef {};
template <class Content>
struct Buffer : ResourceRef {};

// The value that a bypassed pass's output is cleared to.
using ClearValue = std::array<float, 4>;

}  // namespace kaustik::graph
