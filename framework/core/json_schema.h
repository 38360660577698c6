// SPDX-License-Identifier: MIT
// JSON that says what it holds. A struct that is written as an object has a function
//
//     template <class F>
//     void reflect(F& f, const Photons& photons) {
//         f.field("emitted", photons.emitted, "Photons that hit a specular surface");
//     }
//
// which writes each key once with its sentence: `jsonOf` makes the object by it, `jsonSchemaOf` its
// JSON Schema (draft 2020-12).
#pragma once

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace kaustik {

// A whole schema with the name of its file. Its definitions, if any, are under $defs already.
[[nodiscard]] nlohmann::json schemaDocument(const std::string& name, const std::string& title,
                                            nlohmann::json schema);
// The schema of objects that either have the key and are as `with` says, or do not have it and are
// as `without` says.
[[nodiscard]] nlohmann::json eitherSchema(const std::string& key, nlohmann::json with,
                                          nlohmann::json without);

// What stands in a list, in an optional, or under any name in a map.
template <class T>
struct ElementOf {
    static constexpr bool isList = false, isMap = false;
};
template <class T>
struct ElementOf<std::vector<T>> {
    using Element = T;
    static constexpr bool isList = true, isMap = false;
    static constexpr std::size_t size = 0;  // any
};
template <class T, std::size_t count>
struct ElementOf<std::array<T, count>> {
    using Element = T;
    static constexpr bool isList = true, isMap = false;
    static constexpr std::size_t size = count;
};
template <class T>
struct ElementOf<std::map<std::string, T>> {
    using Element = T;
    static constexpr bool isList = false, isMap = true;
};
template <class T>
inline constexpr bool isPlainJson =
    std::is_same_v<T, nlohmann::json> || std::is_same_v<T, std::string> || std::is_arithmetic_v<T>;

template <class T>
[[nodiscard]] nlohmann::json jsonOf(const T& value);
template <class T>
[[nodiscard]] nlohmann::json jsonSchemaOf();

// Writes an object.
class JsonFields {
  public:
    template <class T>
    void field(const char* name, const T& value, const char* /*sentence*/) {
        json_[name] = jsonOf(value);
    }
    // Left out where there is none.
    template <class T>
    void field(const char* name, const std::optional<T>& value, const char* /*sentence*/) {
        if (value) json_[name] = jsonOf(*value);
    }
    // null where there is none; `reason`, if it is not "", then says why under `reasons`.
    template <class T>
    void fieldOrNull(const char* name, const std::optional<T>& value, const std::string& reason,
                     const char* /*sentence*/) {
        json_[name] = value ? jsonOf(*value) : nlohmann::json();
        if (!value && !reason.empty()) json_["reasons"][name] = reason;
    }
    void choice(const char* name, const std::string& value, const std::vector<std::string>&,
                const char* /*sentence*/) {
        json_[name] = value;
    }
    [[nodiscard]] nlohmann::json take() { return std::move(json_); }

  private:
    nlohmann::json json_ = nlohmann::json::object();
};

// Describes it; of values only the types count.
class JsonFieldsSchema {
  public:
    template <class T>
    void field(const char* name, const T&, const char* sentence) {
        add(name, jsonSchemaOf<T>(), sentence, true);
    }
    template <class T>
    void field(const char* name, const std::optional<T>&, const char* sentence) {
        add(name, jsonSchemaOf<T>(), sentence, false);
    }
    template <class T>
    void fieldOrNull(const char* name, const std::optional<T>&, const std::string& reason,
                     const char* sentence) {
        add(name, orNull(jsonSchemaOf<T>()), sentence, true);
        if (!reason.empty()) addReasons();
    }
    void choice(const char* name, const std::string&, const std::vector<std::string>& values,
                const char* sentence) {
        add(name, {{"enum", values}}, sentence, true);
    }
    // A field that has a schema of its own.
    void add(const std::string& name, nlohmann::json schema, const std::string& sentence,
             bool isRequired);
    void addReasons();
    [[nodiscard]] static nlohmann::json orNull(nlohmann::json schema);

    [[nodiscard]] nlohmann::json take();

  private:
    nlohmann::json properties_ = nlohmann::json::object();
    nlohmann::json required_ = nlohmann::json::array();
};

template <class T>
nlohmann::json jsonOf(const T& value) {
    if constexpr (isPlainJson<T>) {
        return value;
    } else if constexpr (ElementOf<T>::isList) {
        nlohmann::json list = nlohmann::json::array();
        for (const auto& element : value)
            list.push_back(jsonOf(element));
        return list;
    } else if constexpr (ElementOf<T>::isMap) {
        nlohmann::json object = nlohmann::json::object();
        for (const auto& [name, element] : value)
            object[name] = jsonOf(element);
        return object;
    } else {
        JsonFields fields;
        reflect(fields, value);
        return fields.take();
    }
}

template <class T>
nlohmann::json jsonSchemaOf() {
    using nlohmann::json;
    if constexpr (std::is_same_v<T, json>) {
        return json{{"type", "object"}};
    } else if constexpr (std::is_same_v<T, std::string>) {
        return json{{"type", "string"}};
    } else if constexpr (std::is_same_v<T, bool>) {
        return json{{"type", "boolean"}};
    } else if constexpr (std::is_floating_point_v<T>) {
        return json{{"type", "number"}};
    } else if constexpr (std::is_unsigned_v<T>) {
        return json{{"type", "integer"}, {"minimum", 0}};
    } else if constexpr (std::is_integral_v<T>) {
        return json{{"type", "integer"}};
    } else if constexpr (ElementOf<T>::isList) {
        json list{{"type", "array"}, {"items", jsonSchemaOf<typename ElementOf<T>::Element>()}};
        if (ElementOf<T>::size > 0) list["minItems"] = list["maxItems"] = ElementOf<T>::size;
        return list;
    } else if constexpr (ElementOf<T>::isMap) {
        return json{{"type", "object"},
                    {"additionalProperties", jsonSchemaOf<typename ElementOf<T>::Element>()}};
    } else {
        JsonFieldsSchema fields;
        reflect(fields, T());
        return fields.take();
    }
}

}  // namespace kaustik
