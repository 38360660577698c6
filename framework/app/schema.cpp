// SPDX-License-Identifier: MIT
// kaustik schema: what scene files, experiments and reports may hold, as JSON Schema.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/core/json_text.h"
#include "framework/core/names.h"
#include "framework/experiment/study_schema.h"
#include "framework/run/listing.h"
#include "framework/run/report_schema.h"
#include "framework/scene/files/scene_schema.h"

namespace kaustik::app {
namespace {

using nlohmann::json;

json schemaOf(const std::string& what, const Registry& registry) {
    const std::vector<std::string> kinds = {"scene", "experiment", "report"};
    if (what == "scene") return scene::sceneSchema();
    if (what == "report") return run::reportSchema();
    if (what == "experiment") {
        json techniques = json::array();
        for (const json& technique : run::listTechniques(registry))
            techniques.push_back(technique.at("name"));
        return experiment::studySchema(run::listParams(registry, ""), techniques);
    }
    if (what.empty())
        throw ConfigError(fmt::format("schema: say of which file: {}.", joinNames(kinds)));
    const std::string suggestion = didYouMean(what, kinds);
    throw ConfigError(fmt::format("schema: there is none of '{}'{} There is {}.", what,
                                  suggestion.empty() ? "." : suggestion, joinNames(kinds)));
}

}  // namespace

void schemaCommand(const std::string& what, const Registry& registry) {
    fmt::print("{}\n", jsonText(schemaOf(what, registry), 1));
}

}  // namespace kaustik::app
