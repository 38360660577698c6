// SPDX-License-Identifier: MIT
#include "tests/gpu/strict/mixtures.h"

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include "framework/core/error.h"
#include "framework/scene/spectrum.h"
#include "techniques/light_cells/refine_stage.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

// Lights of two kinds, water with waves, a body of glass and a receiver. What else asks for
// programs of its own comes with the scene's name.
std::string sceneText(const std::string& name) {
    std::string text = R"(
background_radiance = 30
[camera]
position = [1.8, 2.2, 3.2]
target = [0, 0.2, 0]
[[light]]
name = "sun"
type = "directional"
direction = [0.3, -1, -0.2]
irradiance = 800
[[light]]
name = "spot"
type = "spot"
position = [-1.5, 4.5, 1]
direction = [1.3, -4.3, -1]
inner_cone_degrees = 22
outer_cone_degrees = 30
intensity = 1200
[[material]]
name = "grey"
type = "lambertian"
albedo = 0.5
[[material]]
name = "polished"
type = "glossy"
albedo = 0.4
specular = 0.3
exponent = 40
[[material]]
name = "water"
type = "dielectric"
ior = 1.333
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[object]]
name = "floor"
shape = "plane"
material = "grey"
size = [5, 5]
[[object]]
name = "pond"
shape = "water"
material = "water"
size = [0.9, 0.9]
cells = [8, 8]
position = [-0.8, 0.3, 0.2]
waves = [{amplitude = 0.01, wavelength = 0.9}]
[[object]]
name = "ball"
shape = "sphere"
material = "glass"
radius = 0.4
segments = 12
position = [0.5, 0.8, 0.1]
)";
    if (name == "glossy") {
        text += R"(
[[object]]
name = "plate"
shape = "plane"
material = "polished"
size = [1.4, 1.4]
position = [0.5, 0.02, 0.3]
[environment]
pattern = "sky"
)";
    } else if (name == "foggy") {
        text += "[medium]\nscattering_per_meter = 0.1\nabsorption_per_meter = 0.1\n";
    }
    if (name == "dispersive") {
        const std::string index = "ior = 1.5";
        text.replace(text.find(index), index.size(), "glass = \"N-BK7\"");
    }
    return "name = \"" + name + "\"\n" + text;
}

const Registry& registry() {
    static const Registry instance = registerAll();
    return instance;
}

const char* const kSceneChoice = "scene";

using Choice = std::pair<std::string, std::string>;  // of a stage, a parameter or the scene
using Pair = std::pair<Choice, Choice>;

Pair pairOf(Choice a, Choice b) {
    if (b < a) std::swap(a, b);
    return {std::move(a), std::move(b)};
}

const Settings& smallSizes() {
    static const Settings settings = {
        {"emit.photons", "16x16"},      {"refine.finest", "32"},
        {"refine.start", "8"},          {"refine.check", "16"},
        {"emit.deferred.size", "32"},   {"specular.deferred.size", "32"},
        {"reconstruct.map_size", "32"}, {"around.cubes.size", "16"},
        {"shadow.map.size", "32"},      {"refine.memory", "1"}};
    return settings;
}

// Values of a parameter besides its default that may take other programs: all of a choice, both of
// a switch, of a number the least and one that is greater.
std::vector<std::string> otherValues(const params::NamedField& named) {
    const params::Field& field = named.field;
    const auto isSize = [&](const auto& setting) { return setting.first == named.fullName; };
    if (std::any_of(smallSizes().begin(), smallSizes().end(), isSize)) return {};
    std::vector<std::string> values = field.choices;
    const std::string type = field.typeName();
    if (type == "bool") values = {"true", "false"};
    // Beyond this a number is a size.
    constexpr double kMaxCount = 64.0;
    if ((type == "int" || type == "float") && std::stod(named.defaultText) <= kMaxCount) {
        const double more = std::min(std::stod(named.defaultText) + 1.0, field.maximum);
        for (const double value : {field.minimum, more}) {
            values.push_back(type == "int" ? std::to_string(static_cast<int>(value))
                                           : std::to_string(value));
        }
    }
    std::erase(values, named.defaultText);
    return values;
}

class Mixtures {
  public:
    Mixtures() {
        for (const char* name : {"plain", "glossy", "foggy", "dispersive"})
            scenes_.emplace(name, sceneFromText(sceneText(name)));
        scene::placeBands(scenes_.at("dispersive"), 2, 60, 0.0);
        for (const auto& [name, scene] : scenes_)
            nodes_[kSceneChoice].push_back(name);
        for (const Registry::Node& node : registry().nodes())
            nodes_[node.stage].push_back(node.name);
        const params::ParamSet params =
            registry().makeParams(registry().findTechnique("screen_space_photons"));
        for (const params::NamedField& named : params.all()) {
            if (nodes_.contains(named.fullName)) continue;
            if (std::vector<std::string> values = otherValues(named); !values.empty())
                parameters_.emplace(named.fullName, std::move(values));
        }
        for (const auto& [stage, names] : nodes_) {
            for (const auto& [other, others] : nodes_) {
                if (!(stage < other)) continue;
                for (const std::string& name : names) {
                    for (const std::string& otherName : others)
                        wanted_.push_back(pairOf({stage, name}, {other, otherName}));
                }
            }
        }
        // Each value with its node, or with any where all nodes of a stage share it.
        for (const auto& [name, values] : parameters_) {
            for (const std::string& value : values) {
                const Choice node = nodeOf(name);
                wanted_.push_back(
                    pairOf(node.first.empty() ? Choice{name, value} : node, {name, value}));
            }
        }
    }

    MixtureCount run() {
        std::shuffle(wanted_.begin(), wanted_.end(), random_);
        for (const Pair& pair : wanted_) {
            constexpr int kMaxTries = 12;
            for (int i = 0; i < kMaxTries && !met_.contains(pair); ++i)
                render(mixtureWith(pair, i));
            count_.apart += met_.contains(pair) ? 0 : 1;
        }
        count_.pairs = wanted_.size() - count_.apart;
        return count_;
    }

  private:
    struct Mixture {
        const Technique* technique;
        std::map<std::string, std::string> choices;
    };

    // stage.node of "stage.node.parameter"; nothing of a stage's own.
    [[nodiscard]] Choice nodeOf(const std::string& parameter) const {
        const std::size_t first = parameter.find('.');
        const std::size_t second = parameter.find('.', first + 1);
        if (second == std::string::npos) return {};
        const std::string node = parameter.substr(first + 1, second - first - 1);
        const auto stage = nodes_.find(parameter.substr(0, first));
        const bool isNode = stage != nodes_.end() &&
                            std::count(stage->second.begin(), stage->second.end(), node) > 0;
        return isNode ? Choice{stage->first, node} : Choice{};
    }

    template <class List>
    const auto& oneOf(const List& list) {
        return list[std::uniform_int_distribution<std::size_t>(0, list.size() - 1)(random_)];
    }

    // A technique's own answers but for the pair; every other time what stores light, and where, is
    // chosen to go together, and every parameter is anything.
    Mixture mixtureWith(const Pair& pair, int attempt) {
        Mixture mixture{&oneOf(registry().techniques()), {}};
        std::map<std::string, std::string>& choices = mixture.choices;
        choices[kSceneChoice] = oneOf(nodes_.at(kSceneChoice));
        if (attempt % 2 == 1) {
            const std::string space = oneOf(std::vector<std::string>{"screen", "light", "cube"});
            const std::string reconstruct = oneOf(nodes_.at(ReconstructStage::name));
            choices["reconstruct.space"] = space;
            choices[ReconstructStage::name] = reconstruct;
            choices[GatherStage::name] = space == "light"  ? "project"
                                         : space == "cube" ? "cube"
                                                           : "screen";
            const std::string filter = registry().traits<ReconstructStage>(reconstruct).filter;
            if (!filter.empty()) choices[FilterStage::name] = filter;
        }
        if (attempt < 6) {
            for (const auto& [name, values] : parameters_) {
                if (random_() % 2 == 0 && !choices.contains(name)) choices[name] = oneOf(values);
            }
        }
        for (const auto& [name, value] : {pair.first, pair.second}) {
            choices[name] = value;
            if (name == RefineStage::name || name.starts_with("refine.")) {
                choices[DriverStage::name] = "adaptive";
                choices[EmitStage::name] = "deferred";
            }
            if (name == DriverStage::name && value == "adaptive")
                choices[EmitStage::name] = "deferred";
        }
        choices[pair.first.first] = pair.first.second;
        choices[pair.second.first] = pair.second.second;
        return mixture;
    }

    void render(const Mixture& mixture) {
        try {
            RenderSettings settings;
            settings.technique = *mixture.technique;
            settings.params = registry().makeParams(*mixture.technique);
            for (const auto& [name, value] : smallSizes())
                settings.params.set(name, value, "mixture");
            for (const auto& [name, value] : mixture.choices) {
                if (name != kSceneChoice) settings.params.set(name, value, "mixture");
            }
            settings.width = 16;
            settings.height = 12;
            const std::string& scene = mixture.choices.at(kSceneChoice);
            std::unique_ptr<Renderer>& renderer = renderers_[scene];
            if (renderer) {
                renderer->update(settings);
            } else {
                renderer =
                    std::make_unique<Renderer>(context(), registry(), scenes_.at(scene), settings);
            }
            const std::vector<Purpose> purposes = {Purpose::picture, Purpose::measurement,
                                                   Purpose::audit, Purpose::view};
            renderer->build(purposes[random_() % 8 == 0 ? random_() % purposes.size() : 1]);
            gl::PassTimer timer(gl::TimerMode::finish);
            for (int frame = 0; frame < 2; ++frame)
                renderer->renderFrame(timer);
            ++count_.frames;
            note(mixture, settings.params);
        } catch (const ConfigError&) {
            ++count_.refused;
        }
    }

    void note(const Mixture& mixture, const params::ParamSet& params) {
        std::vector<Choice> chosen = {{kSceneChoice, mixture.choices.at(kSceneChoice)}};
        for (const auto& [stage, names] : nodes_) {
            if (stage != kSceneChoice) chosen.emplace_back(stage, params.choice(stage));
        }
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            for (std::size_t j = i + 1; j < chosen.size(); ++j)
                met_.insert(pairOf(chosen[i], chosen[j]));
        }
        for (const auto& [name, value] : mixture.choices) {
            const Choice node = nodeOf(name);
            const bool isChosen = std::count(chosen.begin(), chosen.end(), node) > 0;
            if (node.first.empty() || isChosen)
                met_.insert(pairOf(isChosen ? node : Choice{name, value}, {name, value}));
        }
    }

    std::map<std::string, scene::Scene> scenes_;
    std::map<std::string, std::unique_ptr<Renderer>> renderers_;
    std::map<std::string, std::vector<std::string>> nodes_;       // by stage
    std::map<std::string, std::vector<std::string>> parameters_;  // other values, by name
    std::vector<Pair> wanted_;
    std::set<Pair> met_;
    MixtureCount count_;
    std::mt19937 random_{1};
};

}  // namespace

MixtureCount renderMixtures() {
    return Mixtures().run();
}

}  // namespace kaustik::test
