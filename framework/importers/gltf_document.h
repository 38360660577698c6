// SPDX-License-Identifier: MIT
// A glTF 2.0 file as checked JSON and as tinygltf's model. tinygltf takes what it does not
// understand for the default without a word (an IOR of "x", an index of 3.5) and follows indices
// and byte ranges out of their arrays, so that the JSON is checked before tinygltf sees it.
//
// All checks here are about meaning: that what is read is what the file says, or an error that
// names the field. They are no defence: a file that crashes, hangs or fills the memory of what
// reads it (JSON nested a million deep, say) ends the reading process, and that is what refuses it
// (framework/reading/reader_process.h).
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

// Images stay encoded; tinygltf needs no decoder.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

namespace kaustik::scene {

// The JSON text of a .gltf or .glb file. Throws IoError that begins with `name` (the file) when a
// .glb is cut off or its chunks do not fit.
[[nodiscard]] std::string_view gltfJsonText(std::string_view bytes, const std::string& name);

// Checks types, ranges, indices and byte ranges of every field that is read. Throws ConfigError for
// a value that makes no sense and IoError for a damaged structure, with the file and the field.
void checkGltfJson(const nlohmann::json& document, const std::string& name);

// The whole file, checked, with its buffers loaded and its accessors inside them. Images that are
// embedded as data URIs are in Image::image, encoded.
[[nodiscard]] tinygltf::Model loadGltfModel(const std::filesystem::path& path);

// The file that a relative URI of `path` means (percent signs decoded).
[[nodiscard]] std::filesystem::path gltfUriToFile(const std::filesystem::path& path,
                                                  const std::string& uri);

}  // namespace kaustik::scene
