// SPDX-License-Identifier: MIT
#include "framework/image/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <mutex>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/image/eight_bits.h"
#include "framework/image/image_limits.h"
#include "framework/image/image_wire.h"
#include "framework/image/module_images.h"
#include "framework/image/module_loader.h"
#include "framework/image/pfm.h"
#include "framework/reading/reader_process.h"

namespace kaustik {
namespace fs = std::filesystem;
namespace {

// The process that reads the images that need a module. It is kept, since OpenImageIO takes a
// quarter of a second to load; images of several threads wait for one another.
Image readInReader(const reading::Request& request) {
    static std::mutex mutex;
    static reading::ReaderProcess reader;
    const std::lock_guard lock(mutex);
    Image image = reader.ask<Image>(request);
    const std::string problem = imageSizeProblem(image.width, image.height, image.channels);
    const auto count = static_cast<std::size_t>(image.width) *
                       static_cast<std::size_t>(image.height) *
                       static_cast<std::size_t>(image.channels);
    if (!problem.empty() || image.values.size() != count) {
        throw IoError(fmt::format("{} cannot be read: it is damaged.", request.name));
    }
    return image;
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
    if (extension == ".exr") return encodeExr(image, name);
    if (extension == ".png") return encodePng(image, toEightBits(image), name);
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

bool hasImageModule() {
    return imageModule().functions != nullptr;
}

std::string imageFormats() {
    return hasImageModule() ? imageModule().functions->formats
                            : "PFM and PPM only: " + imageModule().problem;
}

std::string floatImageExtension() {
    return hasImageModule() ? ".exr" : ".pfm";
}

std::string displayImageExtension() {
    return hasImageModule() ? ".png" : ".ppm";
}

Image readImage(const fs::path& path) {
    const std::string extension = lowerCaseExtension(path);
    const std::string name = path.string();
    if (extension == ".pfm") return decodePfm(readFile(path), name);
    if (extension == ".ppm") return decodePpm(readFile(path), name);
    // Looked at first, because OpenImageIO says little about a directory or a missing file.
    std::error_code error;
    if (!fs::is_regular_file(path, error)) (void)readFile(path);
    return readInReader({reading::RequestKind::image, name, path, ""});
}

Image decodeImage(std::string_view bytes, const std::string& name) {
    if (bytes.starts_with("PF") || bytes.starts_with("Pf")) return decodePfm(bytes, name);
    if (bytes.starts_with("P6")) return decodePpm(bytes, name);
    return readInReader({reading::RequestKind::image, name, "", std::string(bytes)});
}

void writeImage(const fs::path& path, const Image& image) {
    const std::string name = path.string();
    const std::string problem = imageSizeProblem(image.width, image.height, image.channels);
    if (!problem.empty()) throw IoError(fmt::format("{} cannot be written: it {}.", name, problem));
    // Encoded in memory first: a full disk is then met by one writer, which leaves nothing behind.
    writeFileWhole(path, encodeImage(lowerCaseExtension(path), image, name));
}

}  // namespace kaustik
