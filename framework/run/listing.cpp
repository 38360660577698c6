// SPDX-License-Identifier: MIT
#include "framework/run/listing.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "framework/scene/files/scene_file.h"

namespace kaustik::run {

using nlohmann::json;

namespace {

// A limit as it was declared, in single precision.
json shortest(double limit) {
    if (std::abs(limit) < 1e15 && limit == std::round(limit))
        return static_cast<std::int64_t>(limit);
    return json::parse(fmt::format("{}", static_cast<float>(limit)));
}

}  // namespace

json listScenes() {
    json entries = json::array();
    for (const scene::SceneListing& scene : scene::listScenes()) {
        entries.push_back({{"name", scene.name},
                           {"description", scene.description},
                           {"file", scene.file.string()}});
    }
    return entries;
}

json listTechniques(const Registry& registry) {
    json entries = json::array();
    for (const Technique& technique : registry.techniques()) {
        json defaults = json::object();
        for (const auto& [name, value] : technique.defaults)
            defaults[name] = value;
        entries.push_back({{"name", technique.name},
                           {"description", technique.sentence},
                           {"source", technique.source},
                           {"defaults", defaults}});
    }
    return entries;
}

json listNodes(const Registry& registry, const std::string& techniqueName) {
    json entries = json::array();
    params::ParamSet params;
    if (!techniqueName.empty()) {
        params = registry.makeParams(registry.findTechnique(techniqueName));
    }
    for (const Registry::Node& node : registry.nodes()) {
        if (!techniqueName.empty() && params.choice(node.stage) != node.name) continue;
        entries.push_back({{"name", node.stage + "." + node.name},
                           {"stage", node.stage},
                           {"description", node.description.sentence},
                           {"source", node.description.source},
                           {"limits", node.description.limits}});
    }
    return entries;
}

json describe(const params::NamedField& named) {
    json entry = {{"name", named.fullName},           {"type", named.field.typeName()},
                  {"default", named.field.json()},    {"unit", named.field.unit},
                  {"range", named.field.rangeText()}, {"description", named.field.sentence}};
    if (!named.field.choices.empty()) {
        entry["choices"] = named.field.choices;
    } else if (entry["type"] != "bool") {
        entry["minimum"] = shortest(named.field.minimum);
        entry["maximum"] = shortest(named.field.maximum);
    }
    return entry;
}

json listParams(const Registry& registry, const std::string& techniqueName) {
    const std::string name =
        techniqueName.empty() ? registry.techniques().front().name : techniqueName;
    const params::ParamSet params = registry.makeParams(registry.findTechnique(name));
    json entries = json::array();
    for (const params::NamedField& named : params.all()) {
        const auto dot = named.fullName.find('.');
        const auto secondDot = named.fullName.find('.', dot + 1);
        const bool isOfNode = dot != std::string::npos && secondDot != std::string::npos;
        if (isOfNode && !techniqueName.empty() &&
            params.choice(named.fullName.substr(0, dot)) !=
                named.fullName.substr(dot + 1, secondDot - dot - 1)) {
            continue;
        }
        entries.push_back(describe(named));
    }
    return entries;
}

}  // namespace kaustik::run
