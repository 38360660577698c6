// SPDX-License-Identifier: MIT
// What a TOML file says, as a tree that a reader process can send: the program itself never holds
// what the library made of the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "framework/reading/reader_process.h"

namespace kaustik::scene {

struct TomlNode;
struct TomlEntry;

struct TomlTime {};  // a date or time, of which nothing is used
struct TomlList {
    std::vector<TomlNode> elements;
};
struct TomlTable {
    std::vector<TomlEntry> entries;  // by key
    bool isInline = false;           // {…}
};

struct TomlNode {
    std::variant<std::string, std::int64_t, double, bool, TomlTime, TomlList, TomlTable> value;
    std::uint32_t line = 0;  // from 1; 0 where the file does not write it
    std::uint32_t column = 0;

    template <class T>
    [[nodiscard]] const T* as() const {
        return std::get_if<T>(&value);
    }
    [[nodiscard]] bool isNumber() const { return as<std::int64_t>() || as<double>(); }
    [[nodiscard]] const std::vector<TomlNode>* list() const;
    // The value of a key; null where this is no table or does not have it.
    [[nodiscard]] const TomlNode* find(std::string_view key) const;
    // The entries of a table; there are none where this is no table.
    [[nodiscard]] const std::vector<TomlEntry>& entries() const;
};

struct TomlEntry {
    std::string key;
    TomlNode node;
};

// The table of a whole file, read in a process of its own: by `reader`, or by one for this file
// alone. Throws ConfigError "file:line: …" for what is not valid TOML and IoError for a file that
// cannot be read.
[[nodiscard]] TomlNode readToml(const std::filesystem::path& file);
[[nodiscard]] TomlNode readToml(const std::filesystem::path& file, reading::ReaderProcess& reader);

template <class T>
concept TomlPart = std::is_same_v<T, TomlNode> || std::is_same_v<T, TomlEntry> ||
    std::is_same_v<T, TomlList> || std::is_same_v<T, TomlTable>;

template <class T>
requires TomlPart<std::remove_const_t<T>>
auto partsOf(T& part) {
    if constexpr (std::is_same_v<std::remove_const_t<T>, TomlNode>) {
        auto& [value, line, column] = part;
        return std::tie(value, line, column);
    } else if constexpr (std::is_same_v<std::remove_const_t<T>, TomlList>) {
        auto& [elements] = part;
        return std::tie(elements);
    } else {
        auto& [first, second] = part;
        return std::tie(first, second);
    }
}

}  // namespace kaustik::scene
