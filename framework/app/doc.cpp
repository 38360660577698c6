// SPDX-License-Identifier: MIT
// kaustik doc: a page a node, in Markdown, from what is declared: the node's description, its
// stage's, its parameters, and the papers that these cite.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/names.h"
#include "framework/pipeline/effect.h"

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

// The techniques whose row of answers names the node.
std::vector<std::string> techniquesWith(const Registry& registry, const Registry::Node& node) {
    std::vector<std::string> names;
    for (const Technique& technique : registry.techniques()) {
        const params::ParamSet params = registry.makeParams(technique);
        const bool choosesForStage = std::any_of(
            technique.defaults.begin(), technique.defaults.end(), [&](const auto& answer) {
                return params.resolve(answer.first, technique.name) == node.stage;
            });
        if (choosesForStage && params.choice(node.stage) == node.name)
            names.push_back("`" + technique.name + "`");
    }
    return names;
}

std::string rowsWith(const Registry& registry, const Registry::Node& node) {
    const std::vector<std::string> techniques = techniquesWith(registry, node);
    std::string rows = techniques.empty() ? "no technique" : joinNames(techniques);
    if (registry.makeParams({}).choice(node.stage) == node.name)
        rows += "; where a row says nothing of the stage, it is this node";
    return rows;
}

// Whether `name` is in the text as a word of its own.
bool cites(const std::string& text, const std::string& name) {
    const auto isPartOfWord = [&](std::size_t at) {
        return at < text.size() && std::isalnum(static_cast<unsigned char>(text[at])) != 0;
    };
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
        if (!(at > 0 && isPartOfWord(at - 1)) && !isPartOfWord(at + name.size())) return true;
    }
    return false;
}

std::string bibliography(const std::vector<Paper>& papers) {
    if (papers.empty()) return "";
    std::string text = "\n## Papers\n\n";
    for (const Paper& paper : papers)
        text += fmt::format("- {}: {}\n", paper.name, paper.citation);
    return text;
}

// What the short names on a page stand for.
std::string papersOf(const Registry& registry, const std::string& page) {
    std::vector<Paper> cited;
    std::copy_if(registry.papers().begin(), registry.papers().end(), std::back_inserter(cited),
                 [&](const Paper& paper) { return cites(page, paper.name); });
    return bibliography(cited);
}

std::string pageOf(const Registry& registry, const Registry::Node& node) {
    const auto stage =
        std::find_if(registry.stages().begin(), registry.stages().end(),
                     [&](const Registry::StageEntry& entry) { return entry.name == node.stage; });
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
        stage->question, stage->takes, stage->gives, node.name, rowsWith(registry, node),
        node.description.limits);
    std::vector<params::NamedField> own;
    std::vector<params::NamedField> shared;
    for (params::NamedField& named : registry.makeParams({}).all()) {
        const ParameterName name = splitParameterName(named.fullName);
        if (name.stage != node.stage || name.parameter.empty()) continue;
        if (name.node == node.name) {
            own.push_back(std::move(named));
        } else if (name.node.empty()) {
            shared.push_back(std::move(named));
        }
    }
    page += own.empty() ? "It has none of its own.\n" : parameterTable(own);
    if (!shared.empty()) {
        page += fmt::format("\nShared by all nodes of stage `{}`:\n\n{}", node.stage,
                            parameterTable(shared));
    }
    return page + papersOf(registry, page);
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
    return index + bibliography(registry.papers());
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
