// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

// The one place that compiles tinygltf.
#define TINYGLTF_IMPLEMENTATION
#include <fmt/format.h>

#include <cctype>
#include <cstdint>
#include <exception>
#include <limits>
#include <system_error>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/importers/gltf_document.h"

namespace kaustik::scene {
namespace {
namespace fs = std::filesystem;

using Json = nlohmann::json;

std::uint32_t number32(std::string_view bytes, std::size_t at) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        number |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
    }
    return number;
}

bool isGlb(std::string_view bytes) {
    return bytes.starts_with("glTF");
}

Json parseGltfJson(std::string_view text, const std::string& name) {
    try {
        return Json::parse(text);
    } catch (const Json::exception& error) {
        throw IoError(
            fmt::format("{} is damaged or cut off: {}. Export it again.", name, error.what()));
    }
}

bool isDataUri(const std::string& uri) {
    return uri.starts_with("data:");
}

// What tinygltf says about a buffer names neither the field nor the sizes.
void checkBufferFiles(const Json& document, const fs::path& path, bool binary) {
    const Json buffers = document.value("buffers", Json::array());
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const auto length = buffers[i]["byteLength"].get<std::uint64_t>();
        if (!buffers[i].contains("uri")) {
            if (binary && i == 0) continue;
            throw IoError(fmt::format("{}: buffers[{}].uri is missing. Export the file again.",
                                      path.string(), i));
        }
        const std::string uri = buffers[i]["uri"];
        if (isDataUri(uri)) continue;
        const fs::path file = gltfUriToFile(path, uri);
        std::error_code error;
        const std::uintmax_t size = fs::file_size(file, error);
        if (error) {
            throw IoError(
                fmt::format("{}: buffers[{}].uri names {}, which cannot be read: {}. Put "
                            "it beside the scene.",
                            path.string(), i, file.string(), error.message()));
        }
        if (size != length) {
            throw IoError(fmt::format(
                "{}: buffers[{}].byteLength is {}, but {} has {} bytes. Export the file again.",
                path.string(), i, length, file.string(), size));
        }
    }
}

// Keeps the bytes of a data URI. Those in a buffer view stay where they are: tinygltf hands over a
// pointer into the buffer.
bool keepEncoded(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                 const unsigned char* bytes, int size, void*) {
    if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
    return true;
}

std::string oneLine(std::string text) {
    for (char& c : text)
        c = c == '\n' ? ' ' : c;
    while (!text.empty() && (text.back() == ' ' || text.back() == '.'))
        text.pop_back();
    return text.empty() ? "tinygltf gives no reason" : text;
}

}  // namespace

std::string_view gltfJsonText(std::string_view bytes, const std::string& name) {
    if (!isGlb(bytes)) return bytes;
    const auto fail = [&](const std::string& problem) {
        throw IoError(fmt::format("{} {}. Fetch or export it again.", name, problem));
    };
    // "glTF", the version and the length of the file; then chunks of a length, a kind and data.
    constexpr std::size_t kHeaderBytes = 12;
    constexpr std::size_t kChunkHeaderBytes = 8;
    constexpr std::uint32_t kJsonChunk = 0x4e4f534a;
    if (bytes.size() < kHeaderBytes + kChunkHeaderBytes) fail("is cut off in its header");
    if (number32(bytes, 4) != 2) {
        fail(fmt::format("is GLB version {}; only version 2 can be read", number32(bytes, 4)));
    }
    if (number32(bytes, 8) > bytes.size()) {
        fail(fmt::format("is cut off: {} bytes of {}", bytes.size(), number32(bytes, 8)));
    }
    const std::size_t length = number32(bytes, kHeaderBytes);
    if (number32(bytes, kHeaderBytes + 4) != kJsonChunk) fail("does not begin with a JSON chunk");
    if (length > bytes.size() - kHeaderBytes - kChunkHeaderBytes) {
        fail("is damaged: its JSON chunk ends beyond the file");
    }
    // The other chunks, of which tinygltf reads the second, trusting its length.
    const std::size_t fileLength = number32(bytes, 8);
    for (std::size_t at = kHeaderBytes + kChunkHeaderBytes + length; at < fileLength;) {
        if (fileLength - at < kChunkHeaderBytes) fail("is damaged: its last chunk has no header");
        const std::size_t chunk = number32(bytes, at);
        at += kChunkHeaderBytes;
        if (chunk > fileLength - at) {
            fail(fmt::format("is damaged: a chunk of {} bytes ends {} bytes beyond the file", chunk,
                             chunk - (fileLength - at)));
        }
        at += chunk;
    }
    return bytes.substr(kHeaderBytes + kChunkHeaderBytes, length);
}

fs::path gltfUriToFile(const fs::path& path, const std::string& uri) {
    std::string decoded;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool escaped = uri[i] == '%' && i + 2 < uri.size() &&
                             std::isxdigit(static_cast<unsigned char>(uri[i + 1])) != 0 &&
                             std::isxdigit(static_cast<unsigned char>(uri[i + 2])) != 0;
        decoded +=
            escaped ? static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16)) : uri[i];
        if (escaped) i += 2;
    }
    return path.parent_path() / decoded;
}

tinygltf::Model loadGltfModel(const fs::path& path) {
    const std::string name = path.string();
    const std::string bytes = readFile(path);
    if (bytes.size() > std::numeric_limits<std::uint32_t>::max()) {
        throw IoError(fmt::format("{} is larger than 4 GiB, the limit of glTF.", name));
    }
    const std::string_view text = gltfJsonText(bytes, name);
    {
        const Json document = parseGltfJson(text, name);
        checkGltfJson(document, name);
        checkBufferFiles(document, path, isGlb(bytes));
    }
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(keepEncoded, nullptr);
    tinygltf::Model model;
    std::string problem;
    std::string warning;
    bool loaded = false;
    const std::string folder = path.parent_path().string();
    const auto size = static_cast<unsigned>(bytes.size());
    try {
        loaded = isGlb(bytes)
                     ? loader.LoadBinaryFromMemory(
                           &model, &problem, &warning,
                           reinterpret_cast<const unsigned char*>(bytes.data()), size, folder)
                     : loader.LoadASCIIFromString(&model, &problem, &warning, bytes.data(), size,
                                                  folder);
    } catch (const std::exception& exception) {
        problem = exception.what();
    }
    if (!loaded) {
        throw IoError(
            fmt::format("{} cannot be read as glTF: {}. Export it again.", name, oneLine(problem)));
    }
    return model;
}

}  // namespace kaustik::scene
