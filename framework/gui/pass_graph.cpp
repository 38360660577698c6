// SPDX-License-Identifier: MIT
#include "framework/gui/pass_graph.h"

#include <algorithm>
#include <map>

namespace kaustik::gui {
namespace {

using graph::PassRecord;
using graph::PassState;

bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::string stageOfPass(const std::string& pass) {
    return pass.substr(0, pass.find('.'));
}

std::vector<std::string> usersOf(const std::vector<PassRecord>& passes, const std::string& resource,
                                 std::vector<std::string> PassRecord::*uses) {
    std::vector<std::string> users;
    for (const PassRecord& pass : passes) {
        if (pass.state != PassState::culled && has(pass.*uses, resource))
            users.push_back(pass.name);
    }
    return users;
}

}  // namespace

PassGraph passGraphOf(const std::vector<PassRecord>& passes) {
    PassGraph graph;
    std::vector<std::size_t> lengths;
    // By resource, the node that has written it last.
    std::map<std::string, std::size_t> writer;
    for (std::size_t i = 0; i < passes.size(); ++i) {
        const PassRecord& pass = passes[i];
        if (pass.state == PassState::skipped) continue;
        const std::string stage = stageOfPass(pass.name);
        const auto found = std::find(graph.columns.begin(), graph.columns.end(), stage);
        const auto column = static_cast<std::size_t>(found - graph.columns.begin());
        if (found == graph.columns.end()) {
            graph.columns.push_back(stage);
            lengths.push_back(0);
        }
        const std::size_t node = graph.nodes.size();
        graph.nodes.push_back({i, column, lengths[column]++});
        graph.rows = std::max(graph.rows, lengths[column]);
        std::map<std::size_t, std::vector<std::string>> sources;
        for (const std::string& name : resourcesOf(pass)) {
            if (const auto from = writer.find(name); from != writer.end())
                sources[from->second].push_back(name);
        }
        for (auto& [from, names] : sources)
            graph.edges.push_back({from, node, std::move(names)});
        // What is culled writes nothing that others would read.
        if (pass.state == PassState::culled) {
            for (const std::string& name : pass.writes)
                writer.emplace(name, node);
            continue;
        }
        for (const std::string& name : pass.writes)
            writer[name] = node;
    }
    return graph;
}

std::vector<std::string> resourcesOf(const PassRecord& pass) {
    std::vector<std::string> names = pass.reads;
    for (const std::string& name : pass.writes) {
        if (!has(names, name)) names.push_back(name);
    }
    return names;
}

std::vector<std::string> writersOf(const std::vector<PassRecord>& passes,
                                   const std::string& resource) {
    return usersOf(passes, resource, &PassRecord::writes);
}

std::vector<std::string> readersOf(const std::vector<PassRecord>& passes,
                                   const std::string& resource) {
    return usersOf(passes, resource, &PassRecord::reads);
}

const char* nameOf(PassState state) {
    switch (state) {
        case PassState::ran:
            return "ran";
        case PassState::bypassed:
            return "bypassed";
        case PassState::culled:
            return "culled";
        case PassState::skipped:
            break;
    }
    return "skipped";
}

}  // namespace kaustik::gui
