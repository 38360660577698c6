// SPDX-License-Identifier: MIT
// Reads one table of a TOML file strictly. A struct says its keys once, in a function
//
//     template <class R>
//     void reflect(R& r, SphereShape& shape) {
//         r.number(shape.radius, {"radius", "From the middle to the surface", "m"}, kPositive);
//         r.count(shape.segments, {"segments", "Edges around the equator"}, 4, 2048, kHasDefault);
//     }
//
// which a TableReader fills the struct by and a TableSchema (table_schema.h) describes it by. All
// errors are ConfigError "file:line: subject: what is wrong, what is allowed", with the nearest
// name that exists.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <initializer_list>
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

// The vector made as long as 1. `vector` is not zero, but may be tiny: it is divided before it is
// squared.
[[nodiscard]] glm::dvec3 unitDirection(const glm::dvec3& vector);

// What a key is called, what it means, and its unit.
struct Key {
    const char* name;
    const char* sentence;
    const char* unit = "";
};

enum class Presence {
    required,
    hasDefault,  // the value that is held before
    optional     // without the key the value stays what it is, which no key could say
};
inline constexpr Presence kHasDefault = Presence::hasDefault;
inline constexpr Presence kOptional = Presence::optional;

// A value that std::optional holds is of a key that may be left out.
template <class T>
struct Held {
    using Value = T;
    static constexpr bool isOptional = false;
};
template <class T>
struct Held<std::optional<T>> {
    using Value = T;
    static constexpr bool isOptional = true;
};

// The named values of a key.
template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

// A rule that allows at most one of several keys.
struct KeyRule {
    std::vector<const char*> keys;
    bool needsOne = false;
    const char* place = "";     // the key at which an error is told
    const char* sentence = "";  // for people
    const char* missing =
        "";  // the key that is called missing where there is none; else `sentence`
};

// Tables in a table, which are read after all keys of the outer one: [key] and [[key]].
template <class T>
struct TableOf;
template <class T>
struct TablesOf;

class TableReader {
  public:
    // `table` must outlive the reader. subject: what the table describes, for messages: "light".
    TableReader(const TomlNode& table, std::filesystem::path file, std::string subject);

    // The whole table as its `reflect` has it. Throws for a wrong value, else for an unknown key,
    // else for a missing one.
    template <class T>
    [[nodiscard]] T read() {
        T values;
        reflect(*this, values);
        finish();
        return values;
    }

    // What `reflect` says of a key. Where it is not there, the value stays as it is; that one is
    // missing is told at the end, after unknown keys, since a misspelt key is both.
    template <class Number>
    void number(Number& value, const Key& key, const NumberRange& range,
                Presence presence = Presence::required) {
        if (const TomlNode* node = find<Number>(key, presence)) {
            using Value = typename Held<Number>::Value;
            value = static_cast<Value>(checkedNumber(key.name, *node, range));
        }
    }
    template <class Count>
    void count(Count& value, const Key& key, unsigned minimum, unsigned maximum,
               Presence presence = Presence::required) {
        if (const TomlNode* node = find<Count>(key, presence)) {
            using Value = typename Held<Count>::Value;
            value = static_cast<Value>(checkedCount(key.name, *node, minimum, maximum));
        }
    }
    // Two, or one for both.
    void counts(glm::uvec2& value, const Key& key, unsigned minimum, unsigned maximum,
                Presence presence = Presence::required);
    template <class Vector>
    void vector(Vector& value, const Key& key, const NumberRange& range,
                Presence presence = Presence::required) {
        readVector(value, key, range, false, presence);
    }
    // One number for all components will do as well.
    template <class Vector>
    void uniformOrVector(Vector& value, const Key& key, const NumberRange& range,
                         Presence presence = Presence::required) {
        readVector(value, key, range, true, presence);
    }
    // Three numbers that are not all 0, as they are written.
    template <class Vector>
    void direction(Vector& value, const Key& key, Presence presence = Presence::required) {
        readVector(value, key, kAnyNumber, false, presence);
        if (table_->find(key.name) != nullptr) requireDirection(key.name);
    }
    void flag(bool& value, const Key& key);
    template <class Text>
    void text(Text& value, const Key& key, Presence presence = Presence::required) {
        if (const TomlNode* node = find<Text>(key, presence)) value = checkedText(key.name, *node);
    }
    // Letters, digits, '-' and '_'.
    void folderName(std::string& value, const Key& key);
    void texts(std::vector<std::string>& values, const Key& key);
    // Reads a list of names, and notes which of `names` are in it.
    template <std::size_t size>
    void subset(std::array<bool, size>& chosen, const Key& key,
                const std::array<const char*, size>& names) {
        std::vector<std::string> listed;
        texts(listed, key);
        for (const std::string& name : listed)
            chosen[indexOf(key.name, ": ", name, {names.begin(), names.end()})] = true;
    }
    // The required key `name`; from here on messages say whose table it is.
    void name(std::string& value);
    template <class Value>
    void choice(Value& value, const Key& key, const Choices<typename Held<Value>::Value>& choices,
                Presence presence = Presence::required);
    // A required choice on which it depends what other keys there are.
    template <class Value>
    void kind(Value& value, const Key& key, const Choices<Value>& choices) {
        // So it cannot wait for the end.
        if (find<Value>(key, kOptional) == nullptr) failMissing(key.name);
        choice(value, key, choices);
    }
    // Whether the table has the key, on which the same depends.
    void kind(bool& hasKey, const char* key) { hasKey = has(key); }
    // Whether the table has `other`, without which there is no `key`.
    [[nodiscard]] bool onlyWith(const char* /*key*/, const char* other) { return has(other); }
    void rule(const KeyRule& rule);

    template <class T>
    void table(TableOf<T>& value, const Key& key) {
        value.reader = table(key.name);
    }
    template <class T>
    void tables(TablesOf<T>& values, const Key& key) {
        values.readers = tables(key.name);
    }
    // These are read at once; of two keys with the same values the second adds to the first.
    template <class T>
    void table(std::optional<T>& value, const Key& key) {
        if (std::optional<TableReader> reader = table(key.name)) value = reader->read<T>();
    }
    template <class T>
    void tables(std::vector<T>& values, const Key& key) {
        for (TableReader& reader : tables(key.name))
            values.push_back(reader.read<T>());
    }
    // A table whose keys are known elsewhere, or a list of such tables: $defs/`definition` in a
    // schema.
    enum class Tables { one, oneOrSeveral };
    void foreignTable(const Key& key, const char* definition, Tables count);

    [[nodiscard]] bool has(std::string_view key);

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
    void finish() const;
    void note(std::string_view key);
    [[nodiscard]] std::ptrdiff_t countOf(const KeyRule& rule) const;
    template <class T>
    [[nodiscard]] const TomlNode* find(const Key& key, Presence presence) {
        return find(key.name, !Held<T>::isOptional && presence == Presence::required);
    }
    [[nodiscard]] const TomlNode* find(std::string_view key, bool isRequired);
    [[nodiscard]] std::optional<TableReader> table(std::string_view key);
    [[nodiscard]] std::vector<TableReader> tables(std::string_view key);
    [[nodiscard]] TableReader inner(const TomlNode& node, std::string_view key) const;
    template <class Vector>
    void readVector(Vector& value, const Key& key, const NumberRange& range, bool isUniform,
                    Presence presence);
    [[nodiscard]] double checkedNumber(std::string_view key, const TomlNode& node,
                                       const NumberRange& range) const;
    [[nodiscard]] std::vector<double> numbers(std::string_view key, const TomlNode& node,
                                              std::size_t size, bool isUniform,
                                              const NumberRange& range) const;
    [[nodiscard]] unsigned checkedCount(std::string_view key, const TomlNode& node,
                                        unsigned minimum, unsigned maximum) const;
    [[nodiscard]] const std::string& checkedText(std::string_view key, const TomlNode& node) const;
    // The index of a value among the names that it may have.
    [[nodiscard]] std::size_t indexOf(std::string_view key, const char* intro,
                                      const std::string& value,
                                      const std::vector<std::string>& names) const;
    void requireDirection(std::string_view key) const;
    [[noreturn]] void failMissing(std::string_view key) const;

    const TomlNode* table_;
    std::filesystem::path file_;
    std::string subject_;
    std::vector<std::string> known_;
    std::vector<std::string> missing_;
    std::vector<KeyRule> rules_;
};

template <class T>
struct TableOf {
    std::optional<TableReader> reader;
};
template <class T>
struct TablesOf {
    std::vector<TableReader> readers;
};

template <class Value>
void TableReader::choice(Value& value, const Key& key,
                         const Choices<typename Held<Value>::Value>& choices, Presence presence) {
    const TomlNode* node = find<Value>(key, presence);
    if (node == nullptr) return;
    std::vector<std::string> names;
    for (const auto& [name, choice] : choices)
        names.push_back(name);
    value = choices[indexOf(key.name, " ", checkedText(key.name, *node), names)].second;
}

template <class Vector>
void TableReader::readVector(Vector& value, const Key& key, const NumberRange& range,
                             bool isUniform, Presence presence) {
    const TomlNode* node = find<Vector>(key, presence);
    if (node == nullptr) return;
    typename Held<Vector>::Value vector;
    const auto size = static_cast<std::size_t>(vector.length());
    const std::vector<double> written = numbers(key.name, *node, size, isUniform, range);
    for (std::size_t i = 0; i < size; ++i) {
        using Number = typename Held<Vector>::Value::value_type;
        vector[static_cast<glm::length_t>(i)] = static_cast<Number>(written[i]);
    }
    value = vector;
}

}  // namespace kaustik::scene
