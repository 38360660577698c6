// SPDX-License-Identifier: MIT
#include "framework/scene/foreign/foreign_toml.h"

#include <algorithm>
#include <cmath>

namespace kaustik::scene {
namespace {

constexpr glm::dvec3 kZero{0.0};

// As a scene file takes it, which refuses a field of view of 0 or of 180 degrees.
constexpr double kMinFov = 1e-3;
constexpr double kMaxFov = 179.9;

// An intensity or irradiance, and the colour that multiplies it where it is not grey.
void writePower(TomlLines& lines, const char* key, const glm::dvec3& power) {
    const double largest = std::max({power.r, power.g, power.b});
    lines.set(key, largest);
    if (largest > 0.0 && (power.r != power.g || power.g != power.b))
        lines.setColor("color", power / largest);
}

void writePlace(TomlLines& lines, const Placement& placement) {
    lines.setUnless(kZero, "position", placement.position);
    lines.setUnless(kZero, "rotation_degrees", placement.rotationDegrees);
}

void writeScale(TomlLines& lines, const glm::dvec3& scale) {
    if (isEven(scale.x, scale.y) && isEven(scale.y, scale.z)) {
        if (!isEven(scale.x, 1.0)) lines.set("scale", scale.x);
    } else {
        lines.set("scale", scale);
    }
}

}  // namespace

bool isEven(double a, double b) {
    return std::abs(a - b) <= 1e-6 * std::max(std::abs(a), std::abs(b));
}

void writeCamera(TomlLines& lines, const Camera& camera) {
    lines.table("[camera]");
    lines.set("position", camera.position);
    // As far away as the origin, so that rounding turns it no more than it moves the position.
    const glm::dvec3 way = camera.target - camera.position;
    const double distance = std::max(1.0, glm::length(camera.position));
    lines.set("target", camera.position + way * (distance / std::max(glm::length(way), 1e-12)));
    // The default where that gives the same picture: upright.
    const glm::dvec3 right = glm::cross(way, camera.up);
    const glm::dvec3 top = glm::cross(right, way);
    const bool isUpright =
        std::abs(right.y) <= 1e-9 * glm::length(right) && top.y > 1e-3 * glm::length(top);
    if (!isUpright) lines.set("up", camera.up);
    lines.set("vertical_fov_degrees", std::clamp(camera.verticalFovDegrees, kMinFov, kMaxFov));
    if (camera.nearMeters != Camera().nearMeters) lines.set("near", camera.nearMeters);
}

void writeMedium(TomlLines& lines, const Medium& medium) {
    lines.table("[medium]");
    lines.setColor("scattering_per_meter", medium.scatteringPerMeter);
    lines.setColor("absorption_per_meter", medium.absorptionPerMeter);
    if (medium.anisotropy != 0.0f) lines.set("anisotropy", double(medium.anisotropy));
}

void writeLight(TomlLines& lines, const Light& light, const std::string& name) {
    lines.table("[[light]]");
    lines.set("name", name);
    if (light.kind == LightKind::directional) {
        lines.set("type", "directional");
        lines.set("direction", light.direction);
        if (light.angularDiameterRadians > 0.0f) {
            lines.set("angular_diameter_degrees",
                      double(glm::degrees(light.angularDiameterRadians)));
        }
        return writePower(lines, "irradiance", light.power);
    }
    lines.set("type", light.kind == LightKind::point ? "point" : "spot");
    lines.set("position", light.position);
    if (light.kind == LightKind::spot) {
        lines.set("direction", light.direction);
        lines.set("inner_cone_degrees", double(glm::degrees(light.innerConeRadians)));
        lines.set("outer_cone_degrees", double(glm::degrees(light.outerConeRadians)));
    }
    writePower(lines, "intensity", light.power);
}

namespace {

void writeNormalMap(TomlLines& lines, const Material& material, const std::string& normalMap) {
    if (normalMap.empty()) return;
    lines.set("normal_map", normalMap);
    if (material.uvScale != glm::vec2(1.0f)) lines.set("uv_scale", glm::dvec2(material.uvScale));
}

}  // namespace

void writeMaterial(TomlLines& lines, const Material& material, const std::string& name,
                   const MaterialPictures& pictures) {
    lines.table("[[material]]");
    lines.set("name", name);
    if (material.kind == MaterialKind::dielectric) {
        lines.set("type", "dielectric");
        lines.set("ior", double(material.ior));
        if (material.absorptionPerMeter != glm::vec3(0.0f))
            lines.setColor("absorption_per_meter", material.absorptionPerMeter);
        return writeNormalMap(lines, material, pictures.normalMap);
    }
    if (material.kind == MaterialKind::mirror) {
        lines.set("type", "mirror");
        if (material.albedo != glm::vec3(1.0f)) lines.setColor("reflectance", material.albedo);
        return writeNormalMap(lines, material, pictures.normalMap);
    }
    const bool isGlossy = material.kind == MaterialKind::glossy;
    lines.set("type", isGlossy ? "glossy" : "lambertian");
    lines.setColor("albedo", material.albedo);
    if (material.emission != glm::vec3(0.0f)) lines.setColor("emission", material.emission);
    if (!pictures.texture.empty()) lines.set("texture", pictures.texture);
    if (material.pattern == Pattern::checker) {
        lines.set("pattern", "checker");
        lines.setColor("pattern_albedo", material.patternAlbedo);
    }
    if (material.uvScale != glm::vec2(1.0f)) lines.set("uv_scale", glm::dvec2(material.uvScale));
    if (!isGlossy) return;
    lines.setColor("specular", material.specular);
    lines.set("exponent", double(material.exponent));
}

void writeShape(TomlLines& lines, const ForeignShape& shape, const Placement& placement) {
    const glm::dvec3& scale = placement.scale;
    if (shape.geometry == ForeignGeometry::plane) {
        lines.set("shape", "plane");
        lines.set("size", glm::dvec2(scale.x, scale.z));
    } else if (shape.geometry == ForeignGeometry::disk) {
        lines.set("shape", "disc");
        lines.set("radius", scale.x);
    } else if (shape.geometry == ForeignGeometry::box) {
        lines.set("shape", "box");
        lines.set("size", scale);
    } else if (shape.geometry == ForeignGeometry::sphere) {
        const bool isRound = isEven(scale.x, scale.y) && isEven(scale.y, scale.z);
        lines.set("shape", "sphere");
        lines.set("radius", isRound ? scale.x : 1.0);
        if (!isRound) lines.set("scale", scale);
    } else {
        const bool isRound = isEven(scale.x, scale.z);
        lines.set("shape", "cylinder");
        lines.set("radius", isRound ? scale.x : 1.0);
        lines.set("height", isRound ? scale.y : 1.0);
        lines.set("open", true);
        if (!isRound) lines.set("scale", scale);
    }
    writePlace(lines, placement);
}

void writeMesh(TomlLines& lines, const std::string& file, const Placement& placement) {
    lines.set("mesh", file);
    writePlace(lines, placement);
    writeScale(lines, placement.scale);
}

}  // namespace kaustik::scene
