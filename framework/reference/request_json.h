// SPDX-License-Identifier: MIT
// What a reference was asked to be, as files say it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "framework/reference/reference.h"

namespace kaustik::reference {

[[nodiscard]] nlohmann::json requestToJson(const ReferenceRequest& request);
// Throws nlohmann::json::exception for what is not such a request.
[[nodiscard]] ReferenceRequest requestFromJson(const nlohmann::json& from);

}  // namespace kaustik::reference
