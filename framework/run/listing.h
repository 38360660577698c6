// SPDX-License-Identifier: MIT
// What there is to choose from, as JSON: lists of objects with `name` and `description`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "framework/pipeline/registry.h"

namespace kaustik::run {

// A list of objects with `name`, `description` and `file`, one a shipped scene.
[[nodiscard]] nlohmann::json listScenes();

// Also `source` (the paper), `defaults` (full name of a parameter: value as text) and
// `as_published` (what the paper's row has in their place).
[[nodiscard]] nlohmann::json listTechniques(const Registry& registry);

// Also `stage` and `source`. With a technique only the nodes that it chooses, "": all. Throws
// ConfigError for one that does not exist, as does the next.
[[nodiscard]] nlohmann::json listNodes(const Registry& registry, const std::string& techniqueName,
                                       bool isAsPublished = false);

// name, type, default (the value that it has), unit, range, description; of a choice `choices`, of
// numbers and extents `minimum` and `maximum`.
[[nodiscard]] nlohmann::json describe(const params::NamedField& param);

// Of all parameters. With a technique: of its nodes, with its defaults.
[[nodiscard]] nlohmann::json listParams(const Registry& registry, const std::string& techniqueName,
                                        bool isAsPublished = false);

}  // namespace kaustik::run
