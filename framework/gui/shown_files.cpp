// SPDX-License-Identifier: MIT
#include "framework/gui/shown_files.h"

#include "framework/core/files.h"

namespace kaustik::gui {
namespace {
namespace fs = std::filesystem;

// PFM holds one or three channels.
Image forPfm(const Image& image) {
    const int channels = image.channels >= 3 ? 3 : 1;
    if (channels == image.channels) return image;
    Image part(image.width, image.height, channels);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < channels; ++c)
                part.at(x, y, c) = image.at(x, y, c);
        }
    }
    return part;
}

}  // namespace

std::vector<fs::path> writeShown(const fs::path& folder, const std::string& name,
                                 const Image& values, const Image& seen, const Metadata& metadata) {
    fs::create_directories(folder);
    const fs::path valuesFile = folder / (name + floatImageExtension());
    const fs::path seenFile = folder / (name + displayImageExtension());
    if (!hasImageModule()) {
        writeImage(valuesFile, forPfm(values));
        writeImage(seenFile, seen);
        std::string text;
        for (const auto& [keyword, value] : metadata)
            text += keyword + ": " + value + "\n";
        writeFileWhole(folder / (name + ".txt"), text);
        return {valuesFile, seenFile, folder / (name + ".txt")};
    }
    writeImage(valuesFile, values);
    writeFileWhole(valuesFile, withExrAttributes(readFile(valuesFile), metadata));
    writeImage(seenFile, seen);
    writeFileWhole(seenFile, withPngText(readFile(seenFile), metadata));
    return {valuesFile, seenFile};
}

}  // namespace kaustik::gui
