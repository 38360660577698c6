// SPDX-License-Identifier: MIT
#include "tests/mixtures/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/core/error.h"
#include "tests/mixtures/compare.h"
#include "tests/mixtures/energy.h"
#include "tests/mixtures/refusal.h"

namespace kaustik::mixtures {
namespace {

// Sums in fixed point: what is lost is rounding of floats on their way there.
constexpr double kBalance = 1e-5;
// A float has 2^-24; a pixel is divided by its area and multiplied again.
constexpr double kStored = 1e-5;
// Filters that take a size or a level by texel do not keep the sum; beyond this it must be said.
constexpr double kBlended = 0.1;
// The order of objects decides about which of equal depths counts, and else about nothing.
constexpr double kOrder = 1e-6;
// Factors that are powers of two leave all floats as they are but for their exponents.
constexpr double kExact = 1e-6;
// Others round every length anew: photons next to an edge or a pixel's border fall on the other
// side. Of 4096 photons a few do.
constexpr double kScaledEnergy = 0.02;
constexpr double kScaledBlocks = 0.04;
// Besides, grids of lights and faces around generators may lie otherwise.
constexpr double kTurnedEnergy = 0.03;
constexpr double kTurnedBlocks = 0.35;

// trace.all_hits says that it lights every surface that a ray passes.
bool makesLight(const Mixture& mixture) {
    return paramsOf(mixture).choice(TraceStage::name) == "all_hits";
}

Verdict finite(const Rendered& rendered) {
    if (!rendered.shot.notFinite.empty())
        return {true, fmt::format("{} holds what is no number", rendered.shot.notFinite.front())};
    const std::vector<float>& display = rendered.shot.display.values;
    const bool isFinite = std::all_of(display.begin(), display.end(),
                                      [](float value) { return std::isfinite(value); });
    return {true, isFinite ? "" : "the picture holds what is no number"};
}

Verdict sign(const Rendered& rendered) {
    const auto isNegative = [](const Image& image) {
        return std::any_of(image.values.begin(), image.values.end(),
                           [](float value) { return value < 0.0f; });
    };
    for (const run::Output& output : rendered.shot.outputs.images) {
        if (isNegative(output.image)) return {true, fmt::format("{} is negative", output.name)};
    }
    if (isNegative(rendered.shot.picture)) return {true, "the picture is negative"};
    return {};
}

Verdict balance(const Rendered& rendered) {
    if (makesLight(rendered.mixture)) return {false};
    const double value = rendered.shot.ledger.balance();
    if (std::abs(value) <= kBalance) return {};
    return {true, fmt::format("the balance is {:.3g}", value)};
}

Verdict stored(const Rendered& rendered) {
    const Shot& shot = rendered.shot;
    const double deposited = shot.ledger.watts[transport::kAccountDeposited];
    if (deposited <= 0.0) return {false};
    const params::ParamSet params = paramsOf(rendered.mixture);
    // A pixel that shows several surfaces has their mean irradiance, and not all of their flux.
    if (params.choice(ReconstructStage::name) == "triangles" &&
        params.choice("reconstruct.triangles.coverage") == "samples")
        return {false};
    const std::string filter = params.choice(FilterStage::name);
    if (shot.filteredWatts) {
        const double ratio = *shot.filteredWatts / deposited;
        const bool keepsSum = filter == "none" || filter == "level_sum";
        const bool isSaid = std::any_of(
            shot.warnings.begin(), shot.warnings.end(), [&](const std::string& warning) {
                return warning.find("filter=" + filter) != std::string::npos ||
                       warning.find("filter." + filter) != std::string::npos;
            });
        if (std::abs(ratio - 1.0) > (keepsSum ? kStored : kBlended) && !isSaid) {
            return {true, fmt::format("filter={} leaves {:.4g} of the flux that was deposited",
                                      filter, ratio)};
        }
    }
    if (!shot.isStoredOnScreen || filter != "none" ||
        params.choice(GatherStage::name) != "screen" ||
        params.choice(TemporalStage::name) != "none") {
        return {shot.filteredWatts.has_value()};
    }
    // Across edges light lies where nothing shows it, too, which the run has said.
    const bool isCrossed =
        std::any_of(shot.warnings.begin(), shot.warnings.end(), [](const std::string& warning) {
            return warning.find("edges=crossed") != std::string::npos;
        });
    if (isCrossed) return {false};
    const double ratio = shot.shownWatts / deposited;
    if (std::abs(ratio - 1.0) <= kStored) return {};
    return {true, fmt::format("the picture shows {:.6g} of the flux that was deposited", ratio)};
}

// What must change no bit. A node has its twins: "refine=compute|feedback".
struct Neutral {
    std::string name;
    std::vector<std::string> values;
    bool isChoice = false;  // of nodes, which the mixture must have one of
};
const std::vector<Neutral>& neutralSettings() {
    static const std::vector<Neutral> settings = {
        {"emit.batch", {"256", "512", "1500"}},
        {"refine.memory", {"1", "3", "512"}},
        {"layers.lists.memory", {"1", "2", "32"}},
        {"layers.lists.fragments_per_pixel", {"1", "16"}},
        {"trace.lines.memory", {"1", "64"}},
        {"trace.lines.rows", {"300", "1000"}},
        {"trace.lines.source", {"vertex", "geometry"}},
        {"layers.peel.counting", {"atomics", "reduce"}},
        {"trace", {"hierarchical", "hierarchical_compute"}, true},
        {"trace", {"march", "march_compute"}, true},
        {"refine", {"compute", "feedback"}, true},
        {"layers", {"lists", "peel"}, true}};
    return settings;
}

Check bitsOf(const std::string& setting) {
    return {"bits " + setting, [setting](Bench& bench, const Rendered& rendered) -> Verdict {
                Variation variation;
                const auto equals = setting.find('=');
                if (setting == "threads=1") {
                    variation.threads = 1;
                } else if (equals != std::string::npos) {
                    variation.settings = {{setting.substr(0, equals), setting.substr(equals + 1)}};
                }
                return {true,
                        differenceInBits(rendered.shot, bench.render(rendered.mixture, variation))};
            }};
}

Check orderOf(std::uint64_t seed) {
    return {fmt::format("order {}", seed),
            [seed](Bench& bench, const Rendered& rendered) -> Verdict {
                Variation variation;
                variation.order = seed;
                return {true,
                        differenceInValues(rendered.shot, bench.render(rendered.mixture, variation),
                                           1.0, 1.0, kOrder)};
            }};
}

Check lightOf(double factor) {
    return {fmt::format("light {}", factor),
            [factor](Bench& bench, const Rendered& rendered) -> Verdict {
                Variation variation;
                variation.light = factor;
                return {true,
                        differenceInValues(rendered.shot, bench.render(rendered.mixture, variation),
                                           1.0 / factor, 1.0 / factor, kExact)};
            }};
}

Check scaleOf(double factor) {
    return {
        fmt::format("scale {}", factor),
        [factor](Bench& bench, const Rendered& rendered) -> Verdict {
            Variation variation;
            variation.scale = factor;
            const bool isExact = std::exp2(std::round(std::log2(factor))) == factor;
            if (!isExact && isCoarse(rendered.mixture, rendered.shot)) return {false};
            const Shot scaled = bench.render(rendered.mixture, variation);
            if (isExact) {
                return {true, differenceInValues(rendered.shot, scaled, 1.0,
                                                 1.0 / (factor * factor), kExact)};
            }
            return {true, differenceInBlocks(rendered.shot, scaled, kScaledEnergy, kScaledBlocks)};
        }};
}

// What is lost to a tracer's steps or to paths that end early depends on where grids and views lie.
bool losesMuch(const Mixture& mixture, const Shot& shot) {
    using namespace transport;
    const auto& watts = shot.ledger.watts;
    double lost = watts[kAccountMissedByTracer] + watts[kAccountEdgeOn] +
                  watts[kAccountBounceLimit] + watts[kAccountInternalReflectionLimit] +
                  watts[kAccountDiscardedTriangle] + watts[kAccountBeyondLastLayer];
    // Else it has left the scene.
    const bool mayBeMissed =
        paramsOf(mixture).find("trace.test").text() != "crossing" ||
        std::any_of(shot.limits.begin(), shot.limits.end(), [](const ReachedLimit& limit) {
            return limit.parameter.starts_with("trace.");
        });
    if (mayBeMissed) lost += watts[kAccountUnresolved];
    return lost > kTurnedEnergy * watts[kAccountDeposited];
}
// What another direction of view finds is other light where layers end too early.
bool lacksLayers(const Shot& shot) {
    return std::any_of(shot.limits.begin(), shot.limits.end(),
                       [](const ReachedLimit& limit) { return limit.parameter == "layers.count"; });
}
// Which of its sizes such a filter takes is decided texel by texel.
bool blendsSizes(const Mixture& mixture) {
    const std::string filter = paramsOf(mixture).choice(FilterStage::name);
    return filter == "blend" || filter == "levels";
}

Check turnOf(double degrees) {
    return {fmt::format("turn {}", degrees),
            [degrees](Bench& bench, const Rendered& rendered) -> Verdict {
                if (isCoarse(rendered.mixture, rendered.shot) || makesLight(rendered.mixture) ||
                    lacksLayers(rendered.shot) || losesMuch(rendered.mixture, rendered.shot) ||
                    blendsSizes(rendered.mixture))
                    return {false};
                Variation variation;
                variation.turnDegrees = degrees;
                return {true,
                        differenceInBlocks(rendered.shot, bench.render(rendered.mixture, variation),
                                           kTurnedEnergy, kTurnedBlocks)};
            }};
}

Check energyCheck() {
    return {"energy", [](Bench& bench, const Rendered& rendered) -> Verdict {
                if (makesLight(rendered.mixture)) return {false};
                return energyVerdict(bench, rendered);
            }};
}

}  // namespace

std::vector<Check> checksOfAFrame() {
    const auto ofFrame = [](const char* name, Verdict (*check)(const Rendered&)) {
        return Check{name, [check](Bench&, const Rendered& rendered) { return check(rendered); }};
    };
    return {ofFrame("finite", &finite), ofFrame("sign", &sign), ofFrame("balance", &balance),
            ofFrame("stored", &stored), energyCheck()};
}

std::vector<Check> drawnChecks(Random& random, const Rendered& rendered) {
    const params::ParamSet params = paramsOf(rendered.mixture);
    std::vector<Check> bits = {bitsOf("nothing")};
    // A node that has settings of its own has no twin.
    const auto isBare = [&](const std::string& stage) {
        const std::string own = stage + "." + params.choice(stage) + ".";
        return std::none_of(rendered.mixture.settings.begin(), rendered.mixture.settings.end(),
                            [&](const auto& setting) { return setting.first.starts_with(own); });
    };
    for (const Neutral& neutral : neutralSettings()) {
        const std::string value = random.of(neutral.values);
        if (neutral.isChoice && !isBare(neutral.name)) continue;
        const bool hasEffect = neutral.isChoice
                                   ? std::find(neutral.values.begin(), neutral.values.end(),
                                               params.choice(neutral.name)) != neutral.values.end()
                                   : rendered.shot.idle.count(neutral.name) == 0;
        if (hasEffect && params.find(neutral.name).text() != value)
            bits.push_back(bitsOf(neutral.name + "=" + value));
    }
    const std::string tracer = params.choice(TraceStage::name);
    if (tracer == "raytraced" || tracer == "auto") bits.push_back(bitsOf("threads=1"));
    std::vector<Check> checks = {orderOf(1 + random.below(100)),
                                 lightOf(random.of(std::vector<double>{2.0, 2.0, 0x1p-12, 0x1p12})),
                                 scaleOf(random.of(std::vector<double>{0.1, 100.0, 0x1p-4, 0x1p7})),
                                 turnOf(random.of(std::vector<double>{33.0, 90.0, 200.0}))};
    checks.push_back(random.of(bits));
    // Most are about memory, of which there are many kinds.
    checks.push_back(random.of(bits));
    return checks;
}

std::vector<std::string> neutralNames() {
    std::vector<std::string> names;
    for (const Neutral& neutral : neutralSettings())
        names.push_back(neutral.name);
    return names;
}

Check checkOf(const std::string& name) {
    const auto space = name.find(' ');
    const std::string kind = name.substr(0, space);
    const std::string detail = space == std::string::npos ? "" : name.substr(space + 1);
    if (kind == "bits") return bitsOf(detail);
    if (kind == "order") return orderOf(std::stoull(detail));
    if (kind == "light") return lightOf(std::stod(detail));
    if (kind == "scale") return scaleOf(std::stod(detail));
    if (kind == "turn") return turnOf(std::stod(detail));
    for (const Check& check : checksOfAFrame()) {
        if (check.name == name) return check;
    }
    throw ConfigError(fmt::format("There is no check '{}'.", name));
}

std::optional<Rendered> renderForChecks(Bench& bench, const Mixture& mixture, Refusal& refusal) {
    Variation variation;
    variation.keepsAll = true;
    try {
        return Rendered{mixture, bench.render(mixture, variation)};
    } catch (const std::exception& error) {
        refusal = refusalOf(error);
        return {};
    }
}

std::string problemOf(Bench& bench, const Mixture& mixture, const std::string& check) {
    Refusal refusal;
    const std::optional<Rendered> rendered = renderForChecks(bench, mixture, refusal);
    if (!rendered) {
        if (check == "throws")
            return refusal.isOfRequest || refusal.isOfMemory ? "" : refusal.message;
        return check == "refusal" ? faultOf(bench, mixture, refusal) : "";
    }
    if (check == "throws" || check == "refusal") return "";
    try {
        return checkOf(check).run(bench, *rendered).problem;
    } catch (const std::exception& error) {
        const Refusal other = refusalOf(error);
        return other.isOfMemory ? "" : error.what();
    }
}

}  // namespace kaustik::mixtures
