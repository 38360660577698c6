// SPDX-License-Identifier: MIT
// kaustik list: scenes, techniques, nodes and parameters, for people or as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/core/json_text.h"
#include "framework/core/names.h"
#include "framework/scene/files/scene_file.h"

namespace kaustik::app {
namespace {

using nlohmann::json;

json listScenesAsJson() {
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

// With a technique: only the nodes that it chooses.
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
                           {"source", node.description.source}});
    }
    return entries;
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
        entries.push_back({{"name", named.fullName},
                           {"type", named.field.typeName()},
                           {"default", named.field.json()},
                           {"unit", named.field.unit},
                           {"range", named.field.rangeText()},
                           {"description", named.field.sentence}});
    }
    return entries;
}

// `width`: of the column of names.
void print(const json& entry, std::size_t width) {
    if (entry.contains("range")) {
        const json& value = entry.at("default");
        const std::string unit = entry.at("unit").get<std::string>();
        const std::string sentence = entry.at("description").get<std::string>();
        fmt::print("{} = {}{}\n    {}{} [{}]\n", entry.at("name").get<std::string>(),
                   value.is_string() ? value.get<std::string>() : value.dump(),
                   unit.empty() ? "" : " " + unit, sentence, sentence.ends_with('?') ? "" : ".",
                   entry.at("range").get<std::string>());
        return;
    }
    const std::string source = entry.value("source", "");
    fmt::print("{:<{}}  {}{}\n", entry.at("name").get<std::string>(), width,
               entry.at("description").get<std::string>(),
               source.empty() ? "" : " [" + source + "]");
}

}  // namespace

void listCommand(const ListOptions& options, const Registry& registry) {
    const std::vector<std::string> kinds = {"scenes", "techniques", "nodes", "params"};
    if (!options.technique.empty()) {
        static_cast<void>(registry.findTechnique(options.technique));
    }
    json entries;
    if (options.what == "scenes") {
        entries = listScenesAsJson();
    } else if (options.what == "techniques") {
        entries = listTechniques(registry);
    } else if (options.what == "nodes") {
        entries = listNodes(registry, options.technique);
    } else if (options.what == "params") {
        entries = listParams(registry, options.technique);
    } else {
        const std::string suggestion = didYouMean(options.what, kinds);
        throw ConfigError(fmt::format("list: there is nothing called '{}'{} There is {}.",
                                      options.what, suggestion.empty() ? "." : suggestion,
                                      joinNames(kinds)));
    }
    if (options.json) {
        fmt::print("{}\n", jsonText(entries, 2));
    } else {
        std::size_t width = 0;
        for (const json& entry : entries)
            width = std::max(width, entry.at("name").get_ref<const std::string&>().size());
        for (const json& entry : entries)
            print(entry, width);
    }
}

}  // namespace kaustik::app
