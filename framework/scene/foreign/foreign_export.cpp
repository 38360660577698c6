// SPDX-License-Identifier: MIT
#include "framework/scene/foreign/foreign_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/scene/foreign/foreign_area_light.h"
#include "framework/scene/foreign/foreign_files.h"
#include "framework/scene/foreign/foreign_toml.h"

namespace kaustik::scene {
namespace {
namespace fs = std::filesystem;

constexpr double kGrey = 0.5;

class Exporter {
  public:
    Exporter(const ForeignScene& scene, const ExportOptions& options,
             reading::ReaderProcess& reader)
        : scene_(scene),
          options_(options),
          reader_(reader),
          files_(options.out),
          known_(scene.materials) {
        result_.notes = scene.notes;
    }

    ExportedScene run() {
        requireTextures();
        writeSurrounding();
        for (const Light& light : scene_.lights)
            addLight(light);
        for (const ForeignShape& shape : scene_.shapes)
            addObject(shape);
        for (std::size_t i = 0; i < known_.size(); ++i)
            writeUsedMaterial(i);
        if (result_.lightCount == 0)
            note(NoteKind::changed, "scene", "", "it has no light that shines here");
        if (!scene_.camera)
            note(NoteKind::changed, "scene", "",
                 "it has no camera that is read; it is the default");
        result_.fileCount = files_.count();
        result_.fileFolder = files_.folder();
        result_.runCommand = fmt::format("kaustik run {}{}", options_.out.string(), sizeOption());
        writeFileWhole(options_.out,
                       head() + top_.text() + lights_.text() + materials_.text() + objects_.text());
        return result_;
    }

  private:
    void note(NoteKind kind, const std::string& subject, const std::string& place,
              const std::string& reason) {
        result_.notes.push_back({kind, subject, fs::path(place).filename().string(), reason});
    }

    static bool isThere(const ForeignImage& image) {
        std::error_code error;
        return fs::is_regular_file(image.file, error);
    }

    // Before anything is written.
    void requireTextures() const {
        if (options_.isGreyWithoutFile) return;
        const auto require = [](const std::optional<ForeignImage>& image) {
            if (!image || isThere(*image)) return;
            throw IoError(
                fmt::format("{}: the texture {} was not found; put it there, or take "
                            "grey with --missing-textures grey.",
                            image->place, image->file.string()));
        };
        require(scene_.environment);
        for (const ForeignShape& shape : scene_.shapes) {
            require(scene_.materials[shape.material].image);
            require(scene_.materials[shape.material].normalMap);
        }
    }

    // The name of the picture in the scene file; "" where it is not there and is grey.
    std::string pictureOf(const ForeignImage& image) {
        if (isThere(image)) return files_.picture(image.file, image.place);
        note(NoteKind::leftOut, fmt::format("texture '{}'", image.file.filename().string()),
             image.place, "the file is not there; it is grey");
        return "";
    }

    void writeSurrounding() {
        top_.set("name", scene_.name);
        glm::dvec3 radiance = scene_.backgroundRadiance;
        const bool isSeen = std::max({radiance.r, radiance.g, radiance.b}) > 0.0;
        const std::string picture =
            scene_.environment && isSeen ? pictureOf(*scene_.environment) : "";
        if (scene_.environment && picture.empty()) radiance *= kGrey;
        if (isSeen) top_.setColor("background_radiance", radiance);
        if (scene_.camera) writeCamera(top_, *scene_.camera);
        if (scene_.medium) writeMedium(top_, *scene_.medium);
        if (!isSeen) return;
        top_.table("[environment]");
        if (!picture.empty()) {
            top_.set("image", picture);
            top_.set("turn_degrees", scene_.environmentTurnDegrees);
        }
        top_.set("lights", true);
        ++result_.lightCount;
    }

    void addLight(const Light& light) {
        writeLight(lights_, light, takeName(light.name, lightNames_));
        ++result_.lightCount;
    }

    // A material of its own for a shape that emits: it is a lamp.
    std::uint32_t lampOf(const ForeignShape& shape) {
        ForeignMaterial lamp = known_[shape.material];
        if (!isReceiver(lamp.material.kind)) {
            note(NoteKind::changed, fmt::format("light '{}'", shape.name), shape.place,
                 "what glass or a mirror emits, comes from a black surface");
            lamp = {};
            lamp.material.albedo = glm::vec3(0.0f);
        }
        lamp.material.name = shape.name;
        lamp.material.emission = glm::vec3(areaLightOf(shape, reader_).radiance);
        known_.push_back(std::move(lamp));
        ++result_.lightCount;
        return static_cast<std::uint32_t>(known_.size() - 1);
    }

    void addObject(ForeignShape shape) {
        if (shape.emission) shape.material = lampOf(shape);
        const ForeignMaterial& material = known_[shape.material];
        const bool isFlat =
            shape.geometry == ForeignGeometry::plane || shape.geometry == ForeignGeometry::disk;
        if (isFlat) {
            if (isTurned(shape)) shape.toWorld[2] = -shape.toWorld[2];
            setNormal(shape.toWorld);
        }
        shape.turnsTexture = shape.turnsTexture != material.turnsTexture;
        const bool hasOwnUv = shape.geometry == ForeignGeometry::plane ||
                              shape.geometry == ForeignGeometry::meshFile ||
                              shape.geometry == ForeignGeometry::mesh;
        if (!hasOwnUv && isTextured(material)) {
            note(NoteKind::changed, fmt::format("shape '{}'", shape.name), shape.place,
                 "its texture lies on it in another way");
        }
        const std::string name = takeName(shape.name, objectNames_);
        objects_.table("[[object]]");
        objects_.set("name", name);
        objects_.set("material", materialName(shape.material));
        ++result_.objectCount;
        const std::optional<Placement> placement = placementOf(shape.toWorld);
        if (placement && !mustBake(shape, material, *placement)) {
            if (shape.geometry == ForeignGeometry::meshFile)
                return writeMesh(objects_, files_.mesh(shape.file, reader_), *placement);
            return writeShape(objects_, shape, *placement);
        }
        WorldMesh mesh = worldMeshOf(shape, reader_);
        if (isTurned(shape) && !isFlat) turn(mesh);
        const glm::dvec3 origin = roundMiddle(mesh);
        Placement there;
        there.position = origin;
        writeMesh(objects_, files_.baked(name, mesh, origin), there);
    }

    // What a lamp shines from is its front.
    static bool isTurned(const ForeignShape& shape) { return shape.emission && shape.isInsideOut; }
    static void turn(WorldMesh& mesh) {
        for (glm::vec3& normal : mesh.normals)
            normal = -normal;
        for (glm::uvec3& triangle : mesh.triangles)
            std::swap(triangle.y, triangle.z);
    }

    // A flat shape has no thickness that a transform could scale to nothing or shear.
    static void setNormal(glm::dmat4& toWorld) {
        const glm::dvec3 normal = glm::cross(glm::dvec3(toWorld[2]), glm::dvec3(toWorld[0]));
        const double length = glm::length(normal);
        if (length > 0.0) toWorld[1] = glm::dvec4(normal / length, 0.0);
    }

    static bool isTextured(const ForeignMaterial& foreign) {
        return foreign.image || foreign.normalMap || foreign.material.pattern != Pattern::none;
    }

    static bool mustBake(const ForeignShape& shape, const ForeignMaterial& foreign,
                         const Placement& placement) {
        switch (shape.geometry) {
            case ForeignGeometry::mesh:
                return true;
            case ForeignGeometry::disk:
                return isTextured(foreign) || !isEven(placement.scale.x, placement.scale.z);
            case ForeignGeometry::meshFile:
                return isTurned(shape) || placement.isMirrored ||
                       (isTextured(foreign) && shape.turnsTexture);
            case ForeignGeometry::plane:
                return isTextured(foreign);
            case ForeignGeometry::box:
                // A scene file counts the repeats of its shapes by the metre.
                return isTextured(foreign) || isTurned(shape);
            case ForeignGeometry::sphere:
            case ForeignGeometry::cylinder:
                return isTurned(shape);
        }
        return false;
    }

    // Those of objects alone are written.
    std::string materialName(std::size_t index) {
        const auto found = materialNames_.find(index);
        if (found != materialNames_.end()) return found->second;
        return materialNames_[index] = takeName(known_[index].material.name, takenMaterialNames_);
    }

    void writeUsedMaterial(std::size_t index) {
        const auto name = materialNames_.find(index);
        if (name == materialNames_.end()) return;
        const ForeignMaterial& foreign = known_[index];
        Material material = foreign.material;
        std::string texture;
        if (foreign.image) {
            texture = pictureOf(*foreign.image);
            if (texture.empty()) material.albedo *= static_cast<float>(kGrey);
        }
        std::string normals;
        if (foreign.normalMap && isThere(*foreign.normalMap)) {
            normals = files_.picture(foreign.normalMap->file, foreign.normalMap->place);
        } else if (foreign.normalMap) {
            note(NoteKind::leftOut,
                 fmt::format("texture '{}'", foreign.normalMap->file.filename().string()),
                 foreign.normalMap->place, "the file is not there; the surface is smooth");
        }
        writeMaterial(materials_, material, name->second, {texture, normals});
    }

    [[nodiscard]] std::string head() const {
        TomlLines lines;
        lines.comment(fmt::format("Made of {} ({}) by 'kaustik import'. To render it:",
                                  options_.source.filename().string(), scene_.format));
        lines.comment("    " + fmt::format("kaustik run {}{}", options_.out.filename().string(),
                                           sizeOption()));
        for (const ForeignNote& entry : result_.notes)
            lines.comment(sentenceOf(entry));
        return lines.text();
    }

    [[nodiscard]] std::string sizeOption() const {
        return scene_.width > 0 ? fmt::format(" --size {}x{}", scene_.width, scene_.height) : "";
    }

    const ForeignScene& scene_;
    const ExportOptions& options_;
    reading::ReaderProcess& reader_;
    ForeignFiles files_;
    std::vector<ForeignMaterial> known_;  // the scene's, and those of lamps
    ExportedScene result_;
    TomlLines top_;
    TomlLines lights_;
    TomlLines materials_;
    TomlLines objects_;
    std::set<std::string> lightNames_;
    std::set<std::string> objectNames_;
    std::set<std::string> takenMaterialNames_;
    std::map<std::size_t, std::string> materialNames_;
};

}  // namespace

std::string sentenceOf(const ForeignNote& note) {
    return oneLine(fmt::format(
        "{}: {}{}: {}.", note.kind == NoteKind::leftOut ? "left out" : "changed", note.subject,
        note.place.empty() ? "" : fmt::format(" ({})", note.place), note.reason));
}

ExportedScene exportForeignScene(const ForeignScene& scene, const ExportOptions& options,
                                 reading::ReaderProcess& reader) {
    return Exporter(scene, options, reader).run();
}

}  // namespace kaustik::scene
