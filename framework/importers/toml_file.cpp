// SPDX-License-Identifier: MIT
#include "framework/importers/toml_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>

#include "framework/core/error.h"
#include "framework/core/files.h"

namespace kaustik::scene {
namespace {
namespace fs = std::filesystem;

[[noreturn]] void failTooDeep(const fs::path& file, std::size_t line) {
    throw ConfigError(
        fmt::format("{}:{}: This is nested more than {} deep.", file.string(), line, kDeepestToml));
}

// toml++ makes a table of every part of a dotted key, and recurses over them until the stack is
// full. So the parts are counted first, wherever they stand: no value has as many dots.
class KeyDepthCheck {
  public:
    KeyDepthCheck(std::string_view text, const fs::path& file) : text_(text), file_(file) {}

    void run() {
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '"' || c == '\'') {
                skipText(c);
            } else if (c == '#') {
                at_ = std::min(text_.find('\n', at_), text_.size());
            } else {
                ++at_;
                if (c == '\n') ++line_;
                if (c == '.') {
                    if (++dots_ >= kDeepestToml) failTooDeep(file_, line_);
                } else if (!isPartOfKey(c)) {
                    dots_ = 0;
                }
            }
        }
    }

  private:
    static bool isPartOfKey(char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' ||
               c == ' ' || c == '\t';
    }

    // From one quotation mark, or three, to the same again.
    void skipText(char quote) {
        const std::string_view rest = text_.substr(at_);
        const std::string three(3, quote);
        const bool isLong = rest.starts_with(three);
        at_ += isLong ? 3 : 1;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '\\' && quote == '"') {
                ++at_;
            } else if (isLong ? text_.substr(at_).starts_with(three) : c == quote) {
                at_ += isLong ? 3 : 1;
                return;
            } else if (c == '\n') {
                ++line_;
                if (!isLong) return;  // not valid; toml++ says so
            }
            ++at_;
        }
    }

    std::string_view text_;
    const fs::path& file_;
    std::size_t at_ = 0;
    std::size_t line_ = 1;
    int dots_ = 0;
};

class Copier {
  public:
    explicit Copier(const fs::path& file) : file_(file) {}

    TomlNode copy(const toml::node& node, int depth = 0) const {
        const toml::source_position& begin = node.source().begin;
        if (depth > kDeepestToml) failTooDeep(file_, begin.line);
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
    KeyDepthCheck(text, file).run();
    try {
        return Copier(file).copy(toml::parse(text, file.string()));
    } catch (const toml::parse_error& error) {
        throw ConfigError(fmt::format("{}:{}: This is not valid TOML: {}.", file.string(),
                                      unsigned(error.source().begin.line), error.description()));
    }
}

}  // namespace kaustik::scene
