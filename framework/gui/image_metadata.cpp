// SPDX-License-Identifier: MIT
#include "framework/gui/image_metadata.h"

#include <array>
#include <cstdint>
#include <cstring>

#include "framework/core/error.h"

namespace kaustik::gui {
namespace {

std::uint32_t crcOf(const std::string& bytes) {
    static const std::array<std::uint32_t, 256> table = [] {
        std::array<std::uint32_t, 256> made{};
        for (std::uint32_t i = 0; i < 256; ++i) {
            std::uint32_t value = i;
            for (int bit = 0; bit < 8; ++bit)
                value = (value & 1u) != 0 ? 0xedb88320u ^ (value >> 1u) : value >> 1u;
            made[i] = value;
        }
        return made;
    }();
    std::uint32_t crc = 0xffffffffu;
    for (const char c : bytes)
        crc = table[(crc ^ static_cast<unsigned char>(c)) & 0xffu] ^ (crc >> 8u);
    return crc ^ 0xffffffffu;
}

void appendBigEndian(std::string& bytes, std::uint32_t value) {
    for (const unsigned shift : {24u, 16u, 8u, 0u})
        bytes += static_cast<char>((value >> shift) & 0xffu);
}

void appendLittleEndian(std::string& bytes, std::uint32_t value) {
    for (const unsigned shift : {0u, 8u, 16u, 24u})
        bytes += static_cast<char>((value >> shift) & 0xffu);
}

std::uint64_t littleEndian(const std::string& bytes, std::size_t at, std::size_t count) {
    if (at + count > bytes.size()) throw IoError("The OpenEXR file is cut short.");
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
        value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
    return value;
}

}  // namespace

std::string withPngText(const std::string& png, const Metadata& metadata) {
    // Signature and the header's chunk, which comes first.
    constexpr std::size_t kBegin = 8 + 4 + 4 + 13 + 4;
    if (png.size() < kBegin || png.compare(0, 8, "\x89PNG\r\n\x1a\n", 8) != 0)
        throw IoError("The file is no PNG.");
    std::string chunks;
    for (const auto& [keyword, text] : metadata) {
        std::string data = keyword.substr(0, 79);
        // Not compressed, no language, no translated keyword.
        data += std::string("\0\0\0\0\0", 5) + text;
        const std::string body = "iTXt" + data;
        appendBigEndian(chunks, static_cast<std::uint32_t>(data.size()));
        chunks += body;
        appendBigEndian(chunks, crcOf(body));
    }
    return png.substr(0, kBegin) + chunks + png.substr(kBegin);
}

std::string withExrAttributes(const std::string& exr, const Metadata& metadata) {
    if (exr.size() < 8 || exr.compare(0, 4, "\x76\x2f\x31\x01", 4) != 0)
        throw IoError("The file is no OpenEXR file.");
    const auto textAt = [&](std::size_t& at) {
        const std::size_t end = exr.find('\0', at);
        if (end == std::string::npos) throw IoError("The OpenEXR file is cut short.");
        std::string text = exr.substr(at, end - at);
        at = end + 1;
        return text;
    };
    std::size_t at = 8;
    while (!textAt(at).empty()) {
        textAt(at);  // the type
        at += 4 + static_cast<std::size_t>(littleEndian(exr, at, 4));
    }
    const std::size_t headerEnd = at - 1;  // its closing zero
    std::string attributes;
    for (const auto& [keyword, text] : metadata) {
        attributes += "kaustik." + keyword + '\0' + "string" + '\0';
        appendLittleEndian(attributes, static_cast<std::uint32_t>(text.size()));
        attributes += text;
    }
    std::string result = exr.substr(0, headerEnd) + attributes + '\0';
    // Places of the chunks follow, from the file's beginning; the first chunk lies behind them.
    const std::uint64_t first = littleEndian(exr, at, 8);
    if (first < at || first > exr.size() || (first - at) % 8 != 0)
        throw IoError("The OpenEXR file has no table of its chunks.");
    for (; at < first; at += 8) {
        const std::uint64_t moved = littleEndian(exr, at, 8) + attributes.size();
        appendLittleEndian(result, static_cast<std::uint32_t>(moved & 0xffffffffu));
        appendLittleEndian(result, static_cast<std::uint32_t>(moved >> 32u));
    }
    return result + exr.substr(first);
}

}  // namespace kaustik::gui
