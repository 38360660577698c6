// SPDX-License-Identifier: MIT
// What all formats share: a scene taken apart into what each of them can hold, its files, and notes
// about the rest.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/exporters/export.h"
#include "framework/image/image.h"

namespace kaustik::exporters {

// A mesh where it lies in the world, m. uv is multiplied by its material's uv_scale, so that
// pictures repeat each unit; (0, 0) is a picture's lower left.
struct WorldMesh {
    std::string name;        // the object's
    std::string identifier;  // letters, digits and underscores; of its own in the scene
    std::uint32_t material = 0;
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec3> normals;  // unit
    std::vector<glm::dvec2> uvs;
    std::vector<glm::uvec3> triangles;
};

// What a picture on a surface is in files.
enum class PictureKind { none, checker, file };
struct Picture {
    PictureKind kind = PictureKind::none;
    std::string file;        // relative to the folder; its values are the albedo itself
    bool isSmooth = true;    // bilinear between its texels; else each has an even colour
    double repeatUnits = 1;  // of a WorldMesh's uv that it spans before it repeats
};

// A mesh that has been written as PLY, and what formats with named materials say of it.
struct MeshFile {
    std::string file;                   // relative to the folder
    std::string material;               // its identifier
    bool isEmitter = false;             // counted as a light
    bool hasAbsorbingInterior = false;  // a dielectric that absorbs: medium "inside_<material>"
};

struct Axes {
    glm::dvec3 position{0.0};
    glm::dvec3 right{1.0, 0.0, 0.0};  // unit, as are the others; right-handed with backward
    glm::dvec3 up{0.0, 1.0, 0.0};
    glm::dvec3 forward{0.0, 0.0, -1.0};
    double tangentX = 1.0;  // of half of the field of view
    double tangentY = 1.0;
};

enum class PictureFormat { exr, png };

class Exporter {
  public:
    Exporter(const scene::Scene& scene, const ExportRequest& request);

    const scene::Scene& scene;
    const ExportRequest& request;
    ExportedScene result;

    void leaveOut(const std::string& subject, const std::string& reason);
    void change(const std::string& subject, const std::string& reason);

    // Lights of their own and discs: no points that stand for others, nor copies for bands.
    [[nodiscard]] std::vector<scene::Light> lights() const;
    [[nodiscard]] std::vector<WorldMesh> meshes() const;
    [[nodiscard]] Axes camera() const;
    [[nodiscard]] std::string materialIdentifier(std::uint32_t material) const;
    [[nodiscard]] bool emits(std::uint32_t material) const;
    // Whether an object has this material.
    [[nodiscard]] bool isUsed(std::uint32_t material) const;

    // Writes what a diffuse surface's albedo is, unless it is even. With `hasChecker` a checker
    // becomes no file.
    [[nodiscard]] Picture albedoPicture(std::uint32_t material, PictureFormat format,
                                        bool hasChecker);
    // Writes a normal map, its scale included: components as (1 + x) / 2.
    [[nodiscard]] std::string normalMapFile(std::uint32_t material, PictureFormat format);

    // Writes meshes/<identifier>.ply; `flipsV` as of plyOf().
    [[nodiscard]] MeshFile writeMesh(const WorldMesh& mesh, bool flipsV);

    void write(const std::string& file, const std::string& text);
    // The scene's file, after all others.
    void writeScene(const std::string& file, const std::string& text, const std::string& command);

    // Notes that every format has alike, for what is only in this project's pictures.
    void noteSurroundings();

  private:
    void write(const std::string& file, const Image& image);
    std::vector<std::string> materialIdentifiers_;
};

// A number as short as it can be and still be the same.
[[nodiscard]] std::string text(double number);
[[nodiscard]] std::string text(const glm::dvec3& numbers, const char* between);
// Triangles as binary PLY, with `flipsV` for readers whose pictures begin at the top.
[[nodiscard]] std::string plyOf(const WorldMesh& mesh, bool flipsV);
// (n_d - 1) / (n_F - n_C); nothing where the index is the same for all light.
[[nodiscard]] std::optional<double> abbeNumberOf(const scene::Material& material);

void exportPovray(Exporter& exporter);
void exportMitsuba(Exporter& exporter);
void exportGltf(Exporter& exporter);
void exportPbrt(Exporter& exporter);

}  // namespace kaustik::exporters
