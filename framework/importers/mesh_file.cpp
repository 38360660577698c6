// SPDX-License-Identifier: MIT
#include "framework/importers/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_inverse.hpp>
#include <limits>
#include <utility>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/importers/mesh_file_checks.h"
#include "framework/importers/polygon.h"
#include "framework/importers/triangle_soup.h"

// After the project's own headers: Assimp's define macros of common names.
#include <assimp/scene.h>

namespace kaustik::scene {
namespace {

glm::dmat4 fromAssimp(const aiMatrix4x4& m) {
    return glm::transpose(glm::dmat4(m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2,
                                     m.c3, m.c4, m.d1, m.d2, m.d3, m.d4));
}

glm::dvec3 fromAssimp(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

// Gathers all meshes below a node into one soup.
class Flattener {
  public:
    Flattener(const aiScene& scene, bool trustNormals, const std::string& name)
        : scene_(scene), trustNormals_(trustNormals), name_(name) {}

    // Polygons whose triangles may overlap, after run().
    [[nodiscard]] std::size_t crossingPolygons() const { return crossingPolygons_; }

    TriangleSoup run() {
        node(*scene_.mRootNode, glm::dmat4(1.0));
        return std::move(soup_);
    }

  private:
    void node(const aiNode& node, const glm::dmat4& parentToMesh) {
        const glm::dmat4 toMesh = parentToMesh * fromAssimp(node.mTransformation);
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            append(*scene_.mMeshes[node.mMeshes[i]], toMesh);
        }
        for (unsigned i = 0; i < node.mNumChildren; ++i)
            this->node(*node.mChildren[i], toMesh);
    }

    void append(const aiMesh& mesh, const glm::dmat4& toMesh) {
        const std::size_t first = soup_.positions.size();
        if (first + mesh.mNumVertices > std::numeric_limits<std::uint32_t>::max()) {
            throw IoError(fmt::format("{}: the mesh has more than 2^32 vertices.", name_));
        }
        const glm::dmat3 linear(toMesh);
        // A mirrored node turns its faces inside out; turned back, they agree with the normals.
        const bool mirrored = glm::determinant(linear) < 0.0;
        const glm::dmat3 normalToMesh = glm::inverseTranspose(linear);
        for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
            soup_.positions.push_back(
                glm::dvec3(toMesh * glm::dvec4(fromAssimp(mesh.mVertices[i]), 1.0)));
            soup_.normals.push_back(mesh.HasNormals() && trustNormals_
                                        ? glm::vec3(normalToMesh * fromAssimp(mesh.mNormals[i]))
                                        : glm::vec3(0.0f));
            soup_.uvs.push_back(mesh.HasTextureCoords(0) ? glm::vec2(mesh.mTextureCoords[0][i].x,
                                                                     mesh.mTextureCoords[0][i].y)
                                                         : glm::vec2(0.0f));
        }
        for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
            if (mesh.mFaces[i].mNumIndices < 3) continue;  // points and lines
            appendPolygon(mesh.mFaces[i], mesh.mNumVertices, static_cast<std::uint32_t>(first),
                          mirrored);
        }
    }

    void appendPolygon(const aiFace& face, unsigned vertexCount, std::uint32_t first,
                       bool mirrored) {
        vertices_.clear();
        corners_.clear();
        for (unsigned corner = 0; corner < face.mNumIndices; ++corner) {
            const unsigned index = face.mIndices[corner];
            if (index >= vertexCount) {
                throw IoError(fmt::format("{}: a face uses vertex {}, but there are only {}.",
                                          name_, index, vertexCount));
            }
            vertices_.push_back(first + index);
            corners_.push_back(soup_.positions[vertices_.back()]);
        }
        if (vertices_.size() == 3) return appendTriangle({0, 1, 2}, mirrored);
        const CutPolygon cut = cutPolygon(corners_);
        if (!cut.isSimple) ++crossingPolygons_;
        for (const glm::uvec3& triangle : cut.triangles)
            appendTriangle(triangle, mirrored);
    }

    // `corners` of the polygon at hand.
    void appendTriangle(const glm::uvec3& corners, bool mirrored) {
        glm::uvec3 triangle(vertices_[corners.x], vertices_[corners.y], vertices_[corners.z]);
        if (mirrored) std::swap(triangle.x, triangle.z);
        soup_.triangles.push_back(triangle);
    }

    const aiScene& scene_;
    bool trustNormals_;
    const std::string& name_;
    TriangleSoup soup_;
    std::vector<std::uint32_t> vertices_;  // of the polygon at hand
    std::vector<glm::dvec3> corners_;
    std::size_t crossingPolygons_ = 0;
};

// A polygon of n corners counts as n - 2 triangles.
std::size_t countTriangles(const aiScene& scene) {
    std::size_t count = 0;
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
        for (unsigned j = 0; j < scene.mMeshes[i]->mNumFaces; ++j) {
            const unsigned corners = scene.mMeshes[i]->mFaces[j].mNumIndices;
            if (corners >= 3) count += corners - 2;
        }
    }
    return count;
}

// The bytes of the mesh, what kind they are, and the name of the mesh.
struct MeshFile {
    std::string bytes;
    std::string extension;  // without the dot, in small letters
    std::string meshName;
};

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

MeshFile openMeshFile(const std::filesystem::path& path) {
    std::filesystem::path inner = path.filename();
    const bool zipped = lowerCase(inner.extension().string()) == ".gz";
    if (zipped) inner = inner.stem();
    MeshFile file;
    const std::string extension = lowerCase(inner.extension().string());
    if (extension != ".obj" && extension != ".ply" && extension != ".3ds") {
        throw ConfigError(
            fmt::format("{} is no mesh file that can be read: use .obj, .ply, .ply.gz "
                        "or .3ds (for .gltf and .glb, name the file as the scene).",
                        path.string()));
    }
    file.extension = extension.substr(1);
    file.meshName = inner.stem().string();
    file.bytes = readFile(path);
    if (zipped) file.bytes = gunzip(file.bytes, path.string());
    return file;
}

MeshFileContents checkStructure(const MeshFile& file, const std::string& name) {
    if (file.extension == "obj") return checkObj(file.bytes, name);
    if (file.extension == "ply") return checkPly(file.bytes, name);
    return check3ds(file.bytes, name);
}

}  // namespace

ImportedMesh readMeshFile(const std::filesystem::path& path) {
    const std::string name = path.string();
    MeshFile file = openMeshFile(path);
    MeshFileContents contents = checkStructure(file, name);
    if (contents.triangles == 0) {
        throw IoError(fmt::format("{}: the file has no faces, so that it makes no mesh.", name));
    }
    if (contents.geometry) file.bytes = std::move(*contents.geometry);
    Assimp::Importer importer;
    // Nothing after the reading is left to Assimp. It joins vertices within an absolute distance of
    // 1e-5, which bends a mesh that is measured in metres but a millimetre large; and it cuts
    // polygons in a time that grows with the square of their corners, and gives up the process for
    // one without any.
    const aiScene* const scene = importer.ReadFileFromMemory(file.bytes.data(), file.bytes.size(),
                                                             0, file.extension.c_str());
    if (scene == nullptr || scene->mRootNode == nullptr) {
        throw IoError(fmt::format("{} cannot be read as a mesh: {}. Fetch or export it again.",
                                  name, importer.GetErrorString()));
    }
    const std::size_t found = countTriangles(*scene);
    if (contents.triangles != found) {
        throw IoError(
            fmt::format("{} declares {} triangles, but {} can be read. Export it again, "
                        "with triangles only.",
                        name, contents.triangles, found));
    }
    Flattener flattener(*scene, contents.trustNormals, name);
    const TriangleSoup soup = flattener.run();
    BuiltMesh built = buildMesh(soup, file.meshName, name);

    ImportedMesh imported{std::move(built.mesh), contents.warnings};
    if (soup.triangles.size() < found) {
        imported.warnings.push_back(
            fmt::format("{}: {} triangles are missing, because no node of the file uses them.",
                        name, found - soup.triangles.size()));
    }
    if (flattener.crossingPolygons() > 0) {
        imported.warnings.push_back(
            fmt::format("{}: {} polygons cross themselves, so that their triangles may overlap.",
                        name, flattener.crossingPolygons()));
    }
    if (built.degenerateCount > 0) {
        imported.warnings.push_back(fmt::format("{}: {} triangles without an area were dropped.",
                                                name, built.degenerateCount));
    }
    if (imported.mesh.closed && signedVolumeTimesSix(imported.mesh) < 0.0) {
        imported.warnings.push_back(fmt::format(
            "{}: the mesh is inside out (its faces are clockwise seen from outside).", name));
    }
    return imported;
}

}  // namespace kaustik::scene
