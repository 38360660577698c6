// SPDX-License-Identifier: MIT
#include "framework/experiment/resolve.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/experiment/fingerprint.h"
#include "framework/scene/files/scene_file.h"

namespace kaustik::experiment {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

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

const Resolver::KnownScene& Resolver::scene(const Setting& setting) {
    const auto name = runValue(setting).get<std::string>();
    const auto found = scenes_.find(name);
    if (found != scenes_.end()) return found->second;
    KnownScene known;
    known.argument = sceneArgument(setting, specFile_);
    try {
        const scene::Scene loaded = scene::loadScene(known.argument);
        known.timeSeconds = loaded.timeSeconds;
        known.identity = {{"name", fs::path(name).filename().string()},
                          {"fingerprint", fingerprint(readFile(loaded.file))},
                          {"contents", contentsOf(loaded)}};
    } catch (const ConfigError& error) {
        failAt(setting, error.what());
    } catch (const IoError& error) {
        throw IoError(fmt::format("{}: {}", setting.place, error.what()));
    }
    return scenes_.emplace(name, std::move(known)).first->second;
}

std::pair<json, std::string> Resolver::reference(const Setting& setting) const {
    const std::string argument = referenceArgument(setting, specFile_);
    if (argument == "none" || argument == "auto") return {argument, argument};
    return {json{{"name", fs::path(argument).filename().string()},
                 {"fingerprint", fingerprint(readFile(argument))}},
            argument};
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
    preset("as_published", false);
    preset("size", defaults_.size);
    preset("frames", defaults_.frames);
    preset("warmup", defaults_.warmup);
    preset("seed", defaults_.seed);
    preset("precise", false);
    preset("ledger", true);
    preset("reference", defaults_.reference);
    preset("reference_photons", defaults_.referencePhotons);
    preset("disable", json::array());

    // Which parameters there are may depend on the technique, so it comes first.
    for (const std::vector<Setting>* settings : {&base, &chosen}) {
        for (const Setting& setting : *settings) {
            if (isRunKey(setting.key)) values[setting.key] = setting;
        }
    }
    const std::string technique = runValue(values["technique"]).get<std::string>();
    const bool isAsPublished = runValue(values["as_published"]).get<bool>();
    Resolved result;
    try {
        result.params = makeParams_(technique, isAsPublished);
    } catch (const ConfigError& error) {
        failAt(values["technique"], error.what());
    }
    for (const std::vector<Setting>* settings : {&base, &chosen}) {
        result.fullKeys = fullKeysOf(*settings, result.params);
        assign(result.params, assignmentsOf(*settings, result.params));
    }

    const KnownScene& scene = this->scene(values["scene"]);
    const bool hasTime = values.contains("time");
    const double time = hasTime ? runValue(values["time"]).get<double>() : scene.timeSeconds;
    const bool hasTimeStep = values.contains("time_step");
    const double timeStep = hasTimeStep ? runValue(values["time_step"]).get<double>() : 0.0;
    const bool precise = runValue(values["precise"]).get<bool>();
    const bool hasLedger = runValue(values["ledger"]).get<bool>();
    const auto [reference, referenceArgument] = this->reference(values["reference"]);
    result.settings = {{"schema", "kaustik.settings/1"},
                       {"scene", scene.identity},
                       {"technique", technique},
                       {"parameters", result.params.json()},
                       {"disable", runValue(values["disable"])},
                       {"size", runValue(values["size"])},
                       {"frames", runValue(values["frames"])},
                       {"warmup", runValue(values["warmup"])},
                       {"seed", runValue(values["seed"])},
                       {"precise", precise},
                       {"time_s", time},
                       {"reference", reference},
                       {"reference_photons", runValue(values["reference_photons"])},
                       {"version", versionString()}};

    // Only where it is there, so that studies of still scenes keep the folders that they have.
    if (hasTimeStep) result.settings["time_step_s"] = timeStep;
    // So do those of the default rows.
    if (isAsPublished) result.settings["as_published"] = true;
    if (!hasLedger) result.settings["ledger"] = false;

    const json& settings = result.settings;
    result.disablePlace = values["disable"].place;
    // A name and its value are one word, since a value may begin with '-'.
    const auto option = [](const std::string& name, const std::string& value) {
        return fmt::format("--{}={}", name, value);
    };
    result.sceneArguments = {scene.argument, option("technique", technique),
                             option("size", settings["size"].get<std::string>())};
    if (isAsPublished) result.sceneArguments.emplace_back("--as-published");
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
    if (!hasLedger) result.runArguments.emplace_back("--no-ledger");
    return result;
}

json Resolver::valueOf(const json& settings, const std::string& fullKey) {
    if (fullKey == "time") return settings.at("time_s");
    if (fullKey == "as_published") return settings.value("as_published", false);
    if (fullKey == "ledger") return settings.value("ledger", true);
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
