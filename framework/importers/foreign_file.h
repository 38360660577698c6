// SPDX-License-Identifier: MIT
// Scenes of other renderers, in this process: what scene::readForeignScene has a reader process do.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "framework/importers/triangle_soup.h"
#include "framework/scene/foreign/foreign_scene.h"

namespace kaustik::scene {

// Reads the file as readForeignScene says (framework/scene/foreign/foreign_scene.h): .xml as
// Mitsuba, .json as Tungsten.
[[nodiscard]] ForeignScene readForeignFile(const std::filesystem::path& file);

// One function a format.
[[nodiscard]] ForeignScene readMitsuba(const std::filesystem::path& file);
[[nodiscard]] ForeignScene readTungsten(const std::filesystem::path& file);

// Meshes in the files of one renderer alone. Both throw IoError that begins with `name` for bytes
// that are cut off or no such file.
// Mitsuba's .serialized, version 3 or 4: the mesh with the index `shape` of those in the file.
[[nodiscard]] ImportedMesh readSerialized(std::string_view bytes, std::size_t shape,
                                          const std::string& name);
// Tungsten's .wo3.
[[nodiscard]] ImportedMesh readWo3(std::string_view bytes, const std::string& name);
// What both end with: a checked mesh out of triangles whose indices are in range.
[[nodiscard]] ImportedMesh buildForeignMesh(const TriangleSoup& soup, const std::string& name);

}  // namespace kaustik::scene
