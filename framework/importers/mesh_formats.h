// SPDX-License-Identifier: MIT
// One function a format of mesh files. Each reads the whole file itself and takes nothing on faith:
// no memory for a count before the bytes that it counts, no index that is out of range, and a file
// that is cut off or inconsistent is an error, never a smaller or a bent mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "framework/importers/triangle_soup.h"

namespace kaustik::scene {

struct MeshFileContents {
    TriangleSoup soup;
    std::size_t crossingPolygons = 0;  // those whose triangles may overlap
    std::vector<std::string> warnings;

    void addVertex(const glm::vec3& position, const glm::vec3& normal, const glm::vec2& uv);
    // Cuts a polygon of three or more of these vertices into triangles.
    void addPolygon(const std::vector<std::uint32_t>& corners);
};

// Each throws IoError that begins with `name` (the file) when the bytes are not that format, are
// cut off, or use a vertex that is not there. Text formats give the line or the element. A file
// without faces has no triangles.
[[nodiscard]] MeshFileContents readObj(std::string_view bytes, const std::string& name);
[[nodiscard]] MeshFileContents readPly(std::string_view bytes, const std::string& name);
[[nodiscard]] MeshFileContents read3ds(std::string_view bytes, const std::string& name);
[[nodiscard]] MeshFileContents readStl(std::string_view bytes, const std::string& name);

// The contents of a gzip file (RFC 1952). Throws IoError when it is damaged or cut off at any byte.
// How much it may hold is the business of the reader process, which has a limit of memory.
[[nodiscard]] std::string gunzip(std::string_view bytes, const std::string& name);

// Cuts the first word off `text`, for the formats that are text; "" at its end.
[[nodiscard]] std::string_view nextWord(std::string_view& text);
// True for what is wholly a number; one too large or too small for a double is read as NaN.
[[nodiscard]] bool parseNumber(std::string_view word, double& value);
// Reads a number in 32 bits in the same way. Whole part, fraction and power of ten are each rounded
// by themselves, which is up to a unit in the last place off; meshes stay as they have always been
// read, to the bit.
[[nodiscard]] bool parseFloat(std::string_view word, float& value);

}  // namespace kaustik::scene
