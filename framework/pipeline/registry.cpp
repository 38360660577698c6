// SPDX-License-Identifier: MIT
#include "framework/pipeline/registry.h"

#include <fmt/format.h>

#include <algorithm>

#include "framework/core/error.h"
#include "framework/core/names.h"

namespace kaustik {

void Registry::addNode(Node node) {
    for (const Node& other : nodes_) {
        if (other.stage != node.stage || other.name != node.name) continue;
        throw ConfigError(
            fmt::format("The node '{}.{}' is registered twice.", node.stage, node.name));
    }
    nodes_.push_back(std::move(node));
}

void Registry::addStage(StageEntry stage) {
    const bool isKnown = std::any_of(stages_.begin(), stages_.end(), [&](const StageEntry& other) {
        return other.name == stage.name;
    });
    if (!isKnown) stages_.push_back(std::move(stage));
}

void Registry::technique(Technique technique) {
    for (const Technique& other : techniques_) {
        if (other.name != technique.name) continue;
        throw ConfigError(fmt::format("The technique '{}' is registered twice.", technique.name));
    }
    techniques_.push_back(std::move(technique));
}

void Registry::paper(Paper paper) {
    for (const Paper& other : papers_) {
        if (other.name != paper.name) continue;
        throw ConfigError(fmt::format("The paper '{}' is registered twice.", paper.name));
    }
    papers_.push_back(std::move(paper));
}

const Technique& Registry::findTechnique(const std::string& name) const {
    std::vector<std::string> names;
    for (const Technique& technique : techniques_) {
        if (technique.name == name) return technique;
        names.push_back(technique.name);
    }
    throw ConfigError(fmt::format("There is no technique '{}'{}; there is {}.", name,
                                  didYouMean(name, names), joinNames(names)));
}

Technique Registry::findTechnique(const std::string& name, bool isAsPublished) const {
    Technique technique = findTechnique(name);
    if (!isAsPublished) return technique;
    if (technique.asPublished.empty()) {
        std::vector<std::string> papers;
        for (const Technique& other : techniques_) {
            if (!other.asPublished.empty()) papers.push_back(other.name);
        }
        throw ConfigError(fmt::format(
            "The technique '{}' is no paper's: it has no row as published. Those that have one: "
            "{}.",
            technique.name, joinNames(papers)));
    }
    // A later one counts more.
    technique.defaults.insert(technique.defaults.end(), technique.asPublished.begin(),
                              technique.asPublished.end());
    technique.isAsPublished = true;
    return technique;
}

const Registry::Node& Registry::findNode(const std::string& stage, const std::string& name) const {
    std::vector<std::string> names;
    for (const Node& node : nodes_) {
        if (node.stage == stage && node.name == name) return node;
        names.push_back(node.stage + "." + node.name);
    }
    const std::string full = stage + "." + name;
    const std::string suggestion = didYouMean(full, names);
    throw ConfigError(
        fmt::format("There is no node '{}'{}", full, suggestion.empty() ? "." : suggestion));
}

params::ParamSet Registry::makeParams(const Technique& technique) const {
    params::ParamSet set;
    for (const StageEntry& stage : stages_) {
        std::vector<std::string> options;
        for (const Node& node : nodes_) {
            if (node.stage == stage.name) options.push_back(node.name);
        }
        if (!options.empty())
            set.declareChoice(stage.name, stage.question, options, options.front());
    }
    for (const auto& declare : declarations_)
        declare(set);
    for (const auto& [name, value] : technique.defaults)
        set.setDefault(name, value,
                       fmt::format("technique '{}'{}", technique.name,
                                   technique.isAsPublished ? " as published" : ""));
    return set;
}

}  // namespace kaustik
