// SPDX-License-Identifier: MIT
#include "tests/mixtures/mixture.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "framework/core/error.h"
#include "framework/core/names.h"
#include "techniques/register_all.h"

namespace kaustik::mixtures {

const Registry& registry() {
    static const Registry instance = registerAll();
    return instance;
}

const std::vector<std::string>& sceneNames() {
    static const std::vector<std::string> names = {"ball",   "water",  "mirror", "lights",
                                                   "glossy", "medium", "nested", "mixed"};
    return names;
}

std::vector<std::string> nodesOf(const std::string& stage) {
    std::vector<std::string> names;
    for (const Registry::Node& node : registry().nodes()) {
        if (node.stage == stage) names.push_back(node.name);
    }
    return names;
}

void Mixture::erase(const std::string& name) {
    std::erase_if(settings, [&](const auto& setting) { return setting.first == name; });
}

void Mixture::set(const std::string& name, const std::string& value) {
    erase(name);
    settings.emplace_back(name, value);
}

std::string lineOf(const Mixture& mixture) {
    std::string line = fmt::format("kaustik run tests/mixtures/scenes/{}.toml --size {}x{}",
                                   mixture.scene, kWidth, kHeight);
    if (mixture.technique != Mixture{}.technique) line += " --technique " + mixture.technique;
    for (const auto& [name, value] : mixture.settings)
        line += fmt::format(" --set {}={}", name, value);
    return line;
}

Mixture mixtureOf(const std::string& line) {
    std::istringstream words(line);
    Mixture mixture;
    std::string word;
    const auto next = [&] {
        std::string value;
        if (!(words >> value)) throw ConfigError(fmt::format("'{}' needs a value.", word));
        return value;
    };
    while (words >> word) {
        if (word == "kaustik" || word == "run") continue;
        if (word == "--size") {
            static_cast<void>(next());
        } else if (word == "--technique") {
            mixture.technique = next();
        } else if (word == "--set") {
            const std::string setting = next();
            const auto equals = setting.find('=');
            if (equals == std::string::npos)
                throw ConfigError(fmt::format("'{}' is no NAME=VALUE.", setting));
            const std::string name = registry()
                                         .makeParams(registry().findTechnique(mixture.technique))
                                         .resolve(setting.substr(0, equals), "--set");
            mixture.set(name, setting.substr(equals + 1));
        } else {
            mixture.scene = std::filesystem::path(word).stem().string();
        }
    }
    return mixture;
}

params::ParamSet paramsOf(const Mixture& mixture) {
    params::ParamSet params = registry().makeParams(registry().findTechnique(mixture.technique));
    for (const auto& [name, value] : mixture.settings)
        params.set(name, value, "--set");
    return params;
}

Mixture smallMixture(const std::string& scene) {
    return {scene,
            Mixture{}.technique,
            {{"emit.photons", "64x64"},
             {"refine.finest", "64"},
             {"refine.start", "16"},
             {"refine.check", "32"},
             {"emit.deferred.size", "128"},
             {"emit.vertices.size", "128"},
             {"specular.deferred.size", "128"},
             {"specular.two_interfaces.size", "128"},
             {"reconstruct.map_size", "128"},
             {"around.cubes.size", "64"},
             {"shadow.map.size", "128"}}};
}

// splitmix64 (Steele, Lea, Flood 2014).
Random::Random(std::uint64_t seed, std::uint64_t stream)
    : state_(seed * 0x9e3779b97f4a7c15u ^ (stream + 1) * 0xd1342543de82ef95u) {}

std::uint64_t Random::next() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

double Random::uniform() {
    return static_cast<double>(next() >> 11) * 0x1.0p-53;
}

}  // namespace kaustik::mixtures
