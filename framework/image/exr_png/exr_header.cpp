// SPDX-License-Identifier: MIT
#include "framework/image/exr_png/exr_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace kaustik {
namespace {

// What is left of a header's bytes, read from its front.
class HeaderBytes {
  public:
    explicit HeaderBytes(std::string_view bytes) : bytes_(bytes) {}
    std::string_view text() {  // to the zero byte that ends it
        const std::size_t length = bytes_.find('\0');
        const std::string_view found = take(length);
        bytes_.remove_prefix(std::min<std::size_t>(1, bytes_.size()));
        return found;
    }
    std::uint32_t word() {
        std::uint32_t value = 0;
        for (int i = 0; const char byte : take(4))
            value |= std::uint32_t{static_cast<unsigned char>(byte)} << (8 * i++);
        return value;
    }
    std::string_view take(std::size_t count) {
        if (count > bytes_.size())
            throw std::runtime_error("it is damaged or cut off (its header ends early)");
        const std::string_view taken = bytes_.substr(0, count);
        bytes_.remove_prefix(count);
        return taken;
    }
    [[nodiscard]] bool isEmpty() const { return bytes_.empty(); }

  private:
    std::string_view bytes_;
};

// Of attributes that are read by their type, whatever size the file gives them.
constexpr std::array<std::pair<std::string_view, std::size_t>, 24> kAttributeBytes{{
    {"box2i", 16},
    {"box2f", 16},
    {"chromaticities", 32},
    {"compression", 1},
    {"deepImageState", 1},
    {"double", 8},
    {"envmap", 1},
    {"float", 4},
    {"int", 4},
    {"keycode", 28},
    {"lineOrder", 1},
    {"m33d", 72},
    {"m33f", 36},
    {"m44d", 128},
    {"m44f", 64},
    {"rational", 8},
    {"tiledesc", 9},
    {"timecode", 8},
    {"v2d", 16},
    {"v2f", 8},
    {"v2i", 8},
    {"v3d", 24},
    {"v3f", 12},
    {"v3i", 12},
}};

// Whether `value` is what an attribute of that type has, to its last byte.
bool isAttributeWhole(std::string_view type, std::string_view value) {
    for (const auto& [name, size] : kAttributeBytes) {
        if (name == type) return value.size() == size;
    }
    HeaderBytes rest(value);
    if (type == "chlist") {
        constexpr std::size_t kBytesPerChannel = 16;
        while (!rest.text().empty())
            rest.take(kBytesPerChannel);
        return rest.isEmpty();
    }
    if (type == "floatvector") return value.size() % sizeof(float) == 0;
    if (type == "stringvector") {
        while (!rest.isEmpty())
            rest.take(rest.word());
    } else if (type == "preview") {
        const std::uint64_t width = rest.word();
        const std::uint64_t height = rest.word();
        return width * height <= value.size() && value.size() == 8 + 4 * width * height;
    }
    return true;
}

}  // namespace

void requireWholeAttributes(std::string_view bytes) {
    constexpr std::uint32_t kMultiPart = 0x1000;
    HeaderBytes header(bytes);
    header.take(4);  // the magic number
    const bool hasParts = (header.word() & kMultiPart) != 0;
    do {
        std::string_view name = header.text();
        if (name.empty()) return;  // the header that ends those of parts
        for (; !name.empty(); name = header.text()) {
            const std::string_view type = header.text();
            if (!isAttributeWhole(type, header.take(header.word()))) {
                throw std::runtime_error(
                    fmt::format("it is damaged (its attribute '{}' of type '{}' has another size)",
                                name, type));
            }
        }
    } while (hasParts);
}

}  // namespace kaustik
