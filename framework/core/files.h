// SPDX-License-Identifier: MIT
// Where the project's files are, and how files are written: whole or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace kaustik {

[[nodiscard]] std::string versionString();

// The folder that holds shaders/, experiments/ and meshes/: $KAUSTIK_ROOT, else the nearest such
// folder above the executable, else the source tree that the program was built from.
[[nodiscard]] const std::filesystem::path& projectRoot();

// The folder of the running executable; modules that are loaded at run time lie beside it.
[[nodiscard]] std::filesystem::path executableFolder();

// The whole file as bytes. Throws IoError (missing, a directory, no permission) naming the file.
[[nodiscard]] std::string readFile(const std::filesystem::path& path);

// Calls `write` with a temporary path beside `path` (same extension), then renames it over `path`.
// When `write` throws, or the disk is full, nothing is left behind and `path` is untouched. What a
// process of this machine has left in the folder because it was killed is removed first.
// Creates missing parent folders. Throws IoError naming the file.
void writeFileWhole(const std::filesystem::path& path,
                    const std::function<void(const std::filesystem::path& temporary)>& write);

// The same for bytes that are at hand.
void writeFileWhole(const std::filesystem::path& path, std::string_view bytes);

}  // namespace kaustik
