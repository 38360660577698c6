// SPDX-License-Identifier: MIT
#include "framework/experiment/study_schema.h"

#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "framework/core/json_schema.h"
#include "framework/experiment/run_keys.h"
#include "framework/experiment/spec_keys.h"
#include "framework/scene/files/table_schema.h"

namespace kaustik::experiment {
namespace {

using nlohmann::json;
using Names = std::map<std::string, std::string>;

json refTo(const std::string& definition) {
    return {{"$ref", "#/$defs/" + definition}};
}

// What `list` says of a parameter, as a schema of its values.
json parameterSchema(const json& param) {
    const auto type = param.at("type").get<std::string>();
    const auto unit = param.at("unit").get<std::string>();
    json schema = {{"description", fmt::format("{}: {}{}{}", param.at("name").get<std::string>(),
                                               param.at("description").get<std::string>(),
                                               unit.empty() ? "" : ", ", unit)},
                   {"default", param.at("default")}};
    if (type == "choice") {
        schema["enum"] = param.at("choices");
    } else if (type == "bool") {
        schema["type"] = "boolean";
    } else if (type == "WxH") {
        schema["type"] = "string";
        schema["pattern"] = "^[0-9]+x[0-9]+$";
    } else {
        schema["type"] = type == "int" ? "integer" : "number";
        schema["minimum"] = param.at("minimum");
        schema["maximum"] = param.at("maximum");
    }
    return schema;
}

// Every form of a name: its dotted parts in order, any but the last left out.
std::vector<std::string> formsOf(const std::string& name) {
    const auto dot = name.find('.');
    if (dot == std::string::npos) return {name};
    std::vector<std::string> forms;
    for (const std::string& form : formsOf(name.substr(dot + 1))) {
        forms.push_back(form);
        forms.push_back(name.substr(0, dot + 1) + form);
    }
    return forms;
}

// The full name of every form that means no other.
Names fullNames(const json& params) {
    std::map<std::string, int> meanings;
    for (const json& param : params) {
        for (const std::string& form : formsOf(param.at("name")))
            ++meanings[form];
    }
    Names names;
    for (const json& param : params) {
        const auto& name = param.at("name").get_ref<const std::string&>();
        for (const std::string& form : formsOf(name)) {
            if (meanings[form] == 1 || form == name) names[form] = name;
        }
    }
    return names;
}

// Names of settings, by their dotted parts.
struct Tree {
    std::map<std::string, Tree> parts;
    const json* schema = nullptr;  // of a whole name
};

json propertiesOf(const Tree& tree) {
    json properties = json::object();
    for (const auto& [part, inner] : tree.parts) {
        json options = json::array();
        if (inner.schema != nullptr) options.push_back(*inner.schema);
        if (!inner.parts.empty()) {
            options.push_back({{"type", "object"},
                               {"additionalProperties", false},
                               {"properties", propertiesOf(inner)}});
        }
        properties[part] = options.size() == 1 ? options.front() : json{{"anyOf", options}};
    }
    return properties;
}

// Tables of settings with the schemas of their values. Keys are written in quotes,
// "trace.epsilon", and as tables, trace.epsilon.
json settingsSchema(const std::map<std::string, json>& schemas) {
    Tree tree;
    for (const auto& [name, schema] : schemas) {
        Tree* node = &tree;
        for (std::size_t begin = 0, dot = 0; dot != std::string::npos; begin = dot + 1) {
            dot = name.find('.', begin);
            node = &node->parts[name.substr(begin, dot - begin)];
        }
        node->schema = &schema;
    }
    json properties = propertiesOf(tree);
    for (const auto& [name, schema] : schemas) {
        if (name.find('.') != std::string::npos) properties[name] = schema;
    }
    return {
        {"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties)}};
}

}  // namespace

json studySchema(const json& params, const json& techniques) {
    json defs = json::object();
    std::map<std::string, json> base;     // by key as written, a value of it
    std::map<std::string, json> permute;  // values of it
    const auto add = [&](const std::string& key, const std::string& kind, const std::string& full) {
        const json value = refTo(fmt::format("{}.{}", kind, full));
        const std::string axis = "axis." + full;
        defs[axis] = {
            {"anyOf", {{{"type", "array"}, {"items", value}, {"minItems", 1}}, refTo("range")}}};
        base.emplace(key, value);
        permute.emplace(key, refTo(axis));
    };
    for (const RunKey& key : runKeys()) {
        json schema = schemaOf(key);
        if (key.name == std::string("technique")) schema["enum"] = techniques;
        defs[fmt::format("run.{}", key.name)] = std::move(schema);
        add(key.name, "run", key.name);
    }
    for (const json& param : params)
        defs["parameter." + param.at("name").get<std::string>()] = parameterSchema(param);
    for (const auto& [form, name] : fullNames(params)) {
        if (!base.contains(form)) add(form, "parameter", name);
    }
    defs["range"] = scene::tableSchema<RangeKeys>();
    defs["base"] = settingsSchema(base);
    defs["permute"] = settingsSchema(permute);
    json schema =
        eitherSchema("suite", scene::tableSchema<SuiteKeys>(), scene::tableSchema<StudyKeys>());
    schema["$defs"] = std::move(defs);
    return schemaDocument("experiment", "An experiment of Kaustik", std::move(schema));
}

}  // namespace kaustik::experiment
