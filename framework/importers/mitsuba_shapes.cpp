// SPDX-License-Identifier: MIT
// Shapes of a Mitsuba scene: as unit shapes (foreign_scene.h) with the matrix that makes theirs.
#include <fmt/format.h>

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <system_error>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/importers/foreign_file.h"
#include "framework/importers/mitsuba_parts.h"

namespace kaustik::scene {
namespace {

// From a plane or disk that faces +y to one that faces +z, with x where it was.
glm::dmat4 facingZ() {
    return glm::rotate(glm::dmat4(1.0), std::acos(0.0), glm::dvec3(1.0, 0.0, 0.0));
}

glm::dmat4 sphereMatrix(const MitsubaElement& element) {
    const glm::dvec3 center = element.point("center", glm::dvec3(0.0));
    const double radius = element.number("radius", 1.0);
    if (!(radius > 0.0)) failAt(element.place, "the radius of a sphere is above 0.");
    return glm::scale(glm::translate(glm::dmat4(1.0), center), glm::dvec3(radius));
}

// Height 1 along y, on the way from p0 to p1.
glm::dmat4 cylinderMatrix(const MitsubaElement& element) {
    const glm::dvec3 from = element.point("p0", glm::dvec3(0.0));
    const glm::dvec3 axis = element.point("p1", glm::dvec3(0.0, 0.0, 1.0)) - from;
    const double radius = element.number("radius", 1.0);
    if (!(radius > 0.0) || !(glm::length(axis) > 0.0))
        failAt(element.place, "a cylinder needs a radius above 0, and p0 and p1 that differ.");
    const glm::dvec3 y = glm::normalize(axis);
    const glm::dvec3 other = std::abs(y.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 z = glm::normalize(glm::cross(other, y));
    return {glm::dvec4(radius * glm::cross(y, z), 0.0), glm::dvec4(axis, 0.0),
            glm::dvec4(radius * z, 0.0), glm::dvec4(from + 0.5 * axis, 1.0)};
}

std::filesystem::path meshFile(const MitsubaImport& importer, const MitsubaElement& element) {
    const MitsubaElement* const name = element.child("filename");
    if (name == nullptr)
        failAt(element.place, fmt::format("{} needs a 'filename'.", element.subject()));
    const std::filesystem::path file = importer.document.file(name->required("value"));
    std::error_code error;
    if (std::filesystem::is_regular_file(file, error)) return file;
    throw IoError(fmt::format("{}: the mesh {} was not found.", name->place, file.string()));
}

void readSerializedShape(MitsubaImport& importer, const MitsubaElement& element,
                         ForeignShape& shape) {
    const std::filesystem::path file = meshFile(importer, element);
    const double index = element.number("shape_index", 0.0);
    if (!(index >= 0.0 && index < 1e6)) failAt(element.place, "a shape_index is not below 0.");
    ImportedMesh imported =
        readSerialized(readFile(file), static_cast<std::size_t>(index), file.string());
    shape.geometry = ForeignGeometry::mesh;
    shape.mesh = std::move(imported.mesh);
    for (const std::string& warning : imported.warnings)
        importer.change(element, warning);
    shape.turnsTexture = true;
}

// False for a type that is none of those that are read.
bool readGeometry(MitsubaImport& importer, const MitsubaElement& element, ForeignShape& shape) {
    const std::string& type = element.type();
    glm::dmat4 local(1.0);
    if (type == "rectangle") {
        shape.geometry = ForeignGeometry::plane;
        local = glm::scale(facingZ(), glm::dvec3(2.0));
    } else if (type == "disk") {
        shape.geometry = ForeignGeometry::disk;
        local = facingZ();
    } else if (type == "cube") {
        shape.geometry = ForeignGeometry::box;
        local = glm::scale(local, glm::dvec3(2.0));
    } else if (type == "sphere") {
        shape.geometry = ForeignGeometry::sphere;
        local = sphereMatrix(element);
    } else if (type == "cylinder") {
        shape.geometry = ForeignGeometry::cylinder;
        local = cylinderMatrix(element);
    } else if (type == "obj" || type == "ply") {
        shape.geometry = ForeignGeometry::meshFile;
        shape.file = meshFile(importer, element);
        shape.turnsTexture = !element.flag("flip_tex_coords", type == "obj");
    } else if (type == "serialized") {
        readSerializedShape(importer, element, shape);
    } else {
        return false;
    }
    shape.toWorld = element.transform("to_world") * local;
    // A transform that mirrors turns the edges of a surface, but not its normal.
    const bool isMirrored = glm::determinant(glm::dmat3(shape.toWorld)) < 0.0;
    shape.isInsideOut = element.flag("flip_normals", false) != isMirrored;
    return true;
}

// What a shape's children are, whether they stand in it or are referred to.
struct ShapeParts {
    const MitsubaElement* bsdf = nullptr;
    const MitsubaElement* emitter = nullptr;
    const MitsubaElement* interior = nullptr;
};

ShapeParts partsOfShape(MitsubaImport& importer, const MitsubaElement& element) {
    ShapeParts parts;
    for (const MitsubaElement& child : element.children) {
        if (child.tag != "ref" && child.tag != "bsdf" && child.tag != "emitter" &&
            child.tag != "medium")
            continue;
        const MitsubaElement& target = importer.document.resolve(child);
        if (target.tag == "bsdf") parts.bsdf = &target;
        if (target.tag == "emitter") parts.emitter = &target;
        // What is outside has the next body around it, or fills the scene.
        if (target.tag == "medium" && child.attribute("name") != "exterior")
            parts.interior = &target;
    }
    return parts;
}

}  // namespace

void readMitsubaShape(MitsubaImport& importer, const MitsubaElement& element) {
    ForeignShape shape;
    shape.place = element.place;
    if (!readGeometry(importer, element, shape)) {
        return importer.leaveOut(element,
                                 fmt::format("shapes of type '{}' are not read", element.type()));
    }
    const ShapeParts parts = partsOfShape(importer, element);
    std::string whyNot;
    const std::optional<std::uint32_t> material =
        parts.bsdf != nullptr ? materialOf(importer, *parts.bsdf, parts.interior, whyNot)
                              : defaultMaterial(importer);
    if (parts.emitter == nullptr && element.flag("flip_normals", false))
        importer.change(element, "its normals are not turned; only a light's are");
    if (parts.emitter != nullptr) {
        if (parts.emitter->type() != "area")
            failAt(parts.emitter->place, "only an area light shines from a shape.");
        shape.emission = ForeignEmission{
            glm::max(evenColor(importer, *parts.emitter, "radiance", glm::dvec3(1.0)), 0.0), false};
    }
    if (!material && parts.interior != nullptr)
        importer.leaveOut(*parts.interior,
                          "a medium in a body without a surface has no counterpart");
    if (!material && !shape.emission) return importer.leaveOut(element, whyNot);
    shape.material = material ? *material : defaultMaterial(importer);
    shape.name = importer.nameOf(element);
    importer.scene.shapes.push_back(std::move(shape));
}

}  // namespace kaustik::scene
