// SPDX-License-Identifier: MIT
// Describes a table of a TOML file as JSON Schema (draft 2020-12), by the same `reflect` that
// table_reader.h reads it by: what the reader refuses of one table, the schema does too.
#pragma once

#include <nlohmann/json.hpp>

#include "framework/scene/files/table_reader.h"

namespace kaustik::scene {

// The schema of tables that have the keys of `Keys`: of one kind, or of one of several.
template <class Keys>
[[nodiscard]] nlohmann::json tableSchema();

// What TableReader's functions of the same names read is described here; values that are held are
// the defaults.
class TableSchema {
  public:
    using json = nlohmann::json;
    using Tables = TableReader::Tables;

    // kind: which of the kinds of a table is described, counted from 0.
    explicit TableSchema(std::size_t kind) : kind_(kind) {}
    [[nodiscard]] std::size_t kinds() const { return kinds_; }
    [[nodiscard]] json schema() const;

    template <class Number>
    void number(const Number& value, const Key& key, const NumberRange& range,
                Presence presence = Presence::required) {
        add(key, ofNumbers(range), value, presence);
    }
    template <class Count>
    void count(const Count& value, const Key& key, unsigned minimum, unsigned maximum,
               Presence presence = Presence::required) {
        add(key, ofCounts(minimum, maximum), value, presence);
    }
    void counts(const glm::uvec2& value, const Key& key, unsigned minimum, unsigned maximum,
                Presence presence = Presence::required) {
        add(key, oneOrList(ofCounts(minimum, maximum), 2), value, presence);
    }
    template <class Vector>
    void vector(const Vector& value, const Key& key, const NumberRange& range,
                Presence presence = Presence::required) {
        add(key, listOf(ofNumbers(range), sizeOf<Vector>()), value, presence);
    }
    template <class Vector>
    void uniformOrVector(const Vector& value, const Key& key, const NumberRange& range,
                         Presence presence = Presence::required) {
        add(key, oneOrList(ofNumbers(range), sizeOf<Vector>()), value, presence);
    }
    template <class Vector>
    void direction(const Vector& value, const Key& key, Presence presence = Presence::required) {
        json schema = listOf(ofNumbers(kAnyNumber), sizeOf<Vector>());
        schema["contains"] = {{"not", {{"const", 0}}}};
        add(key, std::move(schema), value, presence);
    }
    void flag(bool value, const Key& key) { add(key, {{"type", "boolean"}}, value, kHasDefault); }
    template <class Text>
    void text(const Text& value, const Key& key, Presence presence = Presence::required) {
        add(key, {{"type", "string"}}, value, presence);
    }
    void folderName(const std::string& value, const Key& key) {
        add(key, {{"type", "string"}, {"pattern", "^[A-Za-z0-9_-]+$"}}, value, Presence::required);
    }
    void texts(const std::vector<std::string>& value, const Key& key) {
        add(key, {{"type", "array"}, {"items", {{"type", "string"}}}}, value, kHasDefault);
    }
    template <std::size_t size>
    void subset(const std::array<bool, size>&, const Key& key,
                const std::array<const char*, size>& names) {
        add(key, {{"type", "array"}, {"items", {{"enum", names}}}}, std::vector<std::string>(),
            kHasDefault);
    }
    void name(const std::string& value) {
        add({"name", "Unique among those of its kind"}, {{"type", "string"}, {"minLength", 1}},
            value, Presence::required);
    }
    template <class Value>
    void choice(const Value& value, const Key& key,
                const Choices<typename Held<Value>::Value>& choices,
                Presence presence = Presence::required) {
        json names = json::array();
        json held;
        for (const auto& [name, choice] : choices) {
            names.push_back(name);
            if (presence == kHasDefault && value == choice) held = name;
        }
        add(key, {{"enum", std::move(names)}}, held,
            Held<Value>::isOptional ? kOptional : presence);
    }
    // Describes one of the kinds, whose name is then the key's only value, and sets `value` to it,
    // so that the keys of that kind follow.
    template <class Value>
    void kind(Value& value, const Key& key, const Choices<Value>& choices) {
        const std::size_t before = kinds_ - 1;
        kinds_ = before + choices.size();
        const auto& [name, chosen] = choices[kind_ - before];
        value = chosen;
        title_ = name;
        add(key, {{"const", name}}, value, Presence::required);
    }
    void kind(bool& hasKey, const char* key);
    [[nodiscard]] bool onlyWith(const char* key, const char* other);
    void rule(const KeyRule& rule) { rules_.push_back(rule); }

    template <class T>
    void table(const TableOf<T>&, const Key& key) {
        add(key, tableSchema<T>(), json(), kOptional);
    }
    template <class T>
    void table(const std::optional<T>&, const Key& key) {
        add(key, tableSchema<T>(), json(), kOptional);
    }
    template <class T>
    void tables(const TablesOf<T>&, const Key& key) {
        add(key, {{"type", "array"}, {"items", tableSchema<T>()}}, json(), kOptional);
    }
    template <class T>
    void tables(const std::vector<T>&, const Key& key) {
        add(key, {{"type", "array"}, {"items", tableSchema<T>()}}, json(), kOptional);
    }
    void foreignTable(const Key& key, const char* definition, Tables count);

  private:
    [[nodiscard]] static json ofNumbers(const NumberRange& range);
    [[nodiscard]] static json ofCounts(unsigned minimum, unsigned maximum);
    [[nodiscard]] static json listOf(json element, std::size_t size);
    [[nodiscard]] static json oneOrList(json element, std::size_t size);
    template <class Vector>
    [[nodiscard]] static constexpr std::size_t sizeOf() {
        return static_cast<std::size_t>(Held<Vector>::Value::length());
    }
    // A default as a file would have it.
    template <class T>
    [[nodiscard]] static json written(const T& value) {
        if constexpr (requires { T::length(); }) {
            json components = json::array();
            for (glm::length_t i = 0; i < T::length(); ++i)
                components.push_back(written(value[i]));
            return components;
        } else if constexpr (std::is_floating_point_v<T>) {
            return shortest(value);
        } else if constexpr (std::is_constructible_v<json, const T&>) {
            return value;
        } else {
            return {};
        }
    }
    [[nodiscard]] static json shortest(double value);
    [[nodiscard]] static json shortest(float value);
    template <class T>
    void add(const Key& key, json schema, const T& value, Presence presence) {
        addKey(key, std::move(schema), presence == kHasDefault ? written(value) : json(),
               presence == Presence::required && !Held<T>::isOptional);
    }
    // held: the default; null where there is none.
    void addKey(const Key& key, json schema, json held, bool isRequired);

    std::size_t kind_;
    std::size_t kinds_ = 1;
    std::string title_;
    json properties_ = json::object();
    json required_ = json::array();
    json onlyWith_ = json::object();
    std::vector<KeyRule> rules_;
};

template <class Keys>
nlohmann::json tableSchema() {
    nlohmann::json kinds = nlohmann::json::array();
    for (std::size_t kind = 0, count = 1; kind < count; ++kind) {
        Keys keys;
        TableSchema schema(kind);
        reflect(schema, keys);
        count = schema.kinds();
        kinds.push_back(schema.schema());
    }
    return kinds.size() == 1 ? kinds.front() : nlohmann::json{{"oneOf", kinds}};
}

}  // namespace kaustik::scene
