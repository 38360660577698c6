// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/mixtures/mixture.h"

namespace kaustik::mixtures {
namespace {

// How often a stage's node, and a parameter of a chosen node, is not what the technique has.
constexpr double kNodeChance = 0.3;
constexpr double kParameterChance = 0.2;
// How often what is drawn is fitted together where it would be refused else.
constexpr double kFitChance = 0.9;

bool isPowerOfTwo(const std::string& name) {
    return name == "refine.finest" || name == "refine.start" || name == "refine.check";
}

double drawNumber(Random& random, const params::Range<double>& range, bool isWhole) {
    const double end = random.uniform();
    if (end < 0.3) return range.minimum;
    if (end < 0.6) return range.maximum;
    // Between them evenly on a logarithmic scale, or from a thousandth of the larger end on.
    const double least =
        range.minimum > 0.0 ? range.minimum : std::max(1e-3 * range.maximum, isWhole ? 1.0 : 0.0);
    return least * std::pow(range.maximum / least, random.uniform());
}

int nearestOf(const std::vector<int>& values, double number) {
    return *std::min_element(values.begin(), values.end(), [&](int a, int b) {
        return std::abs(a - number) < std::abs(b - number);
    });
}

std::string drawValue(Random& random, const params::NamedField& parameter) {
    const params::Field& field = parameter.field;
    const std::string type = field.typeName();
    if (type == "choice") return random.of(field.choices);
    if (type == "bool") return random.chance(0.5) ? "true" : "false";
    const params::Range<double> range = drawnRange(parameter);
    const auto whole = [&] {
        double value = std::round(drawNumber(random, range, true));
        if (isPowerOfTwo(parameter.fullName)) value = std::exp2(std::round(std::log2(value)));
        if (!field.values.empty()) value = nearestOf(field.values, value);
        return static_cast<long long>(value);
    };
    if (type == "int") return fmt::format("{}", whole());
    if (type == "WxH") {
        const long long width = whole();
        return fmt::format("{}x{}", width, whole());
    }
    return fmt::format("{:.6g}", drawNumber(random, range, false));
}

// Whether the parameter is a stage's or of a node that may run.
bool isOfMixture(const std::string& name, const params::ParamSet& params) {
    const auto dot = name.find('.');
    if (dot == std::string::npos) return false;
    const auto nodeEnd = name.find('.', dot + 1);
    if (nodeEnd == std::string::npos) return true;
    const std::string chosen = params.choice(name.substr(0, dot));
    return chosen == "auto" || chosen == name.substr(dot + 1, nodeEnd - dot - 1);
}

// What would be refused nearly always is seldom drawn.
void fitTogether(Random& random, Mixture& mixture) {
    const params::ParamSet params = paramsOf(mixture);
    const std::string space = params.find("reconstruct.space").text();
    const std::string driver = params.choice(DriverStage::name);
    const std::string filter =
        registry().traits<ReconstructStage>(params.choice(ReconstructStage::name)).filter;
    if (random.chance(kFitChance)) {
        mixture.set(GatherStage::name, space == "light"  ? "project"
                                       : space == "cube" ? "cube"
                                                         : "screen");
    }
    if (!filter.empty() && random.chance(kFitChance)) mixture.set(FilterStage::name, filter);
    if (filter.empty() && params.choice(FilterStage::name) != "blur" && random.chance(kFitChance))
        mixture.set(FilterStage::name, "none");
    if (driver != "dense" && random.chance(kFitChance)) mixture.set(EmitStage::name, "deferred");
}

}  // namespace

// In the order in which the first that fits counts.
const std::vector<CostlyEnd>& costlyEnds() {
    static const std::vector<CostlyEnd> ends = {
        {"emit.photons", 1, 64},
        {"emit.batch", 512, 1 << 20},
        // So that lengths may be scaled by 0.1 and 100.
        {"trace.epsilon", 1e-4, 1e3},
        {"reconstruct.sprites.radius", 0, 1e3},
        {"layers.count", 1, 12},
        {"refine.finest", 8, 64},
        {"refine.start", 2, 64},
        {"refine.check", 2, 64},
        {"layers.lists.memory", 1, 64},
        {"reconstruct.map_size", 16, 256},
        {"reconstruct.map_cascades", 1, 3},
        {"around.points", 1, 4},
        {"specular.bounces", 1, 10},
        {"specular.split.levels", 0, 3},
        {"trace.lines.rows", 0, 16384},
        {"trace.secant.max_steps", 2, 256},
        {"view.samples", 1, 4},
        {".max_steps", 2, 256},
        {".steps", 0, 200},
        {".search_steps", 0, 64},
        {".width", 0, 400},
        {".size", 16, 256},
        {".layers", 1, 8},
        {".max_samples", 1, 6},
        {".diameter", 1, 15},
        {".max_diameter", 1, 31},
        {".min_diameter", 1, 31},
        {".maximum", 1, 40},
        {".reach", 1, 60},
        {".footprints", 0.1, 10},
        {".widths", 0.1, 10},
    };
    return ends;
}

params::Range<double> drawnRange(const params::NamedField& parameter) {
    params::Range<double> range{parameter.field.minimum, parameter.field.maximum};
    for (const CostlyEnd& end : costlyEnds()) {
        if (!parameter.fullName.ends_with(end.name)) continue;
        range.minimum = std::max(range.minimum, end.minimum);
        range.maximum = std::min(range.maximum, end.maximum);
        break;
    }
    return range;
}

std::vector<Mixture> mixturesAtCostlyEnds() {
    std::vector<Mixture> mixtures;
    for (const params::NamedField& parameter : paramsOf(smallMixture("mixed")).all()) {
        const std::string& name = parameter.fullName;
        const std::string type = parameter.field.typeName();
        if (type == "choice" || type == "bool") continue;
        const params::Range<double> drawn = drawnRange(parameter);
        for (const double end : {parameter.field.minimum, parameter.field.maximum}) {
            if (end >= drawn.minimum && end <= drawn.maximum) continue;
            Mixture mixture = smallMixture(name.starts_with("emit.vertices") ? "water" : "mixed");
            const auto dot = name.find('.');
            const auto nodeEnd = name.find('.', dot + 1);
            const std::string stage = name.substr(0, dot);
            if (nodeEnd != std::string::npos)
                mixture.set(stage, name.substr(dot + 1, nodeEnd - dot - 1));
            if (stage == "around") {
                mixture.set("reconstruct.space", "cube");
                mixture.set("gather", "cube");
            }
            if (name.starts_with("reconstruct.map") || name.starts_with("gather.project")) {
                mixture.set("reconstruct.space", "light");
                mixture.set("gather", "project");
            }
            if (name.starts_with("gather.cube")) mixture.set("reconstruct.space", "cube");
            if (stage == "refine") mixture.set("driver", "adaptive");
            if (stage == "refine" || stage == "driver") mixture.set("emit", "deferred");
            const std::string filter =
                registry().traits<ReconstructStage>(paramsOf(mixture).choice("reconstruct")).filter;
            if (!filter.empty()) mixture.set("filter", filter);
            const std::string number =
                type == "float" ? fmt::format("{:.9g}", end) : fmt::format("{:.0f}", end);
            mixture.set(name, type == "WxH" ? number + "x" + number : number);
            mixtures.push_back(std::move(mixture));
        }
    }
    return mixtures;
}

Mixture drawMixture(Random& random) {
    Mixture mixture = smallMixture(random.of(sceneNames()));
    if (random.chance(0.5)) mixture.technique = random.of(registry().techniques()).name;
    for (const Registry::StageEntry& stage : registry().stages()) {
        const std::vector<std::string> nodes = nodesOf(stage.name);
        if (nodes.size() > 1 && random.chance(kNodeChance))
            mixture.set(stage.name, random.of(nodes));
    }
    if (random.chance(kNodeChance)) {
        mixture.set("reconstruct.space",
                    random.of(std::vector<std::string>{"screen", "light", "cube"}));
    }
    fitTogether(random, mixture);
    const params::ParamSet params = paramsOf(mixture);
    for (const params::NamedField& parameter : params.all()) {
        const std::string& name = parameter.fullName;
        if (name == "reconstruct.space" || !isOfMixture(name, params)) continue;
        if (random.chance(kParameterChance)) mixture.set(name, drawValue(random, parameter));
    }
    return mixture;
}

}  // namespace kaustik::mixtures
