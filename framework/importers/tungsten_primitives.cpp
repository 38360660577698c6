// SPDX-License-Identifier: MIT
// Primitives of a Tungsten scene: surfaces, lights without a size, and what surrounds the scene.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <system_error>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/importers/foreign_file.h"
#include "framework/importers/tungsten_parts.h"
#include "framework/scene/files/scene_file_parts.h"

namespace kaustik::scene {
namespace {

// What an evening sky radiates about, in W/m²/sr, where nothing but its turbidity is said.
constexpr glm::dvec3 kSkyRadiance{0.6, 0.8, 1.2};

std::optional<ForeignEmission> emissionOf(TungstenImport& importer, const JsonTree& primitive) {
    if (primitive.find("power") != nullptr) {
        return ForeignEmission{
            glm::max(evenColor(importer, primitive, "power", glm::dvec3(0.0)), 0.0), true};
    }
    if (primitive.find("emission") == nullptr) return std::nullopt;
    const glm::dvec3 radiance =
        glm::max(evenColor(importer, primitive, "emission", glm::dvec3(0.0)), 0.0);
    if (radiance == glm::dvec3(0.0)) return std::nullopt;
    return ForeignEmission{radiance, false};
}

void readMeshFile(TungstenImport& importer, const JsonTree& primitive, ForeignShape& shape) {
    const JsonTree* const name = primitive.find("file");
    if (name == nullptr || name->as<std::string>() == nullptr)
        failAt(primitive.place, "a mesh needs a 'file'.");
    const std::filesystem::path file = importer.folder / *name->as<std::string>();
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        throw IoError(fmt::format("{}: the mesh {} was not found.", name->place, file.string()));
    for (const char* const key : {"smooth", "backface_culling", "recompute_normals"})
        static_cast<void>(primitive.find(key));
    if (lowerExtension(file) != ".wo3") {
        shape.geometry = ForeignGeometry::meshFile;
        shape.file = file;
        return;
    }
    ImportedMesh imported = readWo3(readFile(file), file.string());
    shape.geometry = ForeignGeometry::mesh;
    shape.mesh = std::move(imported.mesh);
    for (const std::string& warning : imported.warnings)
        importer.change("primitive", primitive, warning);
}

// A disk and a sphere stay round, whatever their transform says.
glm::dmat4 evenlyScaled(const glm::dmat4& matrix, bool isFlat) {
    const double x = glm::length(glm::dvec3(matrix[0]));
    const double y = isFlat ? 0.0 : glm::length(glm::dvec3(matrix[1]));
    const double z = glm::length(glm::dvec3(matrix[2]));
    const double radius = std::max({x, y, z});
    glm::dmat4 even = matrix;
    for (int i = 0; i < 3; ++i) {
        const double length = glm::length(glm::dvec3(matrix[i]));
        if (length > 0.0) even[i] *= radius / length;
    }
    return even;
}

bool readGeometry(TungstenImport& importer, const JsonTree& primitive, const std::string& type,
                  ForeignShape& shape) {
    shape.toWorld = jsonTransform(primitive);
    if (type == "quad") {
        shape.geometry = ForeignGeometry::plane;
        shape.turnsTexture = true;
    } else if (type == "disk") {
        shape.geometry = ForeignGeometry::disk;
        shape.toWorld = evenlyScaled(shape.toWorld, true);
    } else if (type == "sphere") {
        shape.geometry = ForeignGeometry::sphere;
        shape.toWorld = evenlyScaled(shape.toWorld, false);
    } else if (type == "cube") {
        shape.geometry = ForeignGeometry::box;
    } else if (type == "cylinder") {
        shape.geometry = ForeignGeometry::cylinder;
        shape.toWorld =
            shape.toWorld * glm::dmat4(glm::dmat3(1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0));
        if (jsonFlag(primitive, "capped", false))
            importer.change("primitive", primitive, "it has no caps");
    } else if (type == "mesh") {
        readMeshFile(importer, primitive, shape);
    } else {
        return false;
    }
    return true;
}

void readPoint(TungstenImport& importer, const JsonTree& primitive) {
    Light light;
    light.kind = LightKind::point;
    light.name = importer.nameOf(primitive);
    light.position = glm::dvec3(jsonTransform(primitive)[3]);
    static_cast<void>(primitive.find("bsdf"));
    if (const auto emission = emissionOf(importer, primitive)) {
        const double factor = emission->isPower ? 0.25 * glm::one_over_pi<double>() : 1.0;
        light.power = glm::vec3(factor * emission->radiance);
        importer.scene.lights.push_back(std::move(light));
    }
}

// A far disk of the sky is a sun: its light comes from one direction.
void readCap(TungstenImport& importer, const JsonTree& primitive) {
    const double angle =
        glm::radians(std::clamp(jsonNumber(primitive, "cap_angle", 10.0), 1e-3, 90.0));
    const glm::dvec3 towards(jsonTransform(primitive)[1]);
    if (!(glm::length(towards) > 1e-12)) failAt(primitive.place, "this light has no direction.");
    const auto emission = emissionOf(importer, primitive);
    if (!emission) return;
    glm::dvec3 radiance = emission->radiance;
    if (emission->isPower) radiance /= 2.0 * glm::pi<double>() * (1.0 - std::cos(angle));
    Light light;
    light.kind = LightKind::directional;
    light.name = importer.nameOf(primitive);
    light.direction = -glm::normalize(towards);
    light.power = glm::vec3(radiance * glm::pi<double>() * std::sin(angle) * std::sin(angle));
    constexpr double kWidest = 45.0;  // half of what a scene file takes
    light.angularDiameterRadians = static_cast<float>(2.0 * std::min(angle, glm::radians(kWidest)));
    importer.scene.lights.push_back(std::move(light));
    if (angle > glm::radians(kWidest)) {
        importer.change("primitive", primitive,
                        "it is a disc of 90 degrees, of the same irradiance");
    }
}

void readSurrounding(TungstenImport& importer, const JsonTree& primitive) {
    ForeignScene& scene = importer.scene;
    const ForeignColor color = surfaceColor(importer, primitive, "emission", glm::dvec3(0.0));
    const glm::dmat4 matrix = jsonTransform(primitive);
    scene.environment = color.image;
    scene.backgroundRadiance = glm::max(color.color, 0.0);
    scene.environmentTurnDegrees = environmentTurn(glm::dvec3(matrix[0]));
    if (color.image &&
        std::abs(matrix[1].x) + std::abs(matrix[1].z) > 1e-6 * std::abs(matrix[1].y)) {
        importer.change("primitive", primitive, "it is turned about the vertical alone");
    }
}

}  // namespace

void readTungstenPrimitive(TungstenImport& importer, const JsonTree& primitive) {
    const std::string type = jsonText(primitive, "type");
    static_cast<void>(primitive.find("sample"));  // how it is sampled is no part of the scene
    if (type == "point") return readPoint(importer, primitive);
    if (type == "infinite_sphere_cap") return readCap(importer, primitive);
    if (type == "infinite_sphere") return readSurrounding(importer, primitive);
    if (type == "skydome") {
        importer.scene.backgroundRadiance = kSkyRadiance;
        return importer.leaveOut("primitive", primitive, "it is an even blue sky");
    }
    ForeignShape shape;
    shape.place = primitive.place;
    if (!readGeometry(importer, primitive, type, shape)) {
        return importer.leaveOut("primitive", primitive,
                                 fmt::format("primitives of type '{}' are not read", type));
    }
    shape.emission = emissionOf(importer, primitive);
    std::string whyNot;
    const std::optional<std::uint32_t> material = materialOf(importer, primitive, whyNot);
    if (!material && !shape.emission) return importer.leaveOut("primitive", primitive, whyNot);
    if (material) {
        shape.material = *material;
    } else {  // what only emits reflects nothing
        shape.material = static_cast<std::uint32_t>(importer.scene.materials.size());
        importer.scene.materials.push_back({});
        importer.scene.materials.back().material.name = "black";
        importer.scene.materials.back().material.albedo = glm::vec3(0.0f);
    }
    shape.name = importer.nameOf(primitive);
    importer.scene.shapes.push_back(std::move(shape));
}

}  // namespace kaustik::scene
