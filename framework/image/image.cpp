// SPDX-License-Identifier: MIT
#include "framework/image/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <exception>
#include <functional>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/image/eight_bits.h"
#include "framework/image/image_limits.h"
#include "framework/image/openimageio_loader.h"
#include "framework/image/pfm.h"

namespace kaustik {
namespace fs = std::filesystem;
namespace {

// Receives what the module makes; see KaustikImageSink.
struct Received {
    Image image;
    std::string bytes;
    std::string problem;
};

// No exception may cross the module's C frames, so that running out of memory is a return value
// here.
KaustikImageSink sinkFor(Received& received) {
    KaustikImageSink sink{};
    sink.context = &received;
    sink.allocate = [](void* context, int width, int height, int channels) -> float* {
        try {
            Image& image = static_cast<Received*>(context)->image;
            image = Image(width, height, channels);
            return image.values.data();
        } catch (const std::exception&) {
            return nullptr;
        }
    };
    sink.append = [](void* context, const unsigned char* bytes, std::size_t count) {
        try {
            static_cast<Received*>(context)->bytes.append(reinterpret_cast<const char*>(bytes),
                                                          count);
            return true;
        } catch (const std::exception&) {
            return false;
        }
    };
    sink.fail = [](void* context, const char* message) {
        try {
            static_cast<Received*>(context)->problem = message;
        } catch (const std::exception&) {
            // The caller still learns that it failed.
        }
    };
    return sink;
}

using ModuleCall = std::function<bool(const KaustikOpenImageIoFunctions&, const KaustikImageSink&)>;

// Calls the module; an IoError that names the file where it is missing or fails.
Received callOpenImageIo(const std::string& name, const char* verb, const ModuleCall& call) {
    const OpenImageIoModule& module = openImageIo();
    if (module.functions == nullptr) {
        throw IoError(fmt::format("{} cannot be {}: {}.", name, verb, module.problem));
    }
    Received received;
    const KaustikImageSink sink = sinkFor(received);
    if (!call(*module.functions, sink)) {
        throw IoError(fmt::format("{} cannot be {}: {}.", name, verb,
                                  received.problem.empty() ? "out of memory" : received.problem));
    }
    return received;
}

std::string lowerCaseExtension(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

std::string encodeImage(const std::string& extension, const Image& image, const std::string& name) {
    if (extension == ".pfm" || extension == ".ppm") {
        if (image.channels != 1 && image.channels != 3) {
            throw IoError(fmt::format("{} cannot be written: {} holds 1 or 3 channels, not {}.",
                                      name, extension, image.channels));
        }
        return extension == ".pfm" ? encodePfm(image) : encodePpm(image);
    }
    if (extension == ".exr") {
        return callOpenImageIo(name, "written",
                               [&](const auto& functions, const auto& sink) {
                                   return functions.encodeExr(image.values.data(), image.width,
                                                              image.height, image.channels, &sink);
                               })
            .bytes;
    }
    if (extension == ".png") {
        const std::vector<unsigned char> values = toEightBits(image);
        return callOpenImageIo(name, "written",
                               [&](const auto& functions, const auto& sink) {
                                   return functions.encodePng(values.data(), image.width,
                                                              image.height, image.channels, &sink);
                               })
            .bytes;
    }
    throw IoError(
        fmt::format("{} cannot be written: '{}' is not a kind of image that is written "
                    "here; use .exr or .pfm (float), .png or .ppm (8 bits).",
                    name, extension));
}

}  // namespace

Image::Image(int w, int h, int c) : width(w), height(h), channels(c) {
    assert(w >= 0 && h >= 0 && c >= 0);
    values.resize(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) *
                  static_cast<std::size_t>(c));
}

float& Image::at(int x, int y, int c) {
    assert(x >= 0 && x < width && y >= 0 && y < height && c >= 0 && c < channels);
    return values[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                   static_cast<std::size_t>(x)) *
                      static_cast<std::size_t>(channels) +
                  static_cast<std::size_t>(c)];
}

float Image::at(int x, int y, int c) const {
    return const_cast<Image*>(this)->at(x, y, c);
}

bool hasOpenImageIO() {
    return openImageIo().functions != nullptr;
}

std::string floatImageExtension() {
    return hasOpenImageIO() ? ".exr" : ".pfm";
}

std::string displayImageExtension() {
    return hasOpenImageIO() ? ".png" : ".ppm";
}

Image readImage(const fs::path& path) {
    const std::string extension = lowerCaseExtension(path);
    const std::string name = path.string();
    if (extension == ".pfm") return decodePfm(readFile(path), name);
    if (extension == ".ppm") return decodePpm(readFile(path), name);
    // Looked at first, because OpenImageIO says little about a directory or a missing file.
    std::error_code error;
    if (!fs::is_regular_file(path, error)) (void)readFile(path);
    return callOpenImageIo(name, "read",
                           [&](const auto& functions, const auto& sink) {
                               return functions.readFile(path.c_str(), &sink);
                           })
        .image;
}

Image decodeImage(std::string_view bytes, const std::string& name) {
    if (bytes.starts_with("PF") || bytes.starts_with("Pf")) return decodePfm(bytes, name);
    if (bytes.starts_with("P6")) return decodePpm(bytes, name);
    return callOpenImageIo(name, "read",
                           [&](const auto& functions, const auto& sink) {
                               return functions.readMemory(
                                   reinterpret_cast<const unsigned char*>(bytes.data()),
                                   bytes.size(), &sink);
                           })
        .image;
}

void writeImage(const fs::path& path, const Image& image) {
    const std::string name = path.string();
    const std::string problem = imageSizeProblem(image.width, image.height, image.channels);
    if (!problem.empty()) throw IoError(fmt::format("{} cannot be written: it {}.", name, problem));
    // Encoded in memory first: a full disk is then met by one writer, which leaves nothing behind.
    writeFileWhole(path, encodeImage(lowerCaseExtension(path), image, name));
}

}  // namespace kaustik
