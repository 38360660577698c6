// SPDX-License-Identifier: MIT
// A JSON file as a tree whose values know their line, which nlohmann's own does not, and whether
// anything has asked for them: what nothing has asked for at the end is what has no counterpart.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace kaustik::scene {

struct JsonEntry;

struct JsonTree {
    using List = std::vector<JsonTree>;
    using Object = std::vector<JsonEntry>;
    std::variant<std::monostate, bool, double, std::string, List, Object> value;
    std::string place;  // file:line
    mutable bool isUsed = false;

    template <class T>
    [[nodiscard]] const T* as() const {
        return std::get_if<T>(&value);
    }
    // The value of a key, which counts as used; null where this is no object or does not have it.
    [[nodiscard]] const JsonTree* find(std::string_view key) const;
    void markUsed() const;  // with all that is in it
};

struct JsonEntry {
    std::string key;
    JsonTree node;
};

// Throws ConfigError "file:line: …" for what is no JSON or nested more than 64 deep, and IoError
// for a file that cannot be read.
[[nodiscard]] JsonTree readJsonTree(const std::filesystem::path& file);

}  // namespace kaustik::scene
