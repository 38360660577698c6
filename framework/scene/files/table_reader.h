// SPDX-License-Identifier: MIT
// Reads one table of a TOML file strictly. Each getter makes its key known; `finish` then rejects
// every key that nobody asked for. All errors are ConfigError "file:line: subject: what is wrong,
// what is allowed", with the nearest name that exists.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "framework/scene/files/toml_node.h"

namespace kaustik::scene {

// A length, a colour or an irradiance beyond these is a slip of the keyboard; their squares still
// fit into a float.
inline constexpr double kLargestNumber = 1e9;
inline constexpr double kSmallestLength = 1e-9;

// The numbers that a key may have.
struct NumberRange {
    double minimum = -kLargestNumber;
    double maximum = kLargestNumber;
    bool withoutMinimum = false;
    bool withoutMaximum = false;

    [[nodiscard]] bool contains(double value) const;
    [[nodiscard]] std::string description() const;  // "at least 0 and less than 180"
};
inline constexpr NumberRange kAnyNumber{};
inline constexpr NumberRange kPositive{kSmallestLength, kLargestNumber, false, false};
inline constexpr NumberRange kNotNegative{0.0, kLargestNumber, false, false};
inline constexpr NumberRange kUnitInterval{0.0, 1.0, false, false};

// Of length 1. `vector` is not zero, but may be tiny: it is divided before it is squared.
[[nodiscard]] glm::dvec3 unitDirection(const glm::dvec3& vector);

class TableReader {
  public:
    // `table` must outlive the reader. subject: what the table describes, for messages: "light".
    TableReader(const TomlNode& table, std::filesystem::path file, std::string subject);

    // Getters. Without a fallback the key is required: its absence is reported by `finish`, after
    // the unknown keys, since a misspelt key is both; until then the getter gives a valid value.
    [[nodiscard]] double number(std::string_view key, const NumberRange& range,
                                std::optional<double> fallback = {});
    [[nodiscard]] float numberAsFloat(std::string_view key, const NumberRange& range,
                                      std::optional<double> fallback = {});
    [[nodiscard]] unsigned count(std::string_view key, unsigned minimum, unsigned maximum,
                                 std::optional<unsigned> fallback = {});
    [[nodiscard]] glm::uvec2 counts(std::string_view key, unsigned minimum, unsigned maximum,
                                    std::optional<glm::uvec2> fallback = {});
    [[nodiscard]] glm::dvec2 vector2(std::string_view key, const NumberRange& range,
                                     std::optional<glm::dvec2> fallback = {});
    [[nodiscard]] glm::dvec3 vector3(std::string_view key, const NumberRange& range,
                                     std::optional<glm::dvec3> fallback = {});
    // One number for all components will do as well.
    [[nodiscard]] glm::dvec2 uniformOrVector2(std::string_view key, const NumberRange& range,
                                              std::optional<glm::dvec2> fallback = {});
    [[nodiscard]] glm::dvec3 uniformOrVector3(std::string_view key, const NumberRange& range,
                                              std::optional<glm::dvec3> fallback = {});
    // Three numbers that are not all 0, as a unit vector.
    [[nodiscard]] glm::dvec3 direction(std::string_view key);
    [[nodiscard]] bool flag(std::string_view key, bool fallback);
    [[nodiscard]] std::string text(std::string_view key, std::optional<std::string> fallback = {});
    [[nodiscard]] std::vector<std::string> texts(std::string_view key);

    // The required key `name`; from here on messages say whose table it is.
    [[nodiscard]] std::string name();

    // One of the named values.
    template <class Value>
    using Choices = std::vector<std::pair<std::string, Value>>;
    template <class Value>
    [[nodiscard]] Value choice(std::string_view key, const Choices<Value>& choices,
                               std::optional<Value> fallback = {});

    // Sub-tables: [key] or {…}; [[key]] or [{…}, …].
    [[nodiscard]] std::optional<TableReader> table(std::string_view key);
    [[nodiscard]] std::vector<TableReader> tables(std::string_view key);

    [[nodiscard]] bool has(std::string_view key);

    // Throws for the first key that no getter asked for, else for the first missing one.
    void finish() const;

    // Throws ConfigError at the key's line (the table's where the key is absent).
    [[noreturn]] void fail(std::string_view key, const std::string& message) const;
    // "file:line"; "the scene" where the table stands in no file.
    [[nodiscard]] std::string place(std::string_view key = "") const;
    [[nodiscard]] const std::string& subject() const { return subject_; }
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }

    // "'typo' is not one of a, b and c; did you mean 'b'?"
    [[nodiscard]] static std::string notOneOf(std::string_view value,
                                              const std::vector<std::string>& names);

  private:
    [[nodiscard]] const TomlNode* find(std::string_view key);
    [[nodiscard]] const TomlNode* require(std::string_view key, bool optional);
    [[nodiscard]] double checkedNumber(std::string_view key, const TomlNode& node,
                                       const NumberRange& range) const;
    [[nodiscard]] std::vector<double> numbers(std::string_view key, const TomlNode& node,
                                              std::size_t size, bool uniform,
                                              const NumberRange& range) const;
    [[nodiscard]] unsigned checkedCount(std::string_view key, const TomlNode& node,
                                        unsigned minimum, unsigned maximum) const;
    [[noreturn]] void failMissing(std::string_view key) const;

    const TomlNode* table_;
    std::filesystem::path file_;
    std::string subject_;
    std::vector<std::string> known_;
    std::vector<std::string> missing_;
};

template <class Value>
Value TableReader::choice(std::string_view key, const Choices<Value>& choices,
                          std::optional<Value> fallback) {
    if (!has(key)) {
        if (fallback) return *fallback;
        // Which other keys are known depends on this one, so it cannot wait for `finish`.
        failMissing(key);
    }
    const std::string chosen = text(key);
    std::vector<std::string> names;
    for (const auto& [name, value] : choices) {
        if (name == chosen) return value;
        names.push_back(name);
    }
    fail(key, std::string(key) + " " + notOneOf(chosen, names));
}

}  // namespace kaustik::scene
