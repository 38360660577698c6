// SPDX-License-Identifier: MIT
#include "framework/experiment/resolve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/names.h"
#include "framework/experiment/fingerprint.h"
#include "framework/scene/files/scene_file.h"

namespace kaustik::experiment {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::vector<std::string>& runKeys() {
    static const std::vector<std::string> keys = {"scene",
                                                  "technique",
                                                  "size",
                                                  "frames",
                                                  "warmup",
                                                  "seed",
                                                  "precise",
                                                  "time",
                                                  "time_step",
                                                  "reference",
                                                  "reference_photons",
                                                  "disable"};
    return keys;
}

[[noreturn]] void fail(const Setting& setting, const std::string& message) {
    throw ConfigError(fmt::format("{}: {}", setting.place, message));
}

std::string textOf(const Setting& setting) {
    if (setting.value.is_array()) {
        fail(setting, fmt::format("{} takes one value, not a list.", setting.key));
    }
    return setting.value.is_string() ? setting.value.get<std::string>() : setting.value.dump();
}

std::string requireText(const Setting& setting) {
    if (!setting.value.is_string()) {
        fail(setting, fmt::format("{} must be text, not {}.", setting.key, setting.value.dump()));
    }
    return setting.value.get<std::string>();
}

long long requireWhole(const Setting& setting, long long minimum, long long maximum) {
    const bool isWhole = setting.value.is_number_integer();
    const long long value = isWhole ? setting.value.get<long long>() : 0;
    if (!isWhole || value < minimum || value > maximum) {
        fail(setting, fmt::format("{} must be a whole number from {} to {}, not {}.", setting.key,
                                  minimum, maximum, setting.value.dump()));
    }
    return value;
}

double requireSeconds(const Setting& setting) {
    const bool isNumber = setting.value.is_number();
    if (!isNumber || !std::isfinite(setting.value.get<double>())) {
        fail(setting, fmt::format("{} must be a number of seconds, not {}.", setting.key,
                                  setting.value.dump()));
    }
    return setting.value.get<double>();
}

std::vector<std::string> requireTexts(const Setting& setting) {
    if (setting.value.is_string()) return {setting.value.get<std::string>()};
    if (!setting.value.is_array()) {
        fail(setting,
             fmt::format("{} must be a list of texts, not {}.", setting.key, setting.value.dump()));
    }
    auto texts = setting.value.get<std::vector<std::string>>();
    std::sort(texts.begin(), texts.end());
    texts.erase(std::unique(texts.begin(), texts.end()), texts.end());
    return texts;
}

std::string requireSize(const Setting& setting) {
    params::Extent size;
    const params::Field field{"size", "", "px", &size, 1.0, 16384.0, {}};
    field.set(textOf(setting), "size", setting.place);
    return field.text();
}

// The full name of a parameter; a key that is none is compared with the keys of a run as well.
std::string parameterName(const params::ParamSet& params, const Setting& setting) {
    try {
        return params.resolve(setting.key, setting.place);
    } catch (const ConfigError&) {
        std::vector<std::string> names = runKeys();
        for (const params::NamedField& named : params.all())
            names.push_back(named.fullName);
        const std::string nearest = nearestName(setting.key, names);
        if (!Resolver::isRunKey(nearest)) throw;
        fail(setting, fmt::format("'{}' is not a key; did you mean '{}'?", setting.key, nearest));
    }
}

// Full keys of the settings in their order. Throws where two of them mean the same.
std::vector<std::string> fullKeysOf(const std::vector<Setting>& settings,
                                    const params::ParamSet& params) {
    std::map<std::string, const Setting*> writtenAs;
    std::vector<std::string> keys;
    for (const Setting& setting : settings) {
        keys.push_back(Resolver::isRunKey(setting.key) ? setting.key
                                                       : parameterName(params, setting));
        const auto [other, isNew] = writtenAs.emplace(keys.back(), &setting);
        if (!isNew) {
            fail(setting,
                 fmt::format("'{}' and '{}' ({}) both set {}; leave one of them out.", setting.key,
                             other->second->key, other->second->place, keys.back()));
        }
    }
    return keys;
}

template <class T>
std::string_view bytesOf(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// What a scene's file only names: meshes and images.
std::string contentsOf(const scene::Scene& scene) {
    std::string parts;
    for (const scene::Mesh& mesh : scene.meshes) {
        if (mesh.heightField) continue;  // made from the scene's file
        parts += fingerprint(bytesOf(mesh.positions)) + fingerprint(bytesOf(mesh.normals)) +
                 fingerprint(bytesOf(mesh.uvs)) + fingerprint(bytesOf(mesh.triangles));
    }
    for (const scene::TextureImage& image : scene.images)
        parts += fingerprint(image.file.empty() ? image.bytes : readFile(image.file));
    for (const fs::path& file : scene.extendedFiles)
        parts += fingerprint(readFile(file));
    return fingerprint(parts);
}

}  // namespace

Resolver::Resolver(fs::path specFile, RunDefaults defaults, MakeParams makeParams)
    : specFile_(std::move(specFile)),
      defaults_(std::move(defaults)),
      makeParams_(std::move(makeParams)) {}

bool Resolver::isRunKey(const std::string& key) {
    return std::find(runKeys().begin(), runKeys().end(), key) != runKeys().end();
}

const Resolver::KnownScene& Resolver::scene(const Setting& setting) {
    const std::string name = requireText(setting);
    const auto found = scenes_.find(name);
    if (found != scenes_.end()) return found->second;
    // A file is looked for beside the experiment, wherever the program is started.
    KnownScene known;
    known.argument =
        scene::isSceneFile(name) ? fs::absolute(specFile_.parent_path() / name).string() : name;
    try {
        const scene::Scene loaded = scene::loadScene(known.argument);
        known.timeSeconds = loaded.timeSeconds;
        known.identity = {{"name", fs::path(name).filename().string()},
                          {"fingerprint", fingerprint(readFile(loaded.file))},
                          {"contents", contentsOf(loaded)}};
    } catch (const ConfigError& error) {
        fail(setting, error.what());
    } catch (const IoError& error) {
        throw IoError(fmt::format("{}: {}", setting.place, error.what()));
    }
    return scenes_.emplace(name, std::move(known)).first->second;
}

std::pair<json, std::string> Resolver::reference(const Setting& setting) const {
    const std::string name = requireText(setting);
    if (name == "none" || name == "auto") return {name, name};
    const fs::path file = fs::absolute(specFile_.parent_path() / name);
    if (!fs::is_regular_file(file)) {
        fail(setting, fmt::format("reference is none, auto or a file beside the experiment, and "
                                  "there is no file '{}'{}",
                                  name, didYouMean(name, {"none", "auto"})) +
                          (didYouMean(name, {"none", "auto"}).empty() ? "." : ""));
    }
    return {json{{"name", file.filename().string()}, {"fingerprint", fingerprint(readFile(file))}},
            file.string()};
}

Resolver::Resolved Resolver::resolve(const std::vector<Setting>& base,
                                     const std::vector<Setting>& chosen) {
    // What is not set is the default, at no place that could be wrong.
    std::map<std::string, Setting> values;
    const auto preset = [&](const char* key, json value) {
        values[key] = {key, std::move(value), specFile_.string()};
    };
    preset("scene", defaults_.scene);
    preset("technique", defaults_.technique);
    preset("size", defaults_.size);
    preset("frames", defaults_.frames);
    preset("warmup", defaults_.warmup);
    preset("seed", defaults_.seed);
    preset("precise", false);
    preset("reference", defaults_.reference);
    preset("reference_photons", defaults_.referencePhotons);
    preset("disable", json::array());

    // Which parameters there are may depend on the technique, so it comes first.
    for (const std::vector<Setting>* settings : {&base, &chosen}) {
        for (const Setting& setting : *settings) {
            if (isRunKey(setting.key)) values[setting.key] = setting;
        }
    }
    const std::string technique = requireText(values["technique"]);
    Resolved result;
    try {
        result.params = makeParams_(technique);
    } catch (const ConfigError& error) {
        fail(values["technique"], error.what());
    }
    for (const std::vector<Setting>* settings : {&base, &chosen}) {
        result.fullKeys = fullKeysOf(*settings, result.params);
        for (std::size_t i = 0; i < settings->size(); ++i) {
            const Setting& setting = (*settings)[i];
            if (isRunKey(setting.key)) continue;
            result.params.set(result.fullKeys[i], textOf(setting), setting.place);
        }
    }

    const KnownScene& scene = this->scene(values["scene"]);
    const bool hasTime = values.contains("time");
    const double time = hasTime ? requireSeconds(values["time"]) : scene.timeSeconds;
    const bool hasTimeStep = values.contains("time_step");
    const double timeStep = hasTimeStep ? requireSeconds(values["time_step"]) : 0.0;
    if (!values["precise"].value.is_boolean()) {
        fail(values["precise"], "precise must be true or false.");
    }
    const bool precise = values["precise"].value.get<bool>();
    const auto [reference, referenceArgument] = this->reference(values["reference"]);
    result.settings = {
        {"schema", "kaustik.settings/1"},
        {"scene", scene.identity},
        {"technique", technique},
        {"parameters", result.params.json()},
        {"disable", requireTexts(values["disable"])},
        {"size", requireSize(values["size"])},
        {"frames", requireWhole(values["frames"], 1, 1000000)},
        {"warmup", requireWhole(values["warmup"], 0, 1000000)},
        {"seed", requireWhole(values["seed"], INT64_MIN, INT64_MAX)},
        {"precise", precise},
        {"time_s", time},
        {"reference", reference},
        {"reference_photons", requireWhole(values["reference_photons"], 1, kMostReferencePhotons)},
        {"version", versionString()}};

    // Only where it is there, so that studies of still scenes keep the folders that they have.
    if (hasTimeStep) result.settings["time_step_s"] = timeStep;

    const json& settings = result.settings;
    result.disablePlace = values["disable"].place;
    // A name and its value are one word, since a value may begin with '-'.
    const auto option = [](const std::string& name, const std::string& value) {
        return fmt::format("--{}={}", name, value);
    };
    result.sceneArguments = {scene.argument, option("technique", technique),
                             option("size", settings["size"].get<std::string>())};
    if (hasTime) result.sceneArguments.push_back(option("time", fmt::format("{}", time)));
    for (const json& pass : settings["disable"])
        result.sceneArguments.push_back(option("disable", pass.get<std::string>()));
    for (const params::NamedField& named : result.params.all()) {
        if (!result.params.isSetByUser(named.fullName)) continue;
        result.sceneArguments.push_back(option("set", named.fullName + "=" + named.field.text()));
    }
    result.runArguments = {
        option("frames", settings["frames"].dump()), option("warmup", settings["warmup"].dump()),
        option("seed", settings["seed"].dump()), option("reference", referenceArgument)};
    if (reference == "auto") {
        result.runArguments.push_back(
            option("reference-photons", settings["reference_photons"].dump()));
    }
    if (hasTimeStep)
        result.runArguments.push_back(option("time-step", fmt::format("{}", timeStep)));
    if (precise) result.runArguments.emplace_back("--precise");
    return result;
}

json Resolver::valueOf(const json& settings, const std::string& fullKey) {
    if (fullKey == "time") return settings.at("time_s");
    if (fullKey == "time_step") return settings.value("time_step_s", json());
    if (fullKey == "disable") {
        const auto passes = settings.at("disable").get<std::vector<std::string>>();
        return passes.empty() ? json("none") : json(fmt::format("{}", fmt::join(passes, " ")));
    }
    if (fullKey == "scene") return settings.at("scene").at("name");
    if (fullKey == "reference" && settings.at("reference").is_object()) {
        return settings.at("reference").at("name");
    }
    if (isRunKey(fullKey)) return settings.at(fullKey);
    return settings.at("parameters").value(fullKey, json());
}

}  // namespace kaustik::experiment
