// SPDX-License-Identifier: MIT
#include "framework/run/output.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "framework/core/error.h"
#include "framework/gl/objects.h"

namespace kaustik::run {
namespace fs = std::filesystem;
namespace {

// PFM holds one or three channels; what does not fit is written next to it.
std::vector<fs::path> writeAllChannels(const fs::path& path, const Image& image) {
    if (path.extension() != ".pfm" || image.channels == 1 || image.channels == 3) {
        writeImage(path, image);
        return {path};
    }
    std::vector<fs::path> files;
    for (int channel = 0; channel < image.channels; ++channel) {
        Image single(image.width, image.height, 1);
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x)
                single.at(x, y, 0) = image.at(x, y, channel);
        }
        fs::path file = path;
        file.replace_extension(fmt::format("{}.pfm", "xyzw"[channel]));
        writeImage(file, single);
        files.push_back(file);
    }
    return files;
}

}  // namespace

void requireWritable(const fs::path& folder, const std::string& requester) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
        throw IoError(fmt::format("{}: the folder {} cannot be made: {}.", requester,
                                  folder.string(), error.message()));
    }
    // Only a file that is made proves it: permissions say nothing of a full or odd file system.
    std::string probe = (folder / ".kaustik-XXXXXX").string();
    const int descriptor = ::mkstemp(probe.data());
    if (descriptor < 0) {
        throw IoError(fmt::format("{}: nothing can be written into {}: {}.", requester,
                                  folder.string(), std::strerror(errno)));
    }
    ::close(descriptor);
    ::unlink(probe.c_str());
}

bool isTexture(const Renderer& renderer, const std::string& name) {
    const graph::ResourceRef handle = renderer.graph().find(name);
    return handle.valid() &&
           std::holds_alternative<graph::TextureDesc>(renderer.graph().descOf(handle));
}

void requireTextures(const Renderer& renderer, const std::vector<std::string>& saved) {
    for (const std::string& name : saved) {
        if (!isTexture(renderer, name)) {
            throw ConfigError(
                fmt::format("--save: '{}' is a buffer, and only textures can be saved "
                            "('kaustik explain' prints which those are).",
                            name));
        }
    }
}

Image readTexture(const gl::Texture& texture, int layer, int channels) {
    const graph::TextureDesc& desc = texture.desc();
    const auto stored = static_cast<std::size_t>(gl::formatInfo(desc.format).channels);
    const std::vector<float> values = texture.read();
    Image image(desc.width, desc.height, channels);
    const auto width = static_cast<std::size_t>(desc.width);
    const auto height = static_cast<std::size_t>(desc.height);
    for (std::size_t y = 0; y < height; ++y) {
        const std::size_t row = static_cast<std::size_t>(layer) * height + (height - 1 - y);
        for (std::size_t x = 0; x < width; ++x) {
            for (int c = 0; c < channels; ++c) {
                image.at(static_cast<int>(x), static_cast<int>(y), c) =
                    values[(row * width + x) * stored + static_cast<std::size_t>(c)];
            }
        }
    }
    return image;
}

std::vector<fs::path> writePictures(const fs::path& folder, const Renderer& renderer,
                                    const std::vector<std::string>& saved) {
    std::vector<fs::path> files;
    const auto write = [&](const std::string& name, const std::string& extension,
                           const Image& image) {
        for (const fs::path& file : writeAllChannels(folder / (name + extension), image)) {
            files.push_back(file);
        }
    };
    const FrameOutputs& outputs = renderer.outputs();
    write("beauty", displayImageExtension(),
          readTexture(renderer.texture(outputs.picture.display), 0, 3));
    write("beauty", floatImageExtension(),
          readTexture(renderer.texture(outputs.picture.radiance), 0, 3));
    write("caustic", floatImageExtension(),
          readTexture(renderer.texture(outputs.caustic.irradiance), 0, 3));
    if (outputs.caustic.radiance.valid()) {
        write("caustic_radiance", floatImageExtension(),
              readTexture(renderer.texture(outputs.caustic.radiance), 0, 3));
    }
    if (outputs.inScattered.radiance.valid()) {
        write("in_scattered", floatImageExtension(),
              readTexture(renderer.texture(outputs.inScattered.radiance), 0, 3));
    }
    for (const std::string& name : saved) {
        const graph::ResourceRef handle = renderer.graph().find(name);
        const gl::Texture& texture = renderer.texture(handle);
        const int channels = gl::formatInfo(texture.desc().format).channels;
        const int layers = texture.desc().layers;
        for (int layer = 0; layer < std::max(layers, 1); ++layer) {
            write(layers > 0 ? fmt::format("{}.{}", name, layer) : name, floatImageExtension(),
                  readTexture(texture, layer, channels));
        }
    }
    return files;
}

}  // namespace kaustik::run
