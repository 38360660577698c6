// SPDX-License-Identifier: MIT
#include "framework/core/json_text.h"

#include <nlohmann/json.hpp>

namespace kaustik {

std::string jsonText(const nlohmann::json& json, int indent) {
    return json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace kaustik
