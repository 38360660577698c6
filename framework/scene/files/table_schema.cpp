// SPDX-License-Identifier: MIT
#include "framework/scene/files/table_schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kaustik::scene {

using nlohmann::json;

json TableSchema::schema() const {
    json schema = {
        {"type", "object"}, {"properties", properties_}, {"additionalProperties", false}};
    if (!title_.empty()) schema["title"] = title_;
    if (!required_.empty()) schema["required"] = required_;
    if (!onlyWith_.empty()) schema["dependentRequired"] = onlyWith_;
    for (const KeyRule& rule : rules_) {
        // Of a key that is none here nothing need be said.
        const bool areKeys = std::all_of(rule.keys.begin(), rule.keys.end(), [&](const char* key) {
            return properties_.contains(key);
        });
        if (!areKeys) continue;
        json each = json::array();
        for (const char* key : rule.keys)
            each.push_back({{"required", {key}}});
        if (rule.needsOne) {
            schema["oneOf"] = each;
        } else {
            schema["not"] = {{"required", rule.keys}};
        }
    }
    return schema;
}

void TableSchema::kind(bool& hasKey, const char* key) {
    ++kinds_;
    hasKey = kind_ == 0;
    if (hasKey) title_ = key;
}

bool TableSchema::onlyWith(const char* key, const char* other) {
    onlyWith_[key] = {other};
    return true;
}

void TableSchema::foreignTable(const Key& key, const char* definition, Tables count) {
    const json one = {{"$ref", fmt::format("#/$defs/{}", definition)}};
    json schema = one;
    if (count == Tables::oneOrSeveral) {
        schema = {{"anyOf", {one, {{"type", "array"}, {"items", one}, {"minItems", 1}}}}};
    }
    addKey(key, std::move(schema), json(), false);
}

json TableSchema::ofNumbers(const NumberRange& range) {
    return {{"type", "number"},
            {range.withoutMinimum ? "exclusiveMinimum" : "minimum", shortest(range.minimum)},
            {range.withoutMaximum ? "exclusiveMaximum" : "maximum", shortest(range.maximum)}};
}

json TableSchema::ofCounts(unsigned minimum, unsigned maximum) {
    return {{"type", "integer"}, {"minimum", minimum}, {"maximum", maximum}};
}

json TableSchema::listOf(json element, std::size_t size) {
    return {
        {"type", "array"}, {"items", std::move(element)}, {"minItems", size}, {"maxItems", size}};
}

json TableSchema::oneOrList(json element, std::size_t size) {
    json list = listOf(element, size);
    return {{"anyOf", {std::move(element), std::move(list)}}};
}

json TableSchema::shortest(double value) {
    if (std::abs(value) < 1e15 && value == std::round(value))
        return static_cast<std::int64_t>(value);
    return value;
}

json TableSchema::shortest(float value) {
    const double inDecimals = std::stod(fmt::format("{}", value));
    return shortest(inDecimals);
}

void TableSchema::addKey(const Key& key, json schema, json held, bool isRequired) {
    if (!schema.contains("const")) {
        schema["description"] =
            fmt::format("{}{}{}", key.sentence, *key.unit == '\0' ? "" : ", ", key.unit);
    }
    // All components alike are written as one number where that will do.
    const bool isEven = held.is_array() && !held.empty() && schema.contains("anyOf") &&
                        std::all_of(held.begin(), held.end(),
                                    [&](const json& each) { return each == held.front(); });
    if (!held.is_null()) schema["default"] = isEven ? held.front() : held;
    properties_[key.name] = std::move(schema);
    if (isRequired) required_.push_back(key.name);
}

}  // namespace kaustik::scene
