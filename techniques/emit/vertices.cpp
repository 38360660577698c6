// SPDX-License-Identifier: MIT
// emit.vertices: one photon a vertex of the specular meshes and of wavy water (Shah, Konttinen,
// Pattanaik 2005). It stands for a third of every triangle around the vertex, and carries what
// falls on that: irradiance at the vertex times the area across the light, of triangles that face
// the light on the side that it comes from. Where the only specular object is a sheet with a grid
// of vertices, wavy water say, it stands for a quarter of each cell around it instead, the same at
// every corner, and the list is that grid: cells, beams and extents go along the mesh, so that
// reconstructions can join what neighbouring vertices bring. Both sides of a sheet count; a body is
// hit from within only by a light that is inside of it. Which vertices the light sees first is
// decided by a depth image from the light, by the planes of its texels
// (include/views/light_depth.glsl). A mesh too coarse for its shadows loses or gains light by them:
// emission_sampling of the report. Out: photons that arrive (flux in W) and the hits
// that they make; eye view space, m; cells number the vertices of the specular objects.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/error.h"
#include "framework/core/names.h"
#include "framework/pipeline/frame_builder.h"
#include "framework/scene/light_paths.h"
#include "techniques/emit/vertices_grid.h"
#include "techniques/photon_lists/emitted.h"
#include "techniques/raster_views/light_sight.h"

namespace kaustik {
namespace {

struct VertexEmissionParams {
    int size = 1024;
    template <class R>
    void reflect(R& r) {
        r.field(size, "size",
                "Side of the depth image from each light that says which vertices it sees",
                "texels", params::range(16, 8192));
    }
};

constexpr int kRowLength = 1024;

// From which side of its triangles light hits an object, as emit/vertices.comp has it.
constexpr int kFromOutside = 1;
constexpr int kFromInside = 2;

struct EmittingObject {
    std::uint32_t object = 0;
    bool isHeightField = false;
    std::uint32_t vertices = 0;
    std::uint32_t firstVertex = 0;  // among the static vertices, or those of the height fields
    std::uint32_t firstFan = 0;     // of its vertices, in fanFirsts
    std::uint32_t firstCell = 0;
    std::vector<int> sides;  // by light
};

struct Emission {
    std::vector<EmittingObject> objects;
    std::optional<VertexGrid> grid;  // of the only object
    std::vector<LightSight> lights;
    gl::Buffer vertices;   // VertexData, of what is no height field
    gl::Buffer fans;       // uvec2: the other two corners of each triangle around a vertex
    gl::Buffer fanFirsts;  // uint, by vertex of every mesh and one more each: where its fan begins
    graph::Texture<LightDepth> depths;
};

// Whether a point is inside of a mesh: its triangles then fill the sphere around the point. By the
// solid angle of each (van Oosterom, Strackee 1983).
bool isInside(const scene::Mesh& mesh, const glm::dvec3& point) {
    double solidAngle = 0.0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        const glm::dvec3 a = mesh.origin + glm::dvec3(mesh.positions[triangle.x]) - point;
        const glm::dvec3 b = mesh.origin + glm::dvec3(mesh.positions[triangle.y]) - point;
        const glm::dvec3 c = mesh.origin + glm::dvec3(mesh.positions[triangle.z]) - point;
        const double la = glm::length(a);
        const double lb = glm::length(b);
        const double lc = glm::length(c);
        const double numerator = glm::dot(a, glm::cross(b, c));
        const double denominator =
            la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la;
        const double part = 2.0 * std::atan2(numerator, denominator);
        if (std::isfinite(part)) solidAngle += part;
    }
    return std::abs(solidAngle) > 2.0 * 3.14159265358979323846;
}

int sidesOf(const scene::Scene& scene, const scene::Object& object, const scene::Light& light) {
    if (isOpen(scene, object.material)) return kFromOutside | kFromInside;
    const bool isDielectric =
        scene.materials[object.material].kind == scene::MaterialKind::dielectric;
    if (!isDielectric || light.kind == scene::LightKind::directional) return kFromOutside;
    const glm::dvec3 position(glm::inverse(object.toWorld) * glm::dvec4(light.position, 1.0));
    return isInside(scene.meshes[object.mesh], position) ? kFromInside : kFromOutside;
}

// The triangles around each vertex, after those of other meshes.
void addFans(const scene::Mesh& mesh, std::vector<glm::uvec2>& fans,
             std::vector<std::uint32_t>& firsts) {
    std::vector<std::uint32_t> count(mesh.positions.size() + 1, 0);
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i)
            ++count[triangle[i] + 1];
    }
    count[0] = static_cast<std::uint32_t>(fans.size());
    for (std::size_t v = 1; v < count.size(); ++v)
        count[v] += count[v - 1];
    firsts.insert(firsts.end(), count.begin(), count.end());
    fans.resize(count.back());
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i)
            fans[count[triangle[i]]++] = {triangle[(i + 1) % 3], triangle[(i + 2) % 3]};
    }
}

// Of a grid: each cell around a vertex as two triangles that both begin at the vertex. Together
// they have the area of the mesh's own, whichever way that splits the cell.
void addFans(const VertexGrid& grid, std::vector<glm::uvec2>& fans,
             std::vector<std::uint32_t>& firsts) {
    const int columns = grid.vertices.width;
    const int rows = grid.vertices.height;
    const auto vertexAt = [&](const glm::ivec2& at) {
        return static_cast<std::uint32_t>(at.y * columns + at.x);
    };
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            firsts.push_back(static_cast<std::uint32_t>(fans.size()));
            // Of a cell: the corner along the row, the one across and the one in the next row.
            for (const glm::ivec2& side : {glm::ivec2(1, 1), {-1, 1}, {-1, -1}, {1, -1}}) {
                const glm::ivec2 across = glm::ivec2(i, j) + side;
                if (across.x < 0 || across.x >= columns || across.y < 0 || across.y >= rows)
                    continue;
                glm::uvec3 others(vertexAt({across.x, j}), vertexAt(across),
                                  vertexAt({i, across.y}));
                if ((side.x * side.y < 0) != grid.isTurned) std::swap(others.x, others.z);
                fans.emplace_back(others.x, others.y);
                fans.emplace_back(others.y, others.z);
            }
        }
    }
    firsts.push_back(static_cast<std::uint32_t>(fans.size()));
}

void addObjects(const FrameBuilder& frame, Emission& emission) {
    const scene::Scene& scene = frame.scene();
    struct MeshRange {
        bool isThere = false;
        std::uint32_t firstVertex = 0;
        std::uint32_t firstFan = 0;
    };
    std::vector<MeshRange> ranges(scene.meshes.size());
    for (const render::GpuScene::HeightFieldRange& field : frame.gpuScene().heightFields())
        ranges[field.mesh].firstVertex = static_cast<std::uint32_t>(field.firstVertex);
    std::vector<transport::VertexData> vertices;
    std::vector<glm::uvec2> fans;
    std::vector<std::uint32_t> firsts;
    std::uint32_t cells = 0;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const scene::Object& object = scene.objects[i];
        if (!isSpecular(scene, object)) continue;
        const scene::Mesh& mesh = scene.meshes[object.mesh];
        MeshRange& range = ranges[object.mesh];
        if (!range.isThere) {
            range.isThere = true;
            range.firstFan = static_cast<std::uint32_t>(firsts.size());
            if (emission.grid) {
                addFans(*emission.grid, fans, firsts);
            } else {
                addFans(mesh, fans, firsts);
            }
            if (!mesh.heightField) {
                range.firstVertex = static_cast<std::uint32_t>(vertices.size());
                for (std::size_t v = 0; v < mesh.positions.size(); ++v)
                    vertices.push_back({mesh.positions[v], 0.0f, mesh.normals[v], 0.0f});
            }
        }
        const auto count = static_cast<std::uint32_t>(mesh.positions.size());
        EmittingObject emitting{static_cast<std::uint32_t>(i),
                                mesh.heightField.has_value(),
                                count,
                                range.firstVertex,
                                range.firstFan,
                                cells,
                                {}};
        for (const scene::Light& light : scene.lights)
            emitting.sides.push_back(sidesOf(scene, object, light));
        emission.objects.push_back(std::move(emitting));
        cells += count;
    }
    vertices.push_back({});  // blocks are never empty
    fans.emplace_back(0u);
    firsts.push_back(0);
    emission.vertices = gl::Buffer(vertices, "specular vertices");
    emission.fans = gl::Buffer(fans, "specular fans");
    emission.fanFirsts = gl::Buffer(firsts, "specular fan firsts");
}

void warnOfNoGrid(FrameBuilder& frame) {
    std::vector<std::string> names;
    for (const scene::Object& object : frame.scene().objects) {
        if (isSpecular(frame.scene(), object)) names.push_back("'" + object.name + "'");
    }
    frame.warn(fmt::format(
        "reconstruct={} joins nothing: emit=vertices has neighbours where the only specular object "
        "is a sheet with a grid of vertices; here {} {} specular.",
        frame.inputs().params.choice(ReconstructStage::name), joinNames(names),
        names.size() == 1 ? "is" : "are"));
}

// Of the first batch; the others share it.
std::shared_ptr<Emission> makeEmission(FrameBuilder& frame, const VertexEmissionParams& params,
                                       const Geometry& geometry) {
    auto emission = std::make_shared<Emission>();
    emission->grid = specularGrid(frame.scene());
    addObjects(frame, *emission);
    if (!emission->grid && !emission->objects.empty() && frame.joinsCells()) warnOfNoGrid(frame);
    emission->lights = sightsOfSpecular(frame);
    emission->depths =
        drawLightDepths(
            frame,
            {"emit.light_depths", "a light emits only where it is the first surface that it sees",
             "emit.light_depths", "emit.light_depth_buffer"},
            emission->lights, params.size, geometry)
            .map;
    return emission;
}

// Rows and columns of one light's photons.
params::Extent verticesOfALight(const FrameBuilder& frame) {
    if (const std::optional<VertexGrid> grid = specularGrid(frame.scene())) return grid->vertices;
    std::size_t count = 0;
    for (const scene::Object& object : frame.scene().objects) {
        if (isSpecular(frame.scene(), object))
            count += frame.scene().meshes[object.mesh].positions.size();
    }
    const int photons = std::max(static_cast<int>(count), 1);
    const int width = std::min(photons, kRowLength);
    return {width, (photons + width - 1) / width};
}

struct VertexEmission {
    Hits hits;
    Geometry geometry;
};

// `part`: which outputs are written, as emit/vertices.comp has it.
void emitObject(const FrameInputs& inputs, gl::PassContext& context, const VertexEmission& data,
                const Emission& emission, const CellGrid& rows, const Samples& samples, int light,
                const EmittingObject& emitting, const std::string& part) {
    const auto number = static_cast<std::size_t>(light);
    const LightSight& sight = emission.lights[number % emission.lights.size()];
    const Photons& photons = data.hits.incoming;
    gl::Command command = context.compute("emit/vertices.comp");
    if (!part.empty()) command.define(part);
    if (emission.grid) {
        command.define("VERTEX_GRID")
            .set("gridSize",
                 glm::ivec2(emission.grid->vertices.width, emission.grid->vertices.height));
        if (!part.empty()) command.image("nextExtents", photons.extents);
    }
    if (emitting.isHeightField) {
        command.storage("MeshVertices", data.geometry.heightFields);
    } else {
        command.storage("MeshVertices", emission.vertices);
    }
    command.storage("Instances", inputs.instances.instances)
        .storage("Fans", emission.fans)
        .storage("FanFirsts", emission.fanFirsts)
        .set("projection", sight.view.projection())
        .set("eyeToLight", render::between(inputs.view, sight.view))
        .set("lightIndex", light)
        .set("object", emitting.object)
        .set("sides", emitting.sides[number])
        .set("vertexCount", emitting.vertices)
        .set("firstVertex", emitting.firstVertex)
        .set("firstFan", emitting.firstFan)
        .set("firstCell", emitting.firstCell)
        .set("batchCells", rows.rows * rows.width)
        .set("firstOfBatch", rows.firstRow * rows.width)
        .set("ownCells", rows.width * glm::ivec2(rows.firstOwn, rows.endOwn))
        .set("firstOfLight", (light - samples.firstLight) * rows.rows * rows.width)
        .dispatchOver(static_cast<int>(emitting.vertices), 64);
}

Hits emitVertices(FrameBuilder& frame, const VertexEmissionParams& params, Surfaces surfaces,
                  Samples samples) {
    const params::Extent all = verticesOfALight(frame);
    const auto emission = frame.once<Emission>(
        "emit.vertices", [&] { return makeEmission(frame, params, surfaces.geometry); });
    if (scene::hasNormalMaps(frame.scene())) {
        throw ConfigError(
            "emit=vertices sends light on from the meshes' vertices, between which a normal map "
            "turns the surface unseen; take emit=grid or emit=deferred.");
    }
    const bool isGrid = emission->grid.has_value();
    // Vertices that lie in no grid are nobody's neighbours.
    if (!isGrid) samples.borderRows = 0;
    const CellGrid rows = cellsOf(samples, all);
    std::size_t vertices = 0;
    for (const EmittingObject& emitting : emission->objects)
        vertices += emitting.vertices;
    return frame
        .pass<VertexEmission>(
            "emit.vertices",
            fmt::format("{} vertices{}, {} light{}", vertices,
                        isGrid ? fmt::format(" in a grid of {}x{}", all.width, all.height) : "",
                        emission->lights.size(), emission->lights.size() == 1 ? "" : "s"),
            [&](graph::PassSetup& setup, VertexEmission& data) {
                data.geometry = surfaces.geometry;
                if (data.geometry.heightFields.valid()) setup.read(data.geometry.heightFields);
                setup.sample("lightDepths", emission->depths);
                const int height = rows.rows * samples.lights;
                Photons photons =
                    Photons::create(setup, rows.width, height, samples.suffix, {frame.usesBeams()});
                if (isGrid) photons.cells = rows;
                if (isGrid && photons.hasBeams()) {
                    photons.extents = setup.create<CellExtentTexel>(
                        "photons.extents" + samples.suffix, rows.width, height);
                }
                data.hits = storeEmitted(setup, photons, samples);
            },
            [&inputs = frame.inputs(), emission, rows, samples](const VertexEmission& data,
                                                                gl::PassContext& context) {
                const Photons& photons = data.hits.incoming;
                beginEmission(context, photons, samples);
                // Vertices that the light does not see are no photons.
                clearEmitted(context, data.hits);
                const int end = emission->lights.empty() ? 0 : samples.firstLight + samples.lights;
                for (int light = samples.firstLight; light < end; ++light) {
                    for (const EmittingObject& emitting : emission->objects) {
                        emitObject(inputs, context, data, *emission, rows, samples, light, emitting,
                                   "");
                        if (!photons.hasBeams()) continue;
                        emitObject(inputs, context, data, *emission, rows, samples, light, emitting,
                                   "ONLY_BEAMS");
                    }
                }
            })
        .hits;
}

}  // namespace

void registerEmitVertices(Registry& registry) {
    registry.node<EmitStage>(
        "vertices",
        {"One photon a vertex of the specular surfaces, with the "
         "light that falls on the area around it.",
         "Shah, Konttinen, Pattanaik (SP05)",
         "Light is as fine as the mesh: a vertex is lit or not, so that shadows end between "
         "vertices, and what a fine part of a body or a shadow takes is emitted or not "
         "(emission_sampling). Photons have neighbours only where a sheet with a grid of vertices "
         "is the only "
         "specular object."},
        {.beams = true, .photons = &verticesOfALight, .takes = "takes one photon a vertex"},
        &emitVertices);
}

}  // namespace kaustik
