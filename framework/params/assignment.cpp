// SPDX-License-Identifier: MIT
#include "framework/params/assignment.h"

#include <fmt/format.h>

#include <utility>

#include "framework/core/error.h"

namespace kaustik::params {

Assignment parseAssignment(std::string_view text, std::string_view source) {
    const auto equals = text.find('=');
    if (equals == std::string_view::npos || equals == 0)
        throw ConfigError(fmt::format("{}: '{}' is not of the form name=value.", source, text));
    return {std::string(text.substr(0, equals)), std::string(text.substr(equals + 1)),
            std::string(source)};
}

void assign(ParamSet& params, const std::vector<Assignment>& assignments) {
    ParamSet changed = params;
    for (const Assignment& assignment : assignments)
        changed.set(assignment.name, assignment.value, assignment.source);
    params = std::move(changed);
}

Extent parsePictureSize(std::string_view text, std::string_view source) {
    Extent size;
    const Field field{"size", "", "px", &size, 1.0, kMaxPictureSide, {}};
    field.set(text, "size", source);
    return size;
}

}  // namespace kaustik::params
