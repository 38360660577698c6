// SPDX-License-Identifier: MIT
#include "framework/experiment/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "framework/core/error.h"
#include "framework/experiment/fingerprint.h"
#include "framework/experiment/resolve.h"
#include "framework/experiment/run_keys.h"

namespace kaustik::experiment {
namespace {

using nlohmann::json;

// Which value of each axis.
using Indices = std::vector<std::size_t>;

// Calls `visit` for every combination, the last axis varying fastest.
template <class Visit>
void forEachCombination(const Product& product, Visit visit) {
    Indices indices(product.size(), 0);
    for (;;) {
        visit(indices);
        std::size_t axis = product.size();
        while (axis > 0 && ++indices[axis - 1] == product[axis - 1].values.size())
            indices[--axis] = 0;
        if (axis == 0) return;
    }
}

std::vector<Setting> settingsAt(const Product& product, const Indices& indices) {
    std::vector<Setting> settings;
    for (std::size_t axis = 0; axis < product.size(); ++axis)
        settings.push_back(product[axis].values[indices[axis]]);
    return settings;
}

[[noreturn]] void failDuplicate(const Product& product, const Indices& earlier,
                                const Indices& later) {
    std::size_t axis = 0;
    while (earlier[axis] == later[axis])
        ++axis;
    const Setting& first = product[axis].values[earlier[axis]];
    const Setting& second = product[axis].values[later[axis]];
    throw ConfigError(fmt::format(
        "{}: two runs would be the same, since {} = {} sets what {} ({}) does; leave "
        "one of them out.",
        second.place, second.key, second.value.dump(), first.value.dump(), first.place));
}

void requireRunLimit(const Spec& spec) {
    double runs = 0.0;
    for (const Product& product : spec.products) {
        double combinations = 1.0;
        for (const Axis& axis : product)
            combinations *= static_cast<double>(axis.values.size());
        runs += combinations;
    }
    if (runs > static_cast<double>(kMaxRuns)) {
        throw ConfigError(
            fmt::format("{}: these are {:.0f} runs, and {} is the most; split the "
                        "experiment or permute fewer keys.",
                        spec.file.string(), runs, kMaxRuns));
    }
}

class Planner {
  public:
    Planner(const Spec& spec, const RunDefaults& defaults, const MakeParams& makeParams)
        : resolver_(spec.file, defaults, makeParams) {
        plan_.spec = spec;
    }

    void add(const Product& product, int index) {
        std::map<std::string, Indices> indicesOf;  // by hash, of this product
        forEachCombination(product, [&](const Indices& indices) {
            const std::vector<Setting> chosen = settingsAt(product, indices);
            Resolver::Resolved resolved = resolver_.resolve(plan_.spec.base, chosen);
            noteAxes(resolved, index);
            const std::string hash = fingerprint(resolved.settings.dump());
            const auto [other, isNew] = indicesOf.emplace(hash, indices);
            if (!isNew) failDuplicate(product, other->second, indices);
            const auto [position, isFirst] = runOf_.emplace(hash, plan_.runs.size());
            if (isFirst) {
                plan_.runs.push_back({std::move(resolved.settings),
                                      hash,
                                      std::move(resolved.sceneArguments),
                                      std::move(resolved.runArguments),
                                      json::object(),
                                      {},
                                      std::move(resolved.disablePlace)});
            }
            plan_.runs[position->second].products.push_back(index);
        });
    }

    [[nodiscard]] Plan take() {
        for (PlannedRun& run : plan_.runs) {
            for (const AxisDescription& axis : plan_.axes)
                run.axes[axis.key] = Resolver::valueOf(run.settings, axis.key);
        }
        return std::move(plan_);
    }

  private:
    void noteAxes(const Resolver::Resolved& resolved, int index) {
        for (const std::string& key : resolved.fullKeys) {
            auto axis =
                std::find_if(plan_.axes.begin(), plan_.axes.end(),
                             [&](const AxisDescription& known) { return known.key == key; });
            if (axis == plan_.axes.end()) {
                plan_.axes.push_back(describe(key, resolved.params));
                axis = plan_.axes.end() - 1;
            }
            if (axis->products.empty() || axis->products.back() != index) {
                axis->products.push_back(index);
            }
        }
    }

    static AxisDescription describe(const std::string& key, const params::ParamSet& params) {
        for (const RunKey& known : runKeys()) {
            if (known.name != key) continue;
            // What is a number is an axis of a figure, which says what it is.
            return {key, known.unit, *known.unit == '\0' ? "" : known.sentence, {}};
        }
        for (const params::NamedField& named : params.all()) {
            if (named.fullName == key) return {key, named.field.unit, named.field.sentence, {}};
        }
        return {key, "", "", {}};
    }

    Resolver resolver_;
    Plan plan_;
    std::map<std::string, std::size_t> runOf_;
};

}  // namespace

Plan makePlan(const Spec& spec, const RunDefaults& defaults, const MakeParams& makeParams) {
    requireRunLimit(spec);
    Planner planner(spec, defaults, makeParams);
    for (std::size_t i = 0; i < spec.products.size(); ++i)
        planner.add(spec.products[i], static_cast<int>(i));
    return planner.take();
}

}  // namespace kaustik::experiment
