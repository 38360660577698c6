// SPDX-License-Identifier: MIT
// kaustik list: scenes, techniques, nodes and parameters, for people or as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/core/json_text.h"
#include "framework/core/names.h"
#include "framework/run/listing.h"

namespace kaustik::app {
namespace {

using nlohmann::json;

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
        static_cast<void>(registry.findTechnique(options.technique, options.isAsPublished));
    }
    if (options.isAsPublished && options.technique.empty())
        throw ConfigError("list: --as-published asks for a --technique.");
    json entries;
    if (options.what == "scenes") {
        entries = run::listScenes();
    } else if (options.what == "techniques") {
        entries = run::listTechniques(registry);
    } else if (options.what == "nodes") {
        entries = run::listNodes(registry, options.technique, options.isAsPublished);
    } else if (options.what == "params") {
        entries = run::listParams(registry, options.technique, options.isAsPublished);
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
