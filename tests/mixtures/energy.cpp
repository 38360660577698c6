// SPDX-License-Identifier: MIT
#include "tests/mixtures/energy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "framework/core/error.h"
#include "framework/measure/pointwise.h"

namespace kaustik::mixtures {
namespace {

constexpr double kEnergy = 0.03;
// Directions are blended over what one photon of few covers, lobes with them: light maps have 96.9
// % of a table's gloss with 64² photons, 97.6 % with 256².
constexpr double kRadiance = 0.05;
// Of what a filter makes of sizes or levels, texel by texel: beyond it a run says so.
constexpr double kBlended = 0.1;
// Of the reference, and how certain the verdict is to be: one of 700 is wrong for its noise.
constexpr double kStandardErrors = 3.0;
// Outputs of which the picture shows hardly anything are not judged: a few photons are all of them.
constexpr double kLeastShare = 0.02;
// How often what a report names is taken, and the report of that is read.
constexpr int kRounds = 3;
// Of what one report names, as many are taken together, or all.
constexpr int kTogether = 3;

struct Energy {
    bool isJudged = false;
    std::string problem;
};

Energy energyOf(Bench& bench, const Mixture& mixture, const Shot& shot) {
    if (shot.paths.interactions == 0 || !shot.outputs.seesReceivers) return {};
    if (isCoarse(mixture, shot)) return {};
    const reference::Reference& reference = bench.referenceOf(mixture.scene, shot.paths);
    if (reference.energy.visibleWatts <
        kLeastShare * reference.energy.watts[transport::kAccountEmitted])
        return {};
    const std::string filter = paramsOf(mixture).choice(FilterStage::name);
    const double tolerance = filter == "blend" || filter == "levels" ? kBlended : kEnergy;
    Energy energy;
    for (const run::Output& output : shot.outputs.images) {
        if ((reference.*output.groundTruth).values.empty()) continue;
        const measure::ImagePair pair = run::pairOf(shot.outputs, output, reference);
        if (totalFlux(pair, pair.reference()) <= 0.0) continue;
        energy.isJudged = true;
        const double ratio = energyRatio(pair);
        const double noise =
            referenceNoise(pair, 0.0, std::vector<unsigned char>(pair.pixelCount(), 1)).energyRatio;
        const bool isRadiance = output.name == std::string("caustic_radiance");
        const double allowed = isRadiance ? std::max(tolerance, kRadiance) : tolerance;
        if (std::abs(ratio - 1.0) <= allowed + kStandardErrors * noise) continue;
        energy.problem = fmt::format(
            "{} has {:.1f} ± {:.1f} % of the energy of the paths that it "
            "models",
            output.name, 100.0 * ratio, 100.0 * noise);
        return energy;
    }
    return energy;
}

// What the report says that would help: of each warning and limit the settings that it names.
std::vector<Settings> remediesOf(const Rendered& rendered) {
    const params::ParamSet params = paramsOf(rendered.mixture);
    std::vector<Settings> remedies;
    const auto add = [&](Settings settings) {
        std::erase_if(settings, [&](const auto& setting) {
            return params.find(setting.first).text() == setting.second;
        });
        if (!settings.empty() &&
            std::find(remedies.begin(), remedies.end(), settings) == remedies.end())
            remedies.push_back(std::move(settings));
    };
    for (const std::string& warning : rendered.shot.warnings) {
        // What would make use of a setting is no advice about the light.
        if (warning.find("has no effect") == std::string::npos) add(advised(warning));
    }
    for (const ReachedLimit& limit : rendered.shot.limits) {
        const double wanted = limit.needed > limit.value ? limit.needed : 4.0 * limit.value;
        const double value = std::min(std::ceil(wanted), params.find(limit.parameter).maximum);
        add({{limit.parameter, fmt::format("{:.0f}", value)}});
        add(advised(limit.sentence));
    }
    return remedies;
}

bool isRightWith(Bench& bench, Mixture mixture, const Settings& settings) {
    try {
        for (const auto& [name, value] : settings)
            mixture.set(name, value);
        const Shot shot = bench.render(mixture);
        return energyOf(bench, mixture, shot).problem.empty();
    } catch (const Error&) {
        return false;
    }
}

// Whether one, two or three of the choices with those that are `taken` bring it there.
bool someAreRight(Bench& bench, const Mixture& mixture, const std::vector<Settings>& choices,
                  std::size_t first, const Settings& taken, int most) {
    for (std::size_t i = first; i < choices.size(); ++i) {
        Settings settings = taken;
        settings.insert(settings.end(), choices[i].begin(), choices[i].end());
        if (isRightWith(bench, mixture, settings)) return true;
    }
    if (most == 1) return false;
    for (std::size_t i = first; i < choices.size(); ++i) {
        Settings settings = taken;
        settings.insert(settings.end(), choices[i].begin(), choices[i].end());
        if (someAreRight(bench, mixture, choices, i + 1, settings, most - 1)) return true;
    }
    return false;
}

}  // namespace

bool isCoarse(const Mixture& mixture, const Shot& shot) {
    constexpr std::uint64_t kFewPhotons = 1000;
    if (shot.ledger.events[transport::kAccountEmitted] < kFewPhotons) return true;
    const params::ParamSet params = paramsOf(mixture);
    // Splats that are asked to be as wide as the scene, or much wider than their light.
    const auto isWide = [&](const char* name, double widest) {
        return shot.idle.count(name) == 0 && std::stod(params.find(name).text()) > widest;
    };
    if (isWide("reconstruct.sprites.radius", 0.1) || isWide("reconstruct.lens.widths", 4.0) ||
        isWide("reconstruct.sprites.footprints", 8.0) ||
        isWide("reconstruct.fixed.diameter", 8.0) ||
        isWide("reconstruct.multi_level.diameter", 8.0) ||
        isWide("reconstruct.lens.min_diameter", 8.0) || isWide("reconstruct.triangles.merge", 8.0))
        return true;
    // MiB in which its maps' texels are as many as a small mixture's.
    constexpr double kMinMapMemory = 8.0;
    if (shot.idle.count("reconstruct.map_memory") == 0 &&
        std::stod(params.find("reconstruct.map_memory").text()) < kMinMapMemory)
        return true;
    const Settings& small = smallMixture(mixture.scene).settings;
    return std::any_of(small.begin(), small.end(), [&](const auto& setting) {
        const auto& [name, least] = setting;
        if (shot.idle.count(name) > 0 || name == "refine.start" || name == "refine.check")
            return false;
        std::istringstream own(params.find(name).text());
        std::istringstream wanted(least);
        int side = 0;
        int leastSide = 0;
        char between = ' ';
        while (own >> side && wanted >> leastSide) {
            if (side < leastSide) return true;
            own >> between;
            wanted >> between;
        }
        return false;
    });
}

Verdict energyVerdict(Bench& bench, const Rendered& rendered) {
    const Energy energy = energyOf(bench, rendered.mixture, rendered.shot);
    if (energy.problem.empty()) return {energy.isJudged};
    std::string tried;
    Rendered advanced = rendered;
    for (int round = 0; round < kRounds; ++round) {
        const std::vector<Settings> remedies = remediesOf(advanced);
        if (remedies.empty()) break;
        Mixture all = advanced.mixture;
        std::vector<Settings> choices;
        for (const Settings& settings : remedies) {
            for (const auto& [name, value] : settings) {
                all.set(name, value);
                tried += fmt::format(
                    "{}{}={}", tried.empty() ? "; what the report names does not help: " : ", ",
                    name, value);
            }
            // Either of what a sentence names, or all of it.
            choices.push_back(settings);
            for (const auto& setting : settings) {
                if (settings.size() > 1) choices.push_back({setting});
            }
        }
        if (someAreRight(bench, advanced.mixture, choices, 0, {}, kTogether)) return {};
        if (remedies.size() > kTogether && isRightWith(bench, all, {})) return {};
        // Of several causes the next is seen when the first is gone.
        Refusal refusal;
        const std::optional<Rendered> next = renderForChecks(bench, all, refusal);
        if (!next) break;
        advanced = *next;
    }
    return {true, energy.problem + (tried.empty() ? "; the report names no setting" : tried)};
}

}  // namespace kaustik::mixtures
