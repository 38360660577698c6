// SPDX-License-Identifier: MIT
// Declaring passes and resources; compile.cpp turns them into steps.
#include "framework/graph/graph.h"

#include <fmt/format.h>

#include <algorithm>

#include "framework/core/error.h"

namespace kaustik::graph {

ResourceRef PassSetup::createResource(const std::string& name, ResourceDesc desc) {
    const auto [known, isNew] = graph_.resourceOfName_.emplace(name, graph_.resources_.size());
    if (!isNew) {
        const Graph::Resource& other = graph_.resources_[known->second];
        graph_.problems_.push_back(
            fmt::format("pass '{}' creates '{}', which pass '{}' has created already",
                        graph_.passes_[pass_].info.name, name,
                        graph_.passes_[other.writers.front()].info.name));
    }
    if (bytesOf(desc) == 0) {
        graph_.problems_.push_back(fmt::format("pass '{}' creates '{}' with no bytes",
                                               graph_.passes_[pass_].info.name, name));
    }
    graph_.resources_.push_back({name, desc, {pass_}, false});
    const ResourceRef handle{static_cast<std::uint32_t>(graph_.resources_.size() - 1), 0};
    graph_.passes_[pass_].outputs.push_back(handle);
    return handle;
}

void PassSetup::makePersistent(const ResourceRef& handle) {
    graph_.resources_[handle.index].isPersistent = true;
}

void PassSetup::readResource(const ResourceRef& handle) {
    if (graph_.check(handle, pass_, "reads")) graph_.passes_[pass_].reads.push_back(handle);
}

ResourceRef PassSetup::writeResource(const ResourceRef& handle) {
    if (!graph_.check(handle, pass_, "writes")) return handle;
    Graph::Resource& resource = graph_.resources_[handle.index];
    if (handle.version + 1 != resource.writers.size()) {
        graph_.problems_.push_back(fmt::format("pass '{}' writes '{}' twice from one version",
                                               graph_.passes_[pass_].info.name, resource.name));
        return handle;
    }
    graph_.passes_[pass_].reads.push_back(handle);
    resource.writers.push_back(pass_);
    const ResourceRef next{handle.index, handle.version + 1};
    graph_.passes_[pass_].outputs.push_back(next);
    return next;
}

void PassSetup::bypassForward(const ResourceRef& output, const ResourceRef& input) {
    if (!graph_.checkBypassed(output, pass_) || !graph_.check(input, pass_, "forwards")) return;
    Graph::Pass& pass = graph_.passes_[pass_];
    if (graph_.resources_[output.index].desc != graph_.resources_[input.index].desc) {
        graph_.problems_.push_back(
            fmt::format("pass '{}' forwards '{}' as '{}', which is of another size or format",
                        pass.info.name, graph_.nameOf(input), graph_.nameOf(output)));
    }
    pass.reads.push_back(input);
    pass.bypasses.push_back({output, input, {}});
}

void PassSetup::bypass(const ResourceRef& output, ClearValue value) {
    if (!graph_.checkBypassed(output, pass_)) return;
    graph_.passes_[pass_].bypasses.push_back({output, {}, value});
}

bool PassSetup::isOutput(const ResourceRef& handle) const {
    const std::vector<ResourceRef>& outputs = graph_.passes_[pass_].outputs;
    return std::find(outputs.begin(), outputs.end(), handle) != outputs.end();
}

void PassSetup::bind(const std::string& name, const ResourceRef& handle, BindAs as) {
    Graph::Pass& pass = graph_.passes_[pass_];
    for (const Binding& other : pass.bindings) {
        if (other.name != name || other.handle == handle) continue;
        graph_.problems_.push_back(
            fmt::format("pass '{}' binds two resources as '{}'", pass.info.name, name));
    }
    pass.bindings.push_back({name, handle, as});
}

void PassSetup::define(const std::string& name) {
    std::vector<std::string>& defines = graph_.passes_[pass_].defines;
    if (std::find(defines.begin(), defines.end(), name) == defines.end()) defines.push_back(name);
}

void PassSetup::sideEffect() {
    graph_.passes_[pass_].hasSideEffect = true;
}

std::size_t Graph::beginPass(PassInfo info) {
    passes_.push_back({});
    passes_.back().info = std::move(info);
    return passes_.size() - 1;
}

void Graph::setExecute(std::size_t pass, std::function<void(ExecuteContext&)> execute) {
    passes_[pass].execute = std::move(execute);
}

bool Graph::isMade(const ResourceRef& handle) const {
    return handle.valid() && handle.index < resources_.size() &&
           handle.version < resources_[handle.index].writers.size();
}

bool Graph::check(const ResourceRef& handle, std::size_t pass, const char* verb) {
    const std::string& passName = passes_[pass].info.name;
    if (!isMade(handle)) {
        problems_.push_back(
            fmt::format("pass '{}' {} a handle that no pass has made", passName, verb));
        return false;
    }
    const Resource& resource = resources_[handle.index];
    const std::size_t newest = resource.writers.size() - 1;
    // A pass that writes may still name, in its bypass, the version that it replaced.
    const bool replacedByThisPass =
        handle.version + 1 == newest && resource.writers[newest] == pass;
    if (handle.version == newest || replacedByThisPass) return true;
    problems_.push_back(fmt::format(
        "pass '{}' {} version {} of '{}', which is stale: pass '{}' has written version {}",
        passName, verb, handle.version, resource.name, passes_[resource.writers[newest]].info.name,
        newest));
    return false;
}

bool Graph::checkBypassed(const ResourceRef& output, std::size_t pass) {
    const std::vector<ResourceRef>& outputs = passes_[pass].outputs;
    if (std::find(outputs.begin(), outputs.end(), output) != outputs.end()) return true;
    problems_.push_back(fmt::format(
        "pass '{}' says what stands in for {}, which it does not make", passes_[pass].info.name,
        isMade(output) ? "'" + resources_[output.index].name + "'"
                       : std::string("a handle that no pass has made")));
    return false;
}

void Graph::beginLoop() {
    openLoops_.push_back(passes_.size());
}

void Graph::endLoop(const ResourceRef& again, std::size_t word, bool mayRunIdle) {
    if (openLoops_.empty()) {
        problems_.emplace_back("a loop ends that has not begun");
        return;
    }
    const PassLoop loop{openLoops_.back(), passes_.size(), again, word, mayRunIdle};
    openLoops_.pop_back();
    if (!isMade(again)) {
        problems_.emplace_back("a loop asks a handle that no pass has made whether to go on");
        return;
    }
    const std::vector<std::size_t>& writers = resources_[again.index].writers;
    if (std::none_of(writers.begin(), writers.end(),
                     [&](std::size_t pass) { return loop.holds(pass); })) {
        problems_.push_back(
            fmt::format("a loop asks '{}' whether to go on, which none of its "
                        "passes writes",
                        resources_[again.index].name));
        return;
    }
    loops_.push_back(loop);
}

void Graph::skip(std::string name, std::string reason) {
    passes_.push_back({});
    passes_.back().info = {std::move(name), std::move(reason)};
    passes_.back().isSkipped = true;
}

void Graph::request(const ResourceRef& handle, const std::string& what) {
    if (!isMade(handle)) {
        problems_.push_back(fmt::format("{} is asked for that no pass has made", what));
        return;
    }
    requested_.push_back(handle);
}

const Graph::Resource& Graph::resourceOf(const ResourceRef& handle) const {
    if (!isMade(handle)) {
        throw GraphError("The graph is asked about a handle that none of its passes has made.");
    }
    return resources_[handle.index];
}

const std::string& Graph::nameOf(const ResourceRef& handle) const {
    return resourceOf(handle).name;
}

const ResourceDesc& Graph::descOf(const ResourceRef& handle) const {
    return resourceOf(handle).desc;
}

void Graph::rename(const ResourceRef& handle, std::string name) {
    static_cast<void>(nameOf(handle));  // refuses what no pass has made
    resources_[handle.index].name = std::move(name);
}

std::vector<std::string> Graph::resourceNames() const {
    std::vector<std::string> names;
    for (const Resource& resource : resources_)
        names.push_back(resource.name);
    return names;
}

ResourceRef Graph::find(const std::string& name) const {
    for (std::uint32_t i = 0; i < resources_.size(); ++i) {
        if (resources_[i].name == name) {
            return {i, static_cast<std::uint32_t>(resources_[i].writers.size() - 1)};
        }
    }
    return {};
}

std::vector<std::string> Graph::passNames() const {
    std::vector<std::string> names;
    for (const Pass& pass : passes_) {
        const bool isNew = std::find(names.begin(), names.end(), pass.info.name) == names.end();
        if (!pass.isSkipped && isNew) names.push_back(pass.info.name);
    }
    return names;
}

}  // namespace kaustik::graph
