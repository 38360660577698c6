// SPDX-License-Identifier: MIT
#include "framework/core/json_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "framework/core/error.h"

namespace kaustik {
namespace {

// Deeper than any file of the project's own nests, and shallow enough for what recurses over it.
constexpr int kMaxJsonDepth = 64;

// The parser could be asked to watch the depth, but looks at all that an object's parent holds so
// far when the object ends: 300,000 entries would take half a minute.
void requireShallowJson(std::string_view text, const std::string& name) {
    int depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"') {
            for (++i; i < text.size() && text[i] != '"'; ++i)
                i += text[i] == '\\' ? 1 : 0;
        } else if (text[i] == '{' || text[i] == '[') {
            if (++depth <= kMaxJsonDepth) continue;
            throw IoError(
                fmt::format("{}: the JSON is nested more than {} deep.", name, kMaxJsonDepth));
        } else if (text[i] == '}' || text[i] == ']') {
            --depth;
        }
    }
}

}  // namespace

std::string jsonText(const nlohmann::json& json, int indent) {
    return json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

nlohmann::json parseJson(std::string_view text, const std::string& name) {
    requireShallowJson(text, name);
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& error) {
        throw IoError(fmt::format("{} is damaged or cut off: {}.", name, error.what()));
    }
}

}  // namespace kaustik
