// SPDX-License-Identifier: MIT
#include "tests/mixtures/finds.h"

#include <algorithm>
#include <sstream>

namespace kaustik::mixtures {
namespace {

// The same with the technique's answers written out.
Mixture writtenOut(const Mixture& mixture) {
    Mixture result{mixture.scene, Mixture{}.technique, {}};
    const params::ParamSet params =
        registry().makeParams(registry().findTechnique(result.technique));
    for (const auto& [name, value] : registry().findTechnique(mixture.technique).defaults)
        result.set(params.resolve(name, ""), value);
    for (const auto& [name, value] : mixture.settings)
        result.set(name, value);
    return result;
}

std::string kindOf(const std::string& check) {
    return check.substr(0, check.find(' '));
}

bool isOneOf(const std::string& value, const std::string& alternatives) {
    std::istringstream list(alternatives);
    std::string alternative;
    while (std::getline(list, alternative, '|')) {
        if (alternative == value) return true;
    }
    return false;
}

}  // namespace

// Halves first, then quarters, …: as Zeller and Hildebrandt's ddmin (2002) does.
Mixture minimised(Mixture mixture, const std::function<bool(const Mixture&)>& fails) {
    const Mixture out = writtenOut(mixture);
    if (fails(out)) mixture = out;
    for (std::size_t chunk = std::max<std::size_t>(mixture.settings.size() / 2, 1); chunk > 0;) {
        bool hasDropped = false;
        for (std::size_t end = mixture.settings.size(); end > 0;) {
            const std::size_t begin = end > chunk ? end - chunk : 0;
            Mixture tried{mixture.scene, mixture.technique, {}};
            for (std::size_t i = 0; i < mixture.settings.size(); ++i) {
                const auto& setting = mixture.settings[i];
                // Without which a frame has sixteen times as many photons.
                if (i < begin || i >= end || setting.first == "emit.photons")
                    tried.settings.push_back(setting);
            }
            end = begin;
            if (tried.settings.size() == mixture.settings.size() || !fails(tried)) continue;
            mixture = std::move(tried);
            hasDropped = true;
        }
        if (!hasDropped || chunk > 1) chunk /= 2;
    }
    return mixture;
}

Mixture minimised(Bench& bench, const Mixture& mixture, const std::string& check) {
    return minimised(mixture,
                     [&](const Mixture& tried) { return !problemOf(bench, tried, check).empty(); });
}

const KnownFind* knownFindOf(const Mixture& mixture, const std::string& check) {
    const params::ParamSet params = paramsOf(mixture);
    const auto has = [&](const auto& setting) {
        const auto& [name, values] = setting;
        if (name == "scene") return isOneOf(mixture.scene, values);
        if (name == "technique") return isOneOf(mixture.technique, values);
        return isOneOf(params.find(name).text(), values);
    };
    for (const KnownFind& known : knownFinds()) {
        if (kindOf(known.check) == kindOf(check) &&
            std::all_of(known.where.begin(), known.where.end(), has))
            return &known;
    }
    return nullptr;
}

}  // namespace kaustik::mixtures
