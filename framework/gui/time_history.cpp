// SPDX-License-Identifier: MIT
#include "framework/gui/time_history.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "framework/gui/medians.h"

namespace kaustik::gui {
namespace {

bool hasSameSettings(const TimedRun& run, const Document& document, const Variant& variant) {
    return run.scene == document.scene && run.size == document.size && run.variant == variant;
}

}  // namespace

void TimeHistory::note(const FrameResult& result, std::size_t index) {
    const VariantResult& rendered = result.variants[index];
    if (index == 1 && !result.document.other) return;
    // Else it is still of an order before.
    if (rendered.order != result.order || rendered.isPreview || !rendered.error.empty()) return;
    if (rendered.frameMs.empty()) return;
    const Variant& variant = index == 1 ? *result.document.other : result.document.variant;
    if (runs_.empty() || !hasSameSettings(runs_.back(), result.document, variant)) {
        TimedRun run{result.document.scene, result.document.size, variant, "", {}, {}};
        if (!runs_.empty()) run.change = changeBetween(runs_.back(), run);
        runs_.push_back(std::move(run));
        if (runs_.size() > kMaxRuns) runs_.erase(runs_.begin());
    }
    runs_.back().frameMs = rendered.frameMs;
    runs_.back().times = rendered.times;
}

std::string changeBetween(const TimedRun& before, const TimedRun& after) {
    std::vector<std::string> changes;
    const auto add = [&](const std::string& what, const std::string& a, const std::string& b) {
        if (a != b) changes.push_back(fmt::format("{}{} → {}", what, a, b));
    };
    add("scene ", before.scene, after.scene);
    add("size ", fmt::format("{}x{}", before.size.width, before.size.height),
        fmt::format("{}x{}", after.size.width, after.size.height));
    const Variant& a = before.variant;
    const Variant& b = after.variant;
    add("", a.technique + (a.isAsPublished ? " as published" : ""),
        b.technique + (b.isAsPublished ? " as published" : ""));
    std::set<std::string> names;
    for (const Variant* variant : {&a, &b}) {
        for (const auto& [name, value] : variant->assignments)
            names.insert(name);
    }
    const auto valueIn = [](const Variant& variant, const std::string& name) {
        const auto found = variant.assignments.find(name);
        return found == variant.assignments.end() ? std::string("default") : found->second;
    };
    for (const std::string& name : names)
        add(name + " ", valueIn(a, name), valueIn(b, name));
    std::set<std::string> passes = a.disabled;
    passes.insert(b.disabled.begin(), b.disabled.end());
    for (const std::string& pass : passes)
        add(pass + " ", a.disabled.contains(pass) ? "off" : "on",
            b.disabled.contains(pass) ? "off" : "on");
    return fmt::format("{}", fmt::join(changes, ", "));
}

Table timesBeforeAndAfter(const TimedRun& before, const TimedRun& after) {
    struct Both {
        std::optional<double> before;
        std::optional<double> after;
        [[nodiscard]] double difference() const {
            return after.value_or(0.0) - before.value_or(0.0);
        }
    };
    std::map<std::string, Both> passes;
    for (const report::PassTimes& pass : before.times) {
        if (!pass.gpuMilliseconds.empty())
            passes[pass.name].before = settledMedianOf(pass.gpuMilliseconds);
    }
    for (const report::PassTimes& pass : after.times) {
        if (!pass.gpuMilliseconds.empty())
            passes[pass.name].after = settledMedianOf(pass.gpuMilliseconds);
    }
    std::vector<std::pair<std::string, Both>> sorted(passes.begin(), passes.end());
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
        return std::abs(a.second.difference()) > std::abs(b.second.difference());
    });
    sorted.insert(sorted.begin(),
                  {"frame", {settledMedianOf(before.frameMs), settledMedianOf(after.frameMs)}});
    Table table{{"pass", "before, ms", "after, ms", "difference, ms"}, {}};
    const auto number = [](const std::optional<double>& value) {
        return value ? fmt::format("{:.2f}", *value) : std::string("–");
    };
    for (const auto& [name, both] : sorted) {
        table.rows.push_back({name, number(both.before), number(both.after),
                              fmt::format("{:+.2f}", both.difference())});
    }
    return table;
}

}  // namespace kaustik::gui
