// SPDX-License-Identifier: MIT
// What a mesh file itself says that it holds. Assimp reads files that are cut off or inconsistent
// as smaller or bent meshes without a word (a 3DS index out of range becomes the last vertex), so
// the structure is checked first, and what Assimp returns is compared with the counts found here.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kaustik::scene {

struct MeshFileContents {
    std::size_t triangles = 0;  // a polygon of n corners counted as n - 2, and so a strip
    // What Assimp gets in place of the file: the part of it that makes triangles.
    std::optional<std::string> geometry;
    // False where the reader invents normals that the file does not give.
    bool trustNormals = true;
    std::vector<std::string> warnings;
};

// Each throws IoError that begins with `name` (the file) when the bytes are not that format, are
// cut off, or use a vertex that is not there. Text formats give the line.
[[nodiscard]] MeshFileContents checkObj(std::string_view bytes, const std::string& name);
[[nodiscard]] MeshFileContents checkPly(std::string_view bytes, const std::string& name);
[[nodiscard]] MeshFileContents check3ds(std::string_view bytes, const std::string& name);

// The contents of a gzip file (RFC 1952). Throws IoError when it is damaged or cut off at any byte,
// and, before memory is taken, when it holds more than a mesh can: 2 GiB, or 64 MiB and 200 times
// the bytes of the file.
[[nodiscard]] std::string gunzip(std::string_view bytes, const std::string& name);

}  // namespace kaustik::scene
