// SPDX-License-Identifier: MIT
#include "framework/scene/foreign/foreign_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/scene/files/mesh_import.h"
#include "framework/scene/files/scene_file_parts.h"
#include "framework/scene/foreign/foreign_text.h"

namespace kaustik::scene {
namespace {
namespace fs = std::filesystem;

constexpr std::array kPictures{".exr", ".png", ".jpg", ".jpeg", ".hdr", ".pfm",
                               ".ppm", ".tga", ".bmp", ".tif",  ".tiff"};

// What is awkward in the name of a file becomes a '-'.
std::string fileName(const std::string& name) {
    std::string safe;
    for (const char c : name) {
        const bool isPlain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                             (c >= '0' && c <= '9') || c == '-' || c == '_';
        safe += isPlain ? c : '-';
    }
    constexpr std::size_t kMaxLength = 80;
    return safe.empty() ? "mesh" : safe.substr(0, kMaxLength);
}

fs::path real(const fs::path& path) {
    std::error_code error;
    const fs::path canonical = fs::weakly_canonical(path.empty() ? "." : path, error);
    return error ? path : canonical;
}

}  // namespace

ForeignFiles::ForeignFiles(const fs::path& sceneFile)
    : sceneFolder_(sceneFile.parent_path()),
      folder_(sceneFolder_ / (sceneFile.stem().string() + "_meshes")) {}

std::string ForeignFiles::mesh(const fs::path& file, reading::ReaderProcess& reader) {
    const std::string below = placeBelow(file);
    if (!below.empty()) return below;
    const auto done = copies_.find(file.string());
    if (done != copies_.end()) return done->second;
    static_cast<void>(importMeshWithWarnings(file, reader));
    return copy(file);
}

std::string ForeignFiles::picture(const fs::path& file, const std::string& place) {
    const std::string extension = lowerExtension(file);
    if (std::find(kPictures.begin(), kPictures.end(), extension) == kPictures.end()) {
        throw ConfigError(
            fmt::format("{}: {} is no picture that can be read.", place, file.string()));
    }
    const std::string below = placeBelow(file);
    return below.empty() ? copy(file) : below;
}

std::string ForeignFiles::baked(const std::string& name, const WorldMesh& mesh,
                                const glm::dvec3& origin) {
    const std::string free = freeName(fileName(name), ".ply");
    writePly(folder_ / free, mesh, origin);
    return (folder_.filename() / free).string();
}

// Empty where it lies elsewhere.
std::string ForeignFiles::placeBelow(const fs::path& file) const {
    const fs::path relative = real(file).lexically_relative(real(sceneFolder_));
    if (relative.empty() || *relative.begin() == "..") return "";
    // What a scene file cannot spell is copied under a name that it can.
    return oneLine(relative.string()) == relative.string() ? relative.string() : "";
}

std::string ForeignFiles::copy(const fs::path& file) {
    const auto done = copies_.find(file.string());
    if (done != copies_.end()) return done->second;
    const std::string free = freeName(fileName(file.stem().string()), lowerExtension(file));
    writeFileWhole(folder_ / free, readFile(file));
    const std::string named = (folder_.filename() / free).string();
    copies_[file.string()] = named;
    return named;
}

std::string ForeignFiles::freeName(const std::string& stem, const std::string& extension) {
    std::string free = stem + extension;
    for (int i = 2; !names_.insert(free).second; ++i)
        free = fmt::format("{}-{}{}", stem, i, extension);
    return free;
}

}  // namespace kaustik::scene
