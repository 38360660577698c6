// SPDX-License-Identifier: MIT
// kaustik doc: a page a node, in Markdown, from what is declared: the node's description, its
// stage's, and its parameters.
#include <fmt/format.h>

#include <algorithm>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/names.h"

namespace kaustik::app {
namespace {

namespace fs = std::filesystem;

std::string fullName(const Registry::Node& node) {
    return node.stage + "." + node.name;
}

// By its full name, or by its own where no other stage has one of that name.
const Registry::Node& findNode(const Registry& registry, const std::string& name) {
    const std::size_t dot = name.find('.');
    if (dot != std::string::npos)
        return registry.findNode(name.substr(0, dot), name.substr(dot + 1));
    std::vector<const Registry::Node*> found;
    std::vector<std::string> candidates;
    std::vector<std::string> all;
    for (const Registry::Node& node : registry.nodes()) {
        all.push_back(node.name);
        if (node.name != name && node.stage != name) continue;
        found.push_back(&node);
        candidates.push_back(fullName(node));
    }
    if (found.size() == 1) return *found.front();
    if (found.empty()) {
        const std::string suggestion = didYouMean(name, all);
        throw ConfigError(fmt::format("doc: there is no node '{}'{}", name,
                                      suggestion.empty() ? "." : suggestion));
    }
    throw ConfigError(
        fmt::format("doc: '{}' may be any of {}; take one of them.", name, joinNames(candidates)));
}

// A cell of a table ends at a bar.
std::string cell(const std::string& text) {
    std::string escaped;
    for (const char c : text)
        escaped += c == '|' ? std::string("\\|") : std::string(1, c);
    return escaped;
}

std::string parameterTable(const std::vector<params::NamedField>& parameters) {
    std::string table =
        "| parameter | default | unit | range | what it is |\n| --- | --- | --- | --- | --- |\n";
    for (const params::NamedField& parameter : parameters) {
        table +=
            fmt::format("| `{}` | {} | {} | {} | {} |\n", parameter.fullName, parameter.defaultText,
                        parameter.field.unit.empty() ? "–" : parameter.field.unit,
                        cell(parameter.field.rangeText()), cell(parameter.field.sentence));
    }
    return table;
}

// The techniques that have the node in their row of answers.
std::vector<std::string> techniquesWith(const Registry& registry, const Registry::Node& node) {
    std::vector<std::string> names;
    for (const Technique& technique : registry.techniques()) {
        if (registry.makeParams(technique).choice(node.stage) == node.name)
            names.push_back("`" + technique.name + "`");
    }
    return names;
}

std::string pageOf(const Registry& registry, const Registry::Node& node) {
    const auto stage =
        std::find_if(registry.stages().begin(), registry.stages().end(),
                     [&](const Registry::StageEntry& entry) { return entry.name == node.stage; });
    const std::vector<std::string> techniques = techniquesWith(registry, node);
    std::string page = fmt::format(
        "# {0}\n\n{1}\n\n"
        "| | |\n| --- | --- |\n"
        "| source | {2} |\n"
        "| stage | `{3}`: {4} |\n"
        "| takes | {5} |\n"
        "| gives | {6} |\n"
        "| setting | `--set {3}={7}` |\n"
        "| in the row of | {8} |\n\n"
        "## Limits\n\n{9}\n\n## Parameters\n\n",
        fullName(node), node.description.sentence,
        node.description.source.empty() ? "our own" : cell(node.description.source), node.stage,
        stage->question, stage->takes, stage->gives, node.name,
        techniques.empty() ? "no technique" : joinNames(techniques), node.description.limits);
    std::vector<params::NamedField> own;
    std::vector<params::NamedField> shared;
    for (params::NamedField& parameter : registry.makeParams({}).all()) {
        const std::string& name = parameter.fullName;
        if (name.starts_with(fullName(node) + ".")) {
            own.push_back(std::move(parameter));
        } else if (name.starts_with(node.stage + ".") &&
                   std::count(name.begin(), name.end(), '.') == 1) {
            shared.push_back(std::move(parameter));
        }
    }
    page += own.empty() ? "It has none of its own.\n" : parameterTable(own);
    if (!shared.empty()) {
        page += fmt::format("\nShared by all nodes of stage `{}`:\n\n{}", node.stage,
                            parameterTable(shared));
    }
    return page;
}

std::string indexOf(const Registry& registry) {
    std::string index = "# The nodes\n\nOne page each, by stage, in the order of a frame.\n";
    for (const Registry::StageEntry& stage : registry.stages()) {
        index += fmt::format("\n## {}\n\n{} Takes: {}. Gives: {}.\n\n", stage.name, stage.question,
                             stage.takes, stage.gives);
        for (const Registry::Node& node : registry.nodes()) {
            if (node.stage != stage.name) continue;
            index +=
                fmt::format("- [{0}]({0}.md): {1}\n", fullName(node), node.description.sentence);
        }
    }
    return index;
}

}  // namespace

void docCommand(const DocOptions& options, const Registry& registry) {
    if (!options.node.empty()) {
        const Registry::Node& node = findNode(registry, options.node);
        const std::string page = pageOf(registry, node);
        if (options.out.empty()) {
            fmt::print("{}", page);
            return;
        }
        const fs::path file = fs::path(options.out) / (fullName(node) + ".md");
        writeFileWhole(file, page);
        fmt::print("wrote {}\n", file.string());
        return;
    }
    const fs::path folder =
        options.out.empty() ? fs::path("results/runs/doc") : fs::path(options.out);
    for (const Registry::Node& node : registry.nodes())
        writeFileWhole(folder / (fullName(node) + ".md"), pageOf(registry, node));
    writeFileWhole(folder / "index.md", indexOf(registry));
    fmt::print("wrote {} pages and index.md into {}\n", registry.nodes().size(), folder.string());
}

}  // namespace kaustik::app
