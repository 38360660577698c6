// SPDX-License-Identifier: MIT
// What `run` leaves behind.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/image/image.h"
#include "framework/pipeline/renderer.h"

namespace kaustik::run {

// Makes the folder and throws IoError if nothing can be written there, before the long work. The
// message begins with who wants it: an option, say.
void requireWritable(const std::filesystem::path& folder, const std::string& requester);

// Whether the renderer's graph has a texture of that name.
[[nodiscard]] bool isTexture(const Renderer& renderer, const std::string& name);

// Throws ConfigError for a resource that is not a texture and hence no picture.
void requireTextures(const Renderer& renderer, const std::vector<std::string>& saved);

// One layer of a texture, top row first, with its first `channels` channels.
[[nodiscard]] Image readTexture(const gl::Texture& texture, int layer, int channels);

// beauty (display and radiance), caustic (irradiance), caustic_radiance where a receiver is glossy,
// in_scattered where there is a medium, and the saved resources by name, one file a layer.
std::vector<std::filesystem::path> writePictures(const std::filesystem::path& folder,
                                                 const Renderer& renderer,
                                                 const std::vector<std::string>& saved);

}  // namespace kaustik::run
