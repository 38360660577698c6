// SPDX-License-Identifier: MIT
#include "framework/core/json_schema.h"

#include <fmt/format.h>

namespace kaustik {

using nlohmann::json;

json schemaDocument(const std::string& name, const std::string& title, json schema) {
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
    schema["$id"] = fmt::format("{}.schema.json", name);
    schema["title"] = title;
    return schema;
}

json eitherSchema(const std::string& key, json with, json without) {
    return {{"if", {{"type", "object"}, {"required", {key}}}},
            {"then", std::move(with)},
            {"else", std::move(without)}};
}

void JsonFieldsSchema::add(const std::string& name, json schema, const std::string& sentence,
                           bool isRequired) {
    if (!sentence.empty()) schema["description"] = sentence;
    properties_[name] = std::move(schema);
    if (isRequired) required_.push_back(name);
}

void JsonFieldsSchema::addReasons() {
    add("reasons", jsonSchemaOf<std::map<std::string, std::string>>(),
        "By key, why a number is none", false);
}

json JsonFieldsSchema::orNull(json schema) {
    return {{"anyOf", {std::move(schema), {{"type", "null"}}}}};
}

json JsonFieldsSchema::take() {
    json schema = {{"type", "object"},
                   {"properties", std::move(properties_)},
                   {"additionalProperties", false}};
    if (!required_.empty()) schema["required"] = std::move(required_);
    return schema;
}

}  // namespace kaustik
