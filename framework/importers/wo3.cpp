// SPDX-License-Identifier: MIT
// Tungsten's own mesh files: a count and vertices (position, normal, uv), a count and triangles
// (three indices and a material, of which nothing is used).
#include "framework/importers/byte_reader.h"
#include "framework/importers/foreign_file.h"
#include "framework/importers/triangle_soup.h"

namespace kaustik::scene {
namespace {

struct Wo3Vertex {
    float position[3];
    float normal[3];
    float uv[2];
};

struct Wo3Triangle {
    std::uint32_t corners[3];
    std::int32_t material;
};

}  // namespace

ImportedMesh readWo3(std::string_view bytes, const std::string& name) {
    ByteReader reader(bytes, name);
    TriangleSoup soup;
    const auto vertexCount = reader.value<std::uint64_t>();
    for (const Wo3Vertex& vertex : reader.values<Wo3Vertex>(vertexCount)) {
        soup.positions.emplace_back(vertex.position[0], vertex.position[1], vertex.position[2]);
        soup.normals.emplace_back(vertex.normal[0], vertex.normal[1], vertex.normal[2]);
        soup.uvs.emplace_back(vertex.uv[0], vertex.uv[1]);
    }
    const auto triangleCount = reader.value<std::uint64_t>();
    for (const Wo3Triangle& triangle : reader.values<Wo3Triangle>(triangleCount)) {
        for (const std::uint32_t corner : triangle.corners) {
            if (corner >= soup.positions.size())
                throw IoError(fmt::format("{}: a triangle uses a vertex that is not there.", name));
        }
        soup.triangles.emplace_back(triangle.corners[0], triangle.corners[1], triangle.corners[2]);
    }
    return buildForeignMesh(soup, name);
}

}  // namespace kaustik::scene
