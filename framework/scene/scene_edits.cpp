// SPDX-License-Identifier: MIT
#include "framework/scene/scene_edits.h"

#include <fmt/format.h>

#include "framework/core/error.h"
#include "framework/core/names.h"
#include "framework/scene/emitters.h"
#include "framework/scene/files/table_reader.h"
#include "framework/scene/shapes/height_field.h"

namespace kaustik::scene {
namespace {

template <class Named>
const Named& findNamed(const std::vector<Named>& all, const std::string& name, const char* what) {
    std::vector<std::string> names;
    for (const Named& one : all) {
        if (one.name == name) return one;
        names.push_back(one.name);
    }
    throw ConfigError(
        fmt::format("the scene has no {} '{}'{}", what, name, didYouMean(name, names)));
}

// Of those that a file says.
const Light& lightNamed(const Scene& scene, const std::string& name) {
    for (const Emitter& emitter : scene.emitters) {
        if (emitter.isDisc() && emitter.light.name == name) return emitter.light;
    }
    return findNamed(scene.lights, name, "light");
}

const Mesh& waterOf(const Scene& scene, const std::string& name) {
    const Object& object = findNamed(scene.objects, name, "object");
    const Mesh& mesh = scene.meshes[object.mesh];
    if (!mesh.heightField)
        throw ConfigError(fmt::format("'{}' is not water and has no waves", name));
    return mesh;
}

void check(const Scene& scene, const SceneEdits& edits) {
    for (const auto& [name, edit] : edits.lights) {
        const Light& light = lightNamed(scene, name);
        if (edit.direction && light.kind == LightKind::point)
            throw ConfigError(fmt::format("'{}' is a point light and has no direction", name));
        if (edit.angularDiameterDegrees && light.kind != LightKind::directional)
            throw ConfigError(fmt::format("'{}' is no directional light and has no disc", name));
        if (edit.position && light.kind == LightKind::directional)
            throw ConfigError(fmt::format("'{}' is a directional light and has no position", name));
    }
    for (const auto& [name, waves] : edits.waves)
        static_cast<void>(waterOf(scene, name));
}

std::string list(const glm::dvec3& v) {
    return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}
std::string list(const glm::vec3& v) {
    return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}

std::string waveText(const Wave& wave) {
    std::string text = fmt::format(
        "    {{amplitude = {}, wavelength = {}, direction_degrees = {}, phase = {}",
        wave.amplitudeMeters, wave.wavelengthMeters, wave.directionDegrees, wave.phaseRadians);
    if (wave.omegaRadiansPerSecond >= 0.0f)
        text += fmt::format(", omega = {}", wave.omegaRadiansPerSecond);
    return text + "},\n";
}

}  // namespace

void applyEdits(Scene& scene, const SceneEdits& edits) {
    check(scene, edits);
    if (edits.camera) scene.camera = *edits.camera;
    if (edits.medium) scene.medium = *edits.medium;
    for (Light& light : scene.lights)
        light = withEdits(light, edits);
    for (Emitter& emitter : scene.emitters)
        emitter.light = withEdits(emitter.light, edits);
    for (const auto& [name, waves] : edits.waves) {
        const Object& object = findNamed(scene.objects, name, "object");
        scene.meshes[object.mesh].heightField->waves = waves;
    }
    findEmitters(scene);
    if (edits.timeSeconds || !edits.waves.empty())
        setTime(scene, edits.timeSeconds.value_or(scene.timeSeconds));
}

Light withEdits(Light light, const SceneEdits& edits) {
    const auto found = edits.lights.find(light.name);
    if (found == edits.lights.end()) return light;
    const LightEdit& edit = found->second;
    if (edit.direction) {
        light.direction = unitDirection(*edit.direction);
        if (light.image >= 0) {
            // Its top stays as it is as far as it can.
            const auto up = topOfImage(light.direction, light.up);
            light.up =
                up ? *up : topOfImage(light.direction, defaultTopOfImage(light.direction)).value();
        }
    }
    if (edit.position) light.position = *edit.position;
    if (edit.angularDiameterDegrees) {
        light.angularDiameterRadians =
            static_cast<float>(glm::radians(*edit.angularDiameterDegrees));
    }
    if (edit.powerFactor) light.power *= *edit.powerFactor;
    return light;
}

std::string writeSceneFile(const std::string& name, const std::string& base,
                           const SceneEdits& edits) {
    std::string text = "# SPDX-License-Identifier: MIT\n";
    text += fmt::format("name = {}\nextends = {}\n", tomlString(name), tomlString(base));
    if (edits.timeSeconds) text += fmt::format("time = {}\n", *edits.timeSeconds);
    if (edits.camera) {
        const Camera& camera = *edits.camera;
        text += fmt::format(
            "\n[camera]\nposition = {}\ntarget = {}\nup = {}\nvertical_fov_degrees = {}\n"
            "near = {}\n",
            list(camera.position), list(camera.target), list(camera.up), camera.verticalFovDegrees,
            camera.nearMeters);
    }
    if (edits.medium) {
        text += fmt::format(
            "\n[medium]\nscattering_per_meter = {}\nabsorption_per_meter = {}\nanisotropy = {}\n",
            list(edits.medium->scatteringPerMeter), list(edits.medium->absorptionPerMeter),
            edits.medium->anisotropy);
    }
    for (const auto& [light, edit] : edits.lights) {
        text += fmt::format("\n[[light]]\nname = {}\n", tomlString(light));
        if (edit.direction) text += fmt::format("direction = {}\n", list(*edit.direction));
        if (edit.position) text += fmt::format("position = {}\n", list(*edit.position));
        if (edit.angularDiameterDegrees)
            text += fmt::format("angular_diameter_degrees = {}\n", *edit.angularDiameterDegrees);
        if (edit.powerFactor) text += fmt::format("power_factor = {}\n", *edit.powerFactor);
    }
    for (const auto& [object, waves] : edits.waves) {
        text += fmt::format("\n[[water]]\nobject = {}\nwaves = [\n", tomlString(object));
        for (const Wave& wave : waves)
            text += waveText(wave);
        text += "]\n";
    }
    return text;
}

}  // namespace kaustik::scene
