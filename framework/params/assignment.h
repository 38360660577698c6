// SPDX-License-Identifier: MIT
// Values that somebody asks for as text: the command line, a file of settings, a study, the
// workbench, Python.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "framework/params/param_set.h"

namespace kaustik::params {

struct Assignment {
    std::string name;  // any short form that is unique
    std::string value;
    std::string source;  // who asks ("--set", "file:12"), for messages
};

// "name=value", as in --set. Throws ConfigError for anything else.
[[nodiscard]] Assignment parseAssignment(std::string_view text, std::string_view source);

// Sets them in their order, all of them or none. Throws as ParamSet::set().
void assign(ParamSet& params, const std::vector<Assignment>& assignments);

// Largest side of a picture, px.
inline constexpr int kMaxPictureSide = 16384;

// "WIDTHxHEIGHT". Throws ConfigError that names `source`.
[[nodiscard]] Extent parsePictureSize(std::string_view text, std::string_view source);

}  // namespace kaustik::params
