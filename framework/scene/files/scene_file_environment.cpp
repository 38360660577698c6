// SPDX-License-Identifier: MIT
// The tables [camera], [medium], [environment], [[light]] and [[material]] of a scene file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "framework/core/error.h"
#include "framework/image/pfm.h"
#include "framework/scene/environment.h"
#include "framework/scene/files/scene_file_parts.h"

namespace kaustik::scene {
namespace {

constexpr NumberRange kAlbedo = kUnitInterval;
constexpr NumberRange kFieldOfView{0.0, 180.0, true, true};
constexpr NumberRange kAnisotropy{-1.0, 1.0, true, true};
constexpr NumberRange kIor{1.0, 10.0, false, false};
constexpr NumberRange kInnerCone{0.0, 90.0, false, false};
constexpr NumberRange kOuterCone{0.0, 90.0, true, false};
// Towards 90 degrees an image in the tangent plane has no edge.
constexpr float kWidestImageDegrees = 89.0f;
// Narrower lobes, below a degree, are beyond what 32 bits tell apart on the device.
constexpr NumberRange kExponent{1.0, 10000.0, false, false};

// Intensity inside the inner cone over the flux of the whole light.
double intensityPerWatt(const Light& light) {
    if (light.kind == LightKind::point) return 1.0 / (4.0 * glm::pi<double>());
    const double inner = std::cos(double(light.innerConeRadians));
    const double outer = std::cos(double(light.outerConeRadians));
    // The integral of `spotFalloff` over the sphere.
    return 1.0 / (2.0 * glm::pi<double>() * ((1.0 - inner) + (inner - outer) / 3.0));
}

void readCone(TableReader& reader, Light& light) {
    const double inner = reader.number("inner_cone_degrees", kInnerCone, 0.0);
    const double outer = reader.number("outer_cone_degrees", kOuterCone, 45.0);
    if (inner > outer) {
        reader.fail(
            "inner_cone_degrees",
            fmt::format("inner_cone_degrees must be at most outer_cone_degrees ({}), not {}", outer,
                        inner));
    }
    light.innerConeRadians = static_cast<float>(glm::radians(inner));
    light.outerConeRadians = static_cast<float>(glm::radians(outer));
}

// Files of float images hold linear light; others are display-encoded.
bool isEncoded(const std::filesystem::path& file) {
    const std::string extension = lowerExtension(file);
    return extension != ".pfm" && extension != ".exr" && extension != ".hdr";
}

int readTexture(TableReader& reader, Scene& scene, const char* key = "texture") {
    const std::filesystem::path name = reader.text(key);
    const std::filesystem::path file = reader.file().parent_path() / name;
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) {
        throw IoError(fmt::format("{}: {}: the {} {} was not found.", reader.place(key),
                                  reader.subject(), key, file.string()));
    }
    for (std::size_t i = 0; i < scene.images.size(); ++i) {
        if (scene.images[i].file == file) return static_cast<int>(i);
    }
    scene.images.push_back({name.string(), file, "", isEncoded(file)});
    return static_cast<int>(scene.images.size() - 1);
}

void readSpotImage(TableReader& reader, Light& light, Scene& scene) {
    if (!reader.has("texture")) return;
    light.image = readTexture(reader, scene);
    if (light.outerConeRadians > glm::radians(kWidestImageDegrees)) {
        reader.fail("texture",
                    fmt::format("a light with a texture has an outer_cone_degrees of at "
                                "most {}, not {}",
                                kWidestImageDegrees, glm::degrees(light.outerConeRadians)));
    }
    const std::optional<glm::dvec3> up =
        topOfImage(light.direction,
                   reader.has("up") ? reader.direction("up") : defaultTopOfImage(light.direction));
    if (!up) reader.fail("up", "up must not be parallel to direction");
    light.up = *up;
}

// A surface that reflects more than it receives is a slip.
void requireNoGain(TableReader& reader, const Material& material) {
    const auto check = [&](const glm::vec3& albedo, const char* key) {
        const glm::vec3 sum = albedo + material.specular;
        const float most = std::max({sum.r, sum.g, sum.b});
        if (most <= 1.0f + 1e-6f) return;
        reader.fail("specular",
                    fmt::format("{} and specular must add up to at most 1, not {}", key, most));
    };
    check(material.albedo, "albedo");
    if (material.pattern != Pattern::none) check(material.patternAlbedo, "pattern_albedo");
}

}  // namespace

Camera readCamera(TableReader& reader) {
    Camera camera;
    camera.position = reader.vector3("position", kAnyNumber);
    camera.target = reader.vector3("target", kAnyNumber, glm::dvec3(0.0));
    if (reader.has("up")) camera.up = reader.direction("up");
    camera.verticalFovDegrees = reader.number("vertical_fov_degrees", kFieldOfView, 45.0);
    camera.nearMeters = reader.number("near", kPositive, 0.01);
    reader.finish();
    const glm::dvec3 forward = camera.target - camera.position;
    if (glm::length(forward) < kSmallestLength) {
        reader.fail("target", "target must differ from position");
    }
    if (glm::length(glm::cross(glm::normalize(forward), camera.up)) < 1e-6) {
        reader.fail("up", "up must not be parallel to the view from position to target");
    }
    return camera;
}

Medium readMedium(TableReader& reader) {
    Medium medium;
    medium.scatteringPerMeter =
        reader.uniformOrVector3("scattering_per_meter", kNotNegative, glm::dvec3(0.0));
    medium.absorptionPerMeter =
        reader.uniformOrVector3("absorption_per_meter", kNotNegative, glm::dvec3(0.0));
    medium.anisotropy = reader.numberAsFloat("anisotropy", kAnisotropy, 0.0);
    reader.finish();
    return medium;
}

void readEnvironment(TableReader& reader, Scene& scene) {
    scene.environmentTurnDegrees = reader.number("turn_degrees", kAnyNumber, 0.0);
    if (reader.has("image") == reader.has("pattern")) {
        reader.finish();
        reader.fail("image", "environment has either an image or a pattern");
    }
    if (reader.has("image")) {
        scene.environmentImage = readTexture(reader, scene, "image");
        reader.finish();
    } else {
        const auto pattern = reader.choice<EnvironmentPattern>(
            "pattern", {{"sky", EnvironmentPattern::sky}, {"grid", EnvironmentPattern::grid}});
        const std::string name = reader.text("pattern");
        reader.finish();
        scene.environmentImage = static_cast<int>(scene.images.size());
        // As a file would be, so that nothing else need know of it.
        scene.images.push_back(
            {"the environment's pattern " + name, "", encodePfm(makeEnvironment(pattern)), false});
    }
    if (scene.backgroundRadiance == glm::vec3(0.0f)) {
        reader.fail("",
                    "an environment is seen only where background_radiance, which multiplies "
                    "it, is above 0");
    }
}

Light readLight(TableReader& reader, Scene& scene) {
    Light light;
    light.name = reader.name();
    light.kind = reader.choice<LightKind>("type", {{"directional", LightKind::directional},
                                                   {"point", LightKind::point},
                                                   {"spot", LightKind::spot}});
    const glm::dvec3 color = reader.uniformOrVector3("color", kNotNegative, glm::dvec3(1.0));
    double power = 0.0;
    if (light.kind != LightKind::point) light.direction = reader.direction("direction");
    if (light.kind == LightKind::spot) {
        readCone(reader, light);
        readSpotImage(reader, light, scene);
    }
    if (light.kind == LightKind::directional) {
        power = reader.number("irradiance", kNotNegative);
    } else {
        light.position = reader.vector3("position", kAnyNumber);
        light.rangeMeters = reader.numberAsFloat("range", kNotNegative, 0.0);
        if (reader.has("power_watts") && reader.has("intensity")) {
            reader.fail("power_watts", "either intensity or power_watts is given, not both");
        }
        power = reader.has("power_watts")
                    ? reader.number("power_watts", kNotNegative) * intensityPerWatt(light)
                    : reader.number("intensity", kNotNegative);
    }
    reader.finish();
    light.power = glm::vec3(power * color);
    return light;
}

Material readMaterial(TableReader& reader, Scene& scene) {
    Material material;
    material.name = reader.name();
    material.kind = reader.choice<MaterialKind>("type", {{"lambertian", MaterialKind::lambertian},
                                                         {"dielectric", MaterialKind::dielectric},
                                                         {"mirror", MaterialKind::mirror},
                                                         {"glossy", MaterialKind::glossy}});
    switch (material.kind) {
        case MaterialKind::lambertian:
        case MaterialKind::glossy:
            material.albedo = reader.uniformOrVector3("albedo", kAlbedo);
            material.pattern = reader.choice<Pattern>(
                "pattern",
                {{"none", Pattern::none}, {"checker", Pattern::checker}, {"tiles", Pattern::tiles}},
                Pattern::none);
            material.patternAlbedo =
                reader.uniformOrVector3("pattern_albedo", kAlbedo, glm::dvec3(0.25));
            material.uvScale = reader.uniformOrVector2("uv_scale", kPositive, glm::dvec2(1.0));
            if (reader.has("texture")) material.image = readTexture(reader, scene);
            if (material.kind == MaterialKind::lambertian) break;
            material.specular = reader.uniformOrVector3("specular", kAlbedo);
            material.exponent = reader.numberAsFloat("exponent", kExponent, 50.0);
            if (reader.has("specular")) requireNoGain(reader, material);
            break;
        case MaterialKind::dielectric:
            material.albedo = glm::vec3(0.0f);
            material.ior = reader.numberAsFloat("ior", kIor);
            material.absorptionPerMeter =
                reader.uniformOrVector3("absorption_per_meter", kNotNegative, glm::dvec3(0.0));
            break;
        case MaterialKind::mirror:
            material.albedo = reader.uniformOrVector3("reflectance", kAlbedo, glm::dvec3(1.0));
            break;
    }
    reader.finish();
    return material;
}

}  // namespace kaustik::scene
