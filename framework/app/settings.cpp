// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "framework/app/commands.h"
#include "framework/core/error.h"
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

RenderSettings makeSettings(const SceneOptions& options, const Registry& registry) {
    RenderSettings settings;
    settings.technique = registry.findTechnique(options.technique);
    settings.params = registry.makeParams(settings.technique);
    for (const FileParameter& parameter : options.parameters)
        settings.params.set(parameter.name, parameter.value, parameter.place);
    for (const std::string& assignment : options.assignments) {
        settings.params.setAssignment(assignment, "--set");
    }
    const params::Extent size = parseSize(options.size);
    settings.width = size.width;
    settings.height = size.height;
    settings.disabledPasses.insert(options.disabled.begin(), options.disabled.end());
    settings.disabledBy = options.disabledBy;
    return settings;
}

params::Extent parseSize(const std::string& text) {
    params::Extent size;
    const params::Field field{"size", "", "px", &size, 1.0, 16384.0, {}};
    field.set(text, "size", "--size");
    return size;
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
