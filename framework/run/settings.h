// SPDX-License-Identifier: MIT
// Makes the settings of a renderer from what somebody asks for.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "framework/params/assignment.h"
#include "framework/pipeline/renderer.h"

namespace kaustik::run {

struct SettingsRequest {
    std::string technique;
    std::vector<params::Assignment> assignments;  // a later one counts more
    std::set<std::string> disabledPasses = {};
    std::string disabledBy = "--disable";  // what names them, for messages
    std::uint64_t seed = 1;
    bool isAsPublished = false;  // the technique's row is its paper's
};

// Throws ConfigError for what the registry does not have or a parameter does not take.
[[nodiscard]] RenderSettings makeSettings(const SettingsRequest& request, const Registry& registry);

void setSize(RenderSettings& settings, const params::Extent& size);

}  // namespace kaustik::run
