// SPDX-License-Identifier: MIT
// From declared passes to steps: bypass what is disabled, cull what nothing asks for, and share
// memory between resources whose lifetimes do not overlap.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "framework/core/error.h"
#include "framework/core/names.h"
#include "framework/graph/graph.h"

namespace kaustik::graph {
namespace {
constexpr std::size_t kNoSlot = std::numeric_limits<std::size_t>::max();
}  // namespace

struct Graph::Plan {
    std::vector<std::string> problems;
    std::vector<bool> bypassed;  // by pass
    std::vector<bool> needed;    // by pass
    // (resource, version) → resource that holds it once bypasses are followed.
    std::vector<std::vector<std::uint32_t>> home;
};

// A disabled pass needs a bypass for every output; forwarded outputs then live in their input.
void Graph::planBypasses(Plan& plan) const {
    plan.home.resize(resources_.size());
    for (std::size_t r = 0; r < resources_.size(); ++r) {
        plan.home[r].assign(resources_[r].writers.size(), static_cast<std::uint32_t>(r));
    }
    const std::vector<std::string> names = passNames();
    for (const std::string& name : disabled_) {
        if (std::find(names.begin(), names.end(), name) == names.end()) {
            plan.problems.push_back(
                fmt::format("there is no pass '{}' to disable{}", name, didYouMean(name, names)));
        }
    }
    for (std::size_t p = 0; p < passes_.size(); ++p) {
        const Pass& pass = passes_[p];
        if (pass.isSkipped || !disabled_.contains(pass.info.name)) {
            // A pass that runs must not write into memory that stands in for two resources.
            for (const ResourceRef& output : pass.outputs) {
                if (output.version == 0) continue;
                const std::uint32_t home = plan.home[output.index][output.version - 1];
                plan.home[output.index][output.version] = home;
                if (home != output.index) {
                    plan.problems.push_back(fmt::format(
                        "pass '{}' writes '{}', which stands for '{}' while a pass is disabled",
                        pass.info.name, resources_[output.index].name, resources_[home].name));
                }
            }
            continue;
        }
        plan.bypassed[p] = true;
        for (const ResourceRef& output : pass.outputs) {
            const auto bypass = std::find_if(pass.bypasses.begin(), pass.bypasses.end(),
                                             [&](const Bypass& b) { return b.output == output; });
            if (bypass == pass.bypasses.end()) {
                plan.problems.push_back(
                    fmt::format("pass '{}' cannot be disabled: nothing stands in for its output "
                                "'{}'",
                                pass.info.name, resources_[output.index].name));
            } else if (bypass->input.valid()) {
                plan.home[output.index][output.version] =
                    plan.home[bypass->input.index][bypass->input.version];
            }
        }
    }
}

// What a loop that runs hands on to its next run: the word that it asks, and of what was made
// before it the newest. True where that takes passes that were not needed so far.
bool Graph::needNextRun(Plan& plan, const PassLoop& loop) const {
    bool runs = false;
    for (std::size_t p = loop.first; p < loop.end; ++p)
        runs = runs || plan.needed[p];
    if (!runs) return false;
    std::set<std::size_t> passes;
    const auto lastWithin = [&](const Resource& resource) {
        for (std::size_t v = resource.writers.size(); v-- > 0;)
            if (loop.holds(resource.writers[v])) return resource.writers[v];
        return passes_.size();
    };
    passes.insert(lastWithin(resources_[loop.again.index]));
    for (std::size_t p = loop.first; p < loop.end; ++p) {
        if (!plan.needed[p]) continue;
        for (const ResourceRef& handle : passes_[p].reads) {
            const Resource& resource = resources_[handle.index];
            if (resource.writers.front() < loop.first) passes.insert(lastWithin(resource));
        }
    }
    bool found = false;
    for (const std::size_t pass : passes) {
        if (pass >= passes_.size() || plan.needed[pass]) continue;
        plan.needed[pass] = true;
        found = true;
    }
    return found;
}

// Walks back from what is asked for; insertion order is a topological order.
void Graph::planRequired(Plan& plan) const {
    const auto need = [&](const ResourceRef& handle) {
        plan.needed[resources_[handle.index].writers[handle.version]] = true;
    };
    const auto walkBack = [&] {
        for (std::size_t p = passes_.size(); p-- > 0;) {
            const Pass& pass = passes_[p];
            if (pass.hasSideEffect && !plan.bypassed[p]) plan.needed[p] = true;
            if (!plan.needed[p]) continue;
            if (plan.bypassed[p]) {
                for (const Bypass& bypass : pass.bypasses) {
                    if (bypass.input.valid()) need(bypass.input);
                }
            } else {
                for (const ResourceRef& handle : pass.reads)
                    need(handle);
            }
        }
    };
    for (const ResourceRef& handle : requested_)
        need(handle);
    walkBack();
    // The next frame reads what this one leaves in a resource that lasts.
    for (bool found = true; found;) {
        found = false;
        for (const Resource& resource : resources_) {
            if (!resource.isPersistent || plan.needed[resource.writers.back()]) continue;
            const auto isNeeded = [&](std::size_t pass) { return plan.needed[pass]; };
            if (!std::any_of(resource.writers.begin(), resource.writers.end(), isNeeded)) continue;
            plan.needed[resource.writers.back()] = true;
            found = true;
        }
        for (const PassLoop& loop : loops_)
            found = needNextRun(plan, loop) || found;
        if (found) walkBack();
    }
}

Graph::Plan Graph::plan() const {
    Plan plan;
    plan.problems = problems_;
    plan.bypassed.assign(passes_.size(), false);
    plan.needed.assign(passes_.size(), false);
    planBypasses(plan);
    planRequired(plan);
    return plan;
}

std::string Graph::bypassText(const Pass& pass) const {
    if (pass.isSkipped || pass.bypasses.size() < pass.outputs.size()) return "";
    std::string text;
    for (const Bypass& bypass : pass.bypasses) {
        if (!text.empty()) text += "; ";
        text +=
            bypass.input.valid()
                ? fmt::format("'{}' is '{}' unchanged", nameOf(bypass.output), nameOf(bypass.input))
                : fmt::format("'{}' is {:g} everywhere", nameOf(bypass.output), bypass.value[0]);
    }
    return text;
}

void Graph::fillRecords(const Plan& plan, Compiled& compiled) const {
    std::map<std::string, std::size_t> recordOf;
    const auto addNames = [this](std::vector<std::string>& names,
                                 const std::vector<ResourceRef>& handles) {
        for (const ResourceRef& handle : handles) {
            const std::string& name = nameOf(handle);
            if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        }
    };
    for (std::size_t p = 0; p < passes_.size(); ++p) {
        const Pass& pass = passes_[p];
        const auto known = recordOf.find(pass.info.name);
        if (known != recordOf.end()) {
            PassRecord& record = compiled.records[known->second];
            ++record.repeats;
            addNames(record.reads, pass.reads);
            addNames(record.writes, pass.outputs);
            if (record.state == PassState::culled && plan.needed[p]) {
                record.state = PassState::ran;
                record.reason = pass.info.reason;
            }
            continue;
        }
        PassRecord record{pass.info.name, PassState::ran, pass.info.reason, 1, bypassText(pass)};
        if (pass.isSkipped) {
            record.state = PassState::skipped;
        } else if (plan.bypassed[p]) {
            record.state = PassState::bypassed;
            record.reason = "disabled; " + record.bypass;
        } else if (!plan.needed[p]) {
            record.state = PassState::culled;
            std::vector<std::string> outputs;
            for (const ResourceRef& output : pass.outputs)
                outputs.push_back(nameOf(output));
            record.reason = fmt::format("nothing asks for {}", joinNames(outputs));
        }
        addNames(record.reads, pass.reads);
        addNames(record.writes, pass.outputs);
        recordOf[pass.info.name] = compiled.records.size();
        compiled.records.push_back(std::move(record));
    }
}

struct Graph::LiveRange {
    std::size_t first = kNoSlot;
    std::size_t last = 0;
    std::size_t made = kNoSlot;  // the step that first writes it
};

// Passes of a loop that read nothing that its runs change, and change nothing but what they make.
std::set<std::size_t> Graph::invariantOf(const Plan& plan, const PassLoop& loop) const {
    std::set<std::size_t> invariant;
    const auto changes = [&](const ResourceRef& handle) {
        const std::vector<std::size_t>& writers = resources_[handle.index].writers;
        return std::any_of(writers.begin(), writers.end(), [&](std::size_t writer) {
            return loop.holds(writer) && !invariant.contains(writer);
        });
    };
    for (std::size_t p = loop.first; p < loop.end; ++p) {
        const Pass& pass = passes_[p];
        if (pass.isSkipped || pass.hasSideEffect || plan.bypassed[p]) continue;
        const bool makesAll =
            std::all_of(pass.outputs.begin(), pass.outputs.end(), [&](const ResourceRef& output) {
                return output.version == 0 && resources_[output.index].writers.size() == 1;
            });
        if (makesAll && std::none_of(pass.reads.begin(), pass.reads.end(), changes))
            invariant.insert(p);
    }
    return invariant;
}

void Graph::placeLoops(const Plan& plan, const std::vector<std::size_t>& passOfStep,
                       Compiled& compiled) const {
    for (const PassLoop& loop : loops_) {
        Loop placed{passOfStep.size(), 0, loop.again, 0, loop.word, {}, loop.mayRunIdle};
        const std::set<std::size_t> invariant = invariantOf(plan, loop);
        for (std::size_t step = 0; step < passOfStep.size(); ++step) {
            if (!loop.holds(passOfStep[step])) continue;
            placed.first = std::min(placed.first, step);
            placed.last = step;
            if (invariant.contains(passOfStep[step])) placed.invariant.insert(step);
        }
        if (placed.first < passOfStep.size()) compiled.loops.push_back(placed);
    }
}

// What a loop finds from before, or leaves to what comes after it or to its next run, keeps its
// memory to itself while the loop runs.
void Graph::extendLiveRanges(const Compiled& compiled, std::vector<LiveRange>& liveRanges) {
    for (bool found = true; found;) {
        found = false;
        for (const Loop& loop : compiled.loops) {
            for (LiveRange& liveRange : liveRanges) {
                const bool isUsed = liveRange.first != kNoSlot && liveRange.first <= loop.last &&
                                    liveRange.last >= loop.first;
                const bool isWithin = liveRange.first >= loop.first && liveRange.last <= loop.last;
                const bool isKept = loop.invariant.contains(liveRange.made);
                if (!isUsed || (isWithin && !isKept)) continue;
                const LiveRange whole{std::min(liveRange.first, loop.first),
                                      std::max(liveRange.last, loop.last), liveRange.made};
                found = found || whole.first != liveRange.first || whole.last != liveRange.last;
                liveRange = whole;
            }
        }
    }
}

void Graph::assignSlots(const Plan& plan, Compiled& compiled) const {
    std::vector<LiveRange> liveRanges(resources_.size());
    const auto touch = [&](const ResourceRef& handle, std::size_t step) {
        LiveRange& liveRange = liveRanges[plan.home[handle.index][handle.version]];
        liveRange.first = std::min(liveRange.first, step);
        liveRange.last = std::max(liveRange.last, step);
    };

    std::vector<std::size_t> passOfStep;
    for (std::size_t p = 0; p < passes_.size(); ++p) {
        const Pass& pass = passes_[p];
        if (pass.isSkipped || !plan.needed[p]) continue;
        const std::size_t step = passOfStep.size();
        if (!plan.bypassed[p]) {
            for (const ResourceRef& handle : pass.reads)
                touch(handle, step);
            for (const ResourceRef& handle : pass.outputs)
                touch(handle, step);
            passOfStep.push_back(p);
            continue;
        }
        bool clears = false;
        for (const Bypass& bypass : pass.bypasses) {
            if (bypass.input.valid()) continue;
            touch(bypass.output, step);
            clears = true;
        }
        if (clears) passOfStep.push_back(p);
    }
    for (const ResourceRef& handle : requested_)
        touch(handle, passOfStep.size());
    for (std::size_t r = 0; r < resources_.size(); ++r) {
        if (resources_[r].isPersistent && liveRanges[r].first != kNoSlot)
            liveRanges[r].last = passOfStep.size();
    }
    if (keepAll_) {
        for (LiveRange& liveRange : liveRanges) {
            if (liveRange.first != kNoSlot) liveRange.last = passOfStep.size();
        }
    }

    for (LiveRange& liveRange : liveRanges)
        liveRange.made = liveRange.first;
    placeLoops(plan, passOfStep, compiled);
    extendLiveRanges(compiled, liveRanges);
    const auto isCarried = [&](const LiveRange& liveRange) {
        return std::any_of(compiled.loops.begin(), compiled.loops.end(), [&](const Loop& loop) {
            return liveRange.first >= loop.first && liveRange.first <= loop.last &&
                   (liveRange.last >= loop.last || loop.invariant.contains(liveRange.made));
        });
    };

    compiled.slotOfResource.assign(resources_.size(), kNoSlot);
    std::vector<std::size_t> freeAfter;  // by slot: last step of its tenant
    for (std::size_t step = 0; step < passOfStep.size(); ++step) {
        const Pass& pass = passes_[passOfStep[step]];
        Step compiledStep;
        compiledStep.name = pass.info.name;
        const bool bypassed = plan.bypassed[passOfStep[step]];
        if (!bypassed) {
            compiledStep.execute = pass.execute;
            compiledStep.reads = pass.reads;
            compiledStep.outputs = pass.outputs;
            compiledStep.bindings = pass.bindings;
            compiledStep.defines = pass.defines;
        }

        for (std::size_t r = 0; r < resources_.size(); ++r) {
            if (liveRanges[r].first > step || liveRanges[r].last < step) continue;
            (std::holds_alternative<TextureDesc>(resources_[r].desc)
                 ? compiledStep.liveTextureBytes
                 : compiledStep.liveBufferBytes) += bytesOf(resources_[r].desc);
            if (liveRanges[r].first != step) continue;
            const bool isPersistent = resources_[r].isPersistent;
            std::size_t slot = kNoSlot;
            for (std::size_t s = 0; s < compiled.slots.size() && slot == kNoSlot && !isPersistent;
                 ++s) {
                const bool isFree = freeAfter[s] < step;
                if (isFree && compiled.slots[s].desc == resources_[r].desc) slot = s;
            }
            if (slot == kNoSlot) {
                slot = compiled.slots.size();
                compiled.slots.push_back({resources_[r].desc, resources_[r].name, isPersistent});
                freeAfter.push_back(0);
            }
            freeAfter[slot] = liveRanges[r].last;
            compiled.slotOfResource[r] = slot;
            if (isPersistent) continue;  // it is born once
            compiledStep.undefinedSlots.push_back(slot);
            if (isCarried(liveRanges[r])) compiledStep.carriedSlots.push_back(slot);
            if (liveRanges[r].last == passOfStep.size()) compiledStep.keptSlots.push_back(slot);
        }
        compiled.peakBytes = std::max(compiled.peakBytes,
                                      compiledStep.liveTextureBytes + compiledStep.liveBufferBytes);
        if (bypassed) {
            for (const Bypass& bypass : pass.bypasses) {
                if (bypass.input.valid()) continue;
                compiledStep.clears.push_back(
                    {compiled.slotOfResource[bypass.output.index], bypass.value});
            }
        }
        compiled.steps.push_back(std::move(compiledStep));
    }

    for (Loop& loop : compiled.loops)
        loop.slot = compiled.slotOfResource[plan.home[loop.again.index][loop.again.version]];
    for (const Slot& slot : compiled.slots) {
        const std::size_t bytes = bytesOf(slot.desc);
        compiled.allocatedBytes += bytes;
        (std::holds_alternative<TextureDesc>(slot.desc) ? compiled.textureBytes
                                                        : compiled.bufferBytes) += bytes;
    }
    for (std::uint32_t r = 0; r < resources_.size(); ++r) {
        const bool aliveAtEnd =
            liveRanges[r].first != kNoSlot && liveRanges[r].last == passOfStep.size();
        compiled.names_.push_back(resources_[r].name);
        compiled.isKept_.push_back(aliveAtEnd);
        if (!aliveAtEnd) continue;
        const auto newest = static_cast<std::uint32_t>(resources_[r].writers.size() - 1);
        compiled.resources.push_back(
            {resources_[r].name, {r, newest}, resources_[r].desc, compiled.slotOfResource[r]});
    }
}

Compiled Graph::compile() const {
    const Plan plan = this->plan();
    if (!plan.problems.empty()) {
        throw GraphError(
            fmt::format("The graph cannot run:\n  {}", fmt::join(plan.problems, "\n  ")));
    }
    Compiled compiled;
    compiled.home_ = plan.home;
    fillRecords(plan, compiled);
    assignSlots(plan, compiled);
    return compiled;
}

std::string Graph::toDot() const {
    const Plan plan = this->plan();
    std::string dot = "digraph kaustik {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n";
    for (std::size_t p = 0; p < passes_.size(); ++p) {
        if (passes_[p].isSkipped) continue;
        const char* style = plan.bypassed[p] ? ", style=dashed"
                            : plan.needed[p] ? ""
                                             : ", color=gray, fontcolor=gray";
        dot += fmt::format("  p{} [shape=box, label=\"{}\"{}];\n", p, passes_[p].info.name, style);
    }
    const auto describe = [](const ResourceDesc& desc) {
        if (const auto* texture = std::get_if<TextureDesc>(&desc)) {
            const std::string layers =
                texture->layers > 0 ? fmt::format("x{}", texture->layers) : "";
            return fmt::format("{}x{}{} {}", texture->width, texture->height, layers,
                               formatName(texture->format));
        }
        return fmt::format("{} B", bytesOf(desc));
    };
    for (std::size_t r = 0; r < resources_.size(); ++r) {
        for (std::size_t v = 0; v < resources_[r].writers.size(); ++v) {
            dot += fmt::format("  r{}_{} [shape=ellipse, label=\"{}{}\\n{}\"];\n", r, v,
                               resources_[r].name, v == 0 ? "" : fmt::format(" v{}", v),
                               describe(resources_[r].desc));
            dot += fmt::format("  p{} -> r{}_{};\n", resources_[r].writers[v], r, v);
        }
    }
    for (std::size_t p = 0; p < passes_.size(); ++p) {
        for (const ResourceRef& handle : passes_[p].reads) {
            dot += fmt::format("  r{}_{} -> p{};\n", handle.index, handle.version, p);
        }
    }
    return dot + "}\n";
}

}  // namespace kaustik::graph
