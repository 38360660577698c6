// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/run/settings.h"
#include "framework/scene/files/own_mesh.h"
#include "framework/scene/files/scene_file.h"
#include "framework/scene/shapes/height_field.h"

namespace kaustik::app {
namespace {

// A file that names it is where the mistake may be.
scene::Scene loadNamedScene(const std::string& name, const std::string& namedAt) {
    if (namedAt.empty()) return scene::loadScene(name);
    try {
        return scene::loadScene(name);
    } catch (const ConfigError& error) {
        throw ConfigError(fmt::format("{}: {}", namedAt, error.what()));
    } catch (const IoError& error) {
        throw IoError(fmt::format("{}: {}", namedAt, error.what()));
    }
}

}  // namespace

RenderSettings makeSettings(const SceneOptions& options, const Registry& registry, long long seed) {
    run::SettingsRequest request{options.technique,
                                 options.parameters,
                                 {options.disabled.begin(), options.disabled.end()},
                                 options.disabledBy,
                                 static_cast<std::uint64_t>(seed),
                                 options.isAsPublished};
    for (const std::string& assignment : options.assignments)
        request.assignments.push_back(params::parseAssignment(assignment, "--set"));
    RenderSettings settings = run::makeSettings(request, registry);
    run::setSize(settings, params::parsePictureSize(options.size, "--size"));
    return settings;
}

void putOwnMesh(std::string& scene, const OwnMeshOptions& options) {
    if (options.on.empty() && options.material.empty() && options.up.empty()) return;
    const std::optional<scene::OwnMesh> named = scene::parseOwnMesh(scene);
    scene::OwnMesh mesh = named.value_or(scene::OwnMesh{.file = scene});
    const bool isGltf = scene::isSceneFile(scene) && !scene.ends_with(".toml");
    if (!named && (options.on.empty() || !isGltf)) {
        throw ConfigError(
            fmt::format("{}: '{}' is a scene; --on, --material and --up are of a mesh "
                        "that is stood into one, such as 'dragon.ply', or of a .glb "
                        "with --on.",
                        options.on.empty() ? "--material" : "--on", scene));
    }
    if (!options.on.empty()) mesh.on = options.on;
    if (!options.material.empty()) mesh.material = options.material;
    if (!options.up.empty()) mesh.up = options.up;
    scene = scene::nameOf(mesh);
}

scene::Scene loadRequestedScene(const std::string& name, const std::string& time,
                                const std::string& namedAt) {
    scene::Scene scene = loadNamedScene(name, namedAt);
    if (!time.empty()) {
        double seconds = 0.0;
        const char* end = time.data() + time.size();
        const auto [parsed, error] = std::from_chars(time.data(), end, seconds);
        if (error != std::errc() || parsed != end || !std::isfinite(seconds)) {
            throw ConfigError(fmt::format("--time: '{}' is not a number of seconds.", time));
        }
        scene::setTime(scene, seconds);
    }
    return scene;
}

}  // namespace kaustik::app
