// SPDX-License-Identifier: MIT
#include "framework/image/layered_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <system_error>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/image/image_limits.h"
#include "framework/image/layered_wire.h"
#include "framework/image/module_images.h"
#include "framework/reading/reader_process.h"

namespace kaustik {
namespace {

namespace fs = std::filesystem;

constexpr std::array kColors{"R", "G", "B"};

std::string channelName(const std::string& prefix, const char* color) {
    return prefix.empty() ? color : prefix + "." + color;
}

std::size_t placeOf(const std::vector<std::string>& channels, const std::string& name) {
    return static_cast<std::size_t>(std::find(channels.begin(), channels.end(), name) -
                                    channels.begin());
}

}  // namespace

void LayeredImage::addLayer(const std::string& prefix, const Image& image) {
    assert(image.channels == 3);
    assert(channels.empty() || (image.width == width && image.height == height));
    width = image.width;
    height = image.height;
    const std::size_t before = channels.size();
    const std::size_t after = before + kColors.size();
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    std::vector<float> all(pixels * after);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        const auto target = all.begin() + static_cast<std::ptrdiff_t>(pixel * after);
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(pixel * before), before, target);
        std::copy_n(image.values.begin() + static_cast<std::ptrdiff_t>(pixel * kColors.size()),
                    kColors.size(), target + static_cast<std::ptrdiff_t>(before));
    }
    values = std::move(all);
    for (const char* color : kColors)
        channels.push_back(channelName(prefix, color));
}

bool LayeredImage::hasLayer(const std::string& prefix) const {
    return std::all_of(kColors.begin(), kColors.end(), [&](const char* color) {
        return placeOf(channels, channelName(prefix, color)) < channels.size();
    });
}

Image LayeredImage::layer(const std::string& prefix, const std::string& name) const {
    Image image(width, height, 3);
    for (std::size_t color = 0; color < kColors.size(); ++color) {
        const std::string channel = channelName(prefix, kColors.at(color));
        const std::size_t place = placeOf(channels, channel);
        if (place == channels.size())
            throw IoError(fmt::format("{} has no channel '{}'.", name, channel));
        for (std::size_t pixel = 0; pixel < image.values.size() / 3; ++pixel)
            image.values[3 * pixel + color] = values[pixel * channels.size() + place];
    }
    return image;
}

std::string LayeredImage::attribute(std::string_view name) const {
    for (const Attribute& known : attributes) {
        if (known.name == name) return known.value;
    }
    return "";
}

void writeLayers(const fs::path& path, const LayeredImage& image) {
    const std::string name = path.string();
    if (path.extension() != ".exr") {
        throw IoError(fmt::format("{} cannot be written: layers are held by .exr alone.", name));
    }
    const std::string problem = layeredSizeProblem(
        image.width, image.height, static_cast<std::int64_t>(image.channels.size()));
    if (!problem.empty()) throw IoError(fmt::format("{} cannot be written: it {}.", name, problem));
    writeFileWhole(path, encodeLayersByModule(image, name));
}

LayeredImage readLayers(const fs::path& path) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) (void)readFile(path);
    const std::string name = path.string();
    reading::ReaderProcess reader;
    auto image =
        reader.ask<LayeredImage>({reading::RequestKind::layers, name, path, std::string()});
    const auto channels = static_cast<std::int64_t>(image.channels.size());
    const auto count = static_cast<std::size_t>(image.width) *
                       static_cast<std::size_t>(image.height) * image.channels.size();
    if (!layeredSizeProblem(image.width, image.height, channels).empty() ||
        image.values.size() != count) {
        throw IoError(fmt::format("{} cannot be read: it is damaged.", name));
    }
    return image;
}

}  // namespace kaustik
