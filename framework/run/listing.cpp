// SPDX-License-Identifier: MIT
#include "framework/run/listing.h"

#include <nlohmann/json.hpp>

#include "framework/core/number_text.h"
#include "framework/pipeline/default_technique.h"
#include "framework/pipeline/effect.h"
#include "framework/scene/files/scene_file.h"

namespace kaustik::run {

using nlohmann::json;

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
        json published = json::object();
        for (const auto& [name, value] : technique.asPublished)
            published[name] = value;
        entries.push_back({{"name", technique.name},
                           {"description", technique.sentence},
                           {"source", technique.source},
                           {"defaults", defaults},
                           {"as_published", published}});
    }
    return entries;
}

json listNodes(const Registry& registry, const std::string& techniqueName, bool isAsPublished) {
    json entries = json::array();
    params::ParamSet params;
    if (!techniqueName.empty()) {
        params = registry.makeParams(registry.findTechnique(techniqueName, isAsPublished));
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
        entry["minimum"] = json::parse(numberText(named.field.minimum));
        entry["maximum"] = json::parse(numberText(named.field.maximum));
        if (!named.field.values.empty()) entry["values"] = named.field.values;
    }
    return entry;
}

json listParams(const Registry& registry, const std::string& techniqueName, bool isAsPublished) {
    const std::string name = techniqueName.empty() ? kDefaultTechnique : techniqueName;
    const params::ParamSet params =
        registry.makeParams(registry.findTechnique(name, isAsPublished));
    json entries = json::array();
    for (const params::NamedField& named : params.all()) {
        if (!techniqueName.empty() && isOfOtherNode(splitParameterName(named.fullName), params))
            continue;
        entries.push_back(describe(named));
    }
    return entries;
}

}  // namespace kaustik::run
