// SPDX-License-Identifier: MIT
// What a renderer's last build is made of, for people and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "framework/pipeline/renderer.h"

namespace kaustik::run {

// What the scene needs, every pass with the reason that it runs or not, every resource, the
// warnings of the scene's files and those of the build.
[[nodiscard]] std::string explain(const Renderer& renderer);

// A list of objects with `name`, `stage`, `state` ("runs", "bypassed", "culled", "skipped"),
// `reason`.
[[nodiscard]] nlohmann::json listPasses(const Renderer& renderer);

// A list of objects: textures with `name`, `kind` "texture", `width`, `height`, `channels`,
// `layers` (0: not an array of layers) and `format`; buffers with `name`, `kind` "buffer" and
// `bytes`.
[[nodiscard]] nlohmann::json listResources(const Renderer& renderer);

}  // namespace kaustik::run
