// SPDX-License-Identifier: MIT
// The tables [camera], [medium], [environment], [[light]] and [[material]] of a scene file.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "framework/core/error.h"
#include "framework/image/pfm.h"
#include "framework/scene/dispersion.h"
#include "framework/scene/environment.h"
#include "framework/scene/files/scene_file_parts.h"
#include "framework/scene/texture.h"

namespace kaustik::scene {
namespace {

// Towards 90 degrees an image in the tangent plane has no edge.
constexpr float kMaxImageDegrees = 89.0f;

// Intensity inside the inner cone over the flux of the whole light.
double intensityPerWatt(const Light& light) {
    if (light.kind == LightKind::point) return 1.0 / (4.0 * glm::pi<double>());
    const double inner = std::cos(double(light.innerConeRadians));
    const double outer = std::cos(double(light.outerConeRadians));
    // The integral of `spotFalloff` over the sphere.
    return 1.0 / (2.0 * glm::pi<double>() * ((1.0 - inner) + (inner - outer) / 3.0));
}

void setCone(const TableReader& reader, const LightKeys& keys, Light& light) {
    if (keys.innerConeDegrees > keys.outerConeDegrees) {
        reader.fail(
            "inner_cone_degrees",
            fmt::format("inner_cone_degrees must be at most outer_cone_degrees ({}), not {}",
                        keys.outerConeDegrees, keys.innerConeDegrees));
    }
    light.innerConeRadians = static_cast<float>(glm::radians(keys.innerConeDegrees));
    light.outerConeRadians = static_cast<float>(glm::radians(keys.outerConeDegrees));
}

// Files of float images hold linear light; others are display-encoded.
bool isEncoded(const std::filesystem::path& file) {
    const std::string extension = lowerExtension(file);
    return extension != ".pfm" && extension != ".exr" && extension != ".hdr";
}

// The index of an image that a key names.
int addImage(const TableReader& reader, const std::string& name, Scene& scene,
             const char* key = "texture", bool isNormalMap = false) {
    const std::filesystem::path file = reader.file().parent_path() / name;
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) {
        throw IoError(fmt::format("{}: {}: the {} {} was not found.", reader.place(key),
                                  reader.subject(), key, file.string()));
    }
    for (std::size_t i = 0; i < scene.images.size(); ++i) {
        if (scene.images[i].file == file && scene.images[i].isNormalMap == isNormalMap)
            return static_cast<int>(i);
    }
    scene.images.push_back({name, file, "", isEncoded(file) && !isNormalMap, isNormalMap});
    return static_cast<int>(scene.images.size() - 1);
}

int addNormalMap(const TableReader& reader, const std::string& name, Scene& scene) {
    const int index = addImage(reader, name, scene, "normal_map", true);
    try {
        static_cast<void>(decodeTexture(scene.images[static_cast<std::size_t>(index)]));
    } catch (const IoError& error) {
        throw IoError(
            fmt::format("{}: {}: {}", reader.place("normal_map"), reader.subject(), error.what()));
    }
    return index;
}

void setSpotImage(const TableReader& reader, const LightKeys& keys, Light& light, Scene& scene) {
    if (!keys.texture) return;
    light.image = addImage(reader, *keys.texture, scene);
    if (light.outerConeRadians > glm::radians(kMaxImageDegrees)) {
        reader.fail("texture", fmt::format("a light with a texture has an outer_cone_degrees of at "
                                           "most {}, not {}",
                                           kMaxImageDegrees, glm::degrees(light.outerConeRadians)));
    }
    const std::optional<glm::dvec3> up = topOfImage(
        light.direction, keys.up ? unitDirection(*keys.up) : defaultTopOfImage(light.direction));
    if (!up) reader.fail("up", "up must not be parallel to direction");
    light.up = *up;
}

// A surface that reflects more than it receives is a slip.
void requireNoGain(const TableReader& reader, const Material& material) {
    const auto check = [&](const glm::vec3& albedo, const char* key) {
        const glm::vec3 sum = albedo + material.specular;
        const float maximum = std::max({sum.r, sum.g, sum.b});
        if (maximum <= 1.0f + 1e-6f) return;
        reader.fail("specular",
                    fmt::format("{} and specular must add up to at most 1, not {}", key, maximum));
    };
    check(material.albedo, "albedo");
    if (material.pattern != Pattern::none) check(material.patternAlbedo, "pattern_albedo");
}

Dispersion dispersionOf(const TableReader& reader, const DispersionKeys& keys) {
    if (keys.cauchy) return byCauchy(*keys.cauchy);
    if (keys.sellmeier) {
        const std::array<glm::dvec2, 3> terms{glm::dvec2(keys.sellmeier->b.x, keys.sellmeier->c.x),
                                              glm::dvec2(keys.sellmeier->b.y, keys.sellmeier->c.y),
                                              glm::dvec2(keys.sellmeier->b.z, keys.sellmeier->c.z)};
        return bySellmeier(terms);
    }
    if (keys.glass) {
        std::vector<std::string> names;
        for (const NamedGlass& glass : namedGlasses()) {
            if (glass.name == *keys.glass) return bySellmeier(glass.sellmeier);
            names.push_back(glass.name);
        }
        reader.fail("glass", fmt::format("glass {}", TableReader::notOneOf(*keys.glass, names)));
    }
    if (keys.abbeNumber) return byAbbeNumber(*keys.ior, *keys.abbeNumber);
    return {*keys.ior};
}

void setIndex(const TableReader& reader, const DispersionKeys& keys, Material& material) {
    const Dispersion dispersion = dispersionOf(reader, keys);
    const char* const key = keys.cauchy       ? "cauchy"
                            : keys.sellmeier  ? "sellmeier"
                            : keys.abbeNumber ? "abbe_number"
                                              : "ior";
    if (!isPossible(dispersion)) {
        reader.fail(key,
                    fmt::format("{} makes the index of refraction less than 1 (or more than 10, "
                                "or no number) somewhere from 380 to 700 nm",
                                key));
    }
    material.ior = static_cast<float>(dispersion.ior);
    material.dispersion = glm::vec4(dispersion.polynomial);
}

}  // namespace

Camera readCamera(TableReader& reader) {
    auto camera = reader.read<Camera>();
    camera.up = unitDirection(camera.up);
    const glm::dvec3 forward = camera.target - camera.position;
    if (glm::length(forward) < kSmallestLength) {
        reader.fail("target", "target must differ from position");
    }
    if (glm::length(glm::cross(glm::normalize(forward), camera.up)) < 1e-6) {
        reader.fail("up", "up must not be parallel to the view from position to target");
    }
    return camera;
}

void readEnvironment(TableReader& reader, Scene& scene) {
    const auto keys = reader.read<EnvironmentKeys>();
    scene.environmentTurnDegrees = keys.turnDegrees;
    scene.environmentLights = keys.lights;
    if (keys.image) {
        scene.environmentImage = addImage(reader, *keys.image, scene, "image");
    } else if (keys.pattern) {
        const char* const name = *keys.pattern == EnvironmentPattern::sky ? "sky" : "grid";
        scene.environmentImage = static_cast<int>(scene.images.size());
        // As a file would be, so that nothing else need know of it.
        scene.images.push_back({fmt::format("the environment's pattern {}", name), "",
                                encodePfm(makeEnvironment(*keys.pattern)), false});
    }
    if (scene.backgroundRadiance == glm::vec3(0.0f)) {
        reader.fail("",
                    "an environment is seen only where background_radiance, which multiplies "
                    "it, is above 0");
    }
}

Light readLight(TableReader& reader, Scene& scene) {
    const auto keys = reader.read<LightKeys>();
    Light light;
    light.name = keys.name;
    light.kind = keys.kind;
    if (light.kind != LightKind::point) light.direction = unitDirection(keys.direction);
    if (light.kind == LightKind::spot) {
        setCone(reader, keys, light);
        setSpotImage(reader, keys, light, scene);
    }
    light.position = keys.position;
    light.rangeMeters = keys.rangeMeters;
    double power = keys.irradiance;
    if (keys.intensity) power = *keys.intensity;
    if (keys.powerWatts) power = *keys.powerWatts * intensityPerWatt(light);
    light.power = glm::vec3(power * keys.color);
    light.angularDiameterRadians = static_cast<float>(glm::radians(keys.angularDiameterDegrees));
    return light;
}

Material readMaterial(TableReader& reader, Scene& scene) {
    auto [material, index, texture, normalMap] = reader.read<MaterialKeys>();
    if (material.kind == MaterialKind::dielectric) setIndex(reader, index, material);
    if (material.kind == MaterialKind::glossy) requireNoGain(reader, material);
    if (texture) material.image = addImage(reader, *texture, scene);
    if (normalMap) material.normalMap = addNormalMap(reader, *normalMap, scene);
    return material;
}

}  // namespace kaustik::scene
