// SPDX-License-Identifier: MIT
#include "framework/importers/toml_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include "framework/core/error.h"
#include "framework/core/files.h"

namespace kaustik::scene {
namespace {
namespace fs = std::filesystem;

class Copier {
  public:
    explicit Copier(const fs::path& file) : file_(file) {}

    TomlNode copy(const toml::node& node, int depth = 0) const {
        const toml::source_position& begin = node.source().begin;
        if (depth > kMaxTomlDepth) {
            throw ConfigError(fmt::format("{}:{}: This is nested more than {} deep.",
                                          file_.string(), unsigned(begin.line), kMaxTomlDepth));
        }
        TomlNode copied;
        copied.line = begin.line;
        copied.column = begin.column;
        if (const auto* text = node.as_string()) {
            copied.value = text->get();
        } else if (const auto* integer = node.as_integer()) {
            copied.value = integer->get();
        } else if (const auto* number = node.as_floating_point()) {
            copied.value = number->get();
        } else if (const auto* flag = node.as_boolean()) {
            copied.value = flag->get();
        } else if (const auto* array = node.as_array()) {
            auto& list = copied.value.emplace<TomlList>();
            for (const toml::node& element : *array)
                list.elements.push_back(copy(element, depth + 1));
        } else if (const auto* table = node.as_table()) {
            auto& entries = copied.value.emplace<TomlTable>();
            entries.isInline = table->is_inline();
            for (const auto& [key, element] : *table)
                entries.entries.push_back({std::string(key.str()), copy(element, depth + 1)});
        } else {
            copied.value = TomlTime();
        }
        return copied;
    }

  private:
    const fs::path& file_;
};

}  // namespace

TomlNode parseTomlFile(const fs::path& file) {
    const std::string text = readFile(file);
    try {
        return Copier(file).copy(toml::parse(text, file.string()));
    } catch (const toml::parse_error& error) {
        throw ConfigError(fmt::format("{}:{}: This is not valid TOML: {}.", file.string(),
                                      unsigned(error.source().begin.line), error.description()));
    }
}

}  // namespace kaustik::scene
