// SPDX-License-Identifier: MIT
// What the import makes of the geometry: origin, welding, normals, degenerate triangles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "framework/importers/triangle_soup.h"
#include "framework/scene/meshes/mesh_checks.h"
#include "tests/unit/importers/mesh_file_fixture.h"

namespace kaustik::scene::test {
namespace {

using ::testing::HasSubstr;

// A cube from 0 to 1, corner i at the bits of i, as quads seen from outside.
const std::string kCubeVertices =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n";
const std::string kCubeFaces = "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

TEST_F(MeshImport, PolygonsAreCutIntoTriangles) {
    const Mesh mesh = import("cube.obj", kCubeVertices + kCubeFaces).mesh;
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_TRUE(mesh.closed);
    EXPECT_DOUBLE_EQ(signedVolumeTimesSix(mesh), 6.0);
}

TEST_F(MeshImport, SmoothNormalsOfACubePointAlongItsDiagonalsHoweverItIsCut) {
    // The quads' diagonals give some corners two triangles of a face and others one. Weighted by
    // the angle, each face counts 90 degrees: the mean is exactly the diagonal.
    const Mesh mesh = import("cube.obj", kCubeVertices + kCubeFaces).mesh;
    ASSERT_EQ(mesh.positions.size(), 8u);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 diagonal = glm::normalize(mesh.positions[i]);
        // A few units in the last place of a 32-bit float.
        EXPECT_LT(glm::length(mesh.normals[i] - diagonal), 5e-7f) << i;
    }
}

TEST_F(MeshImport, NormalsAreSmoothAcrossASeamInTheUvs) {
    // Two triangles at a right angle share an edge, but not its uvs.
    const Mesh mesh = import("seam.obj",
                             "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\n"
                             "vt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 2/2 1/2 4/2\n")
                          .mesh;
    ASSERT_EQ(mesh.positions.size(), 6u);
    // At (0,0,0) both corners have 90 degrees; the faces look along +y and +x.
    const glm::vec3 expected = glm::normalize(glm::vec3(1, 1, 0));
    int found = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (glm::dvec3(mesh.positions[i]) + mesh.origin != glm::dvec3(0.0)) continue;
        EXPECT_LT(glm::length(mesh.normals[i] - expected), 1e-6f);
        ++found;
    }
    EXPECT_EQ(found, 2);
}

TEST_F(MeshImport, TheFilesNormalsAreKeptAndMadeUnit) {
    const Mesh mesh =
        import("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 3 4\nf 1//1 2//1 3//1\n").mesh;
    for (const glm::vec3& normal : mesh.normals) {
        EXPECT_LT(glm::length(normal - glm::vec3(0.0f, 0.6f, 0.8f)), 1e-6f);
    }
}

TEST_F(MeshImport, NormalsThatAreZeroOrNotANumberAreMadeFromTheFaces) {
    for (const char* bad : {"0 0 0", "nan nan nan"}) {
        const Mesh mesh = import("a.obj", std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn ") + bad +
                                              "\nvn 0 1 0\nf 1//1 2//1 3//2\n")
                              .mesh;
        ASSERT_EQ(mesh.normals.size(), 3u) << bad;
        EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1)) << bad;
        EXPECT_EQ(mesh.normals[2], glm::vec3(0, 1, 0)) << bad;
    }
}

TEST_F(MeshImport, TriangleCornersThatAreTheSameVertexAreJoined) {
    // A PLY that repeats every corner, as scanners' files do.
    std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 12\nproperty float x\nproperty float y\n"
        "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
    for (const int corner : kFaces) {
        const auto at = static_cast<std::size_t>(3 * corner);
        ply += std::to_string(kCorners[at]) + " " + std::to_string(kCorners[at + 1]) + " " +
               std::to_string(kCorners[at + 2]) + "\n";
    }
    ply += "3 0 1 2\n3 3 4 5\n3 6 7 8\n3 9 10 11\n";
    const Mesh mesh = import("a.ply", ply).mesh;
    EXPECT_EQ(mesh.positions.size(), 4u);
    EXPECT_TRUE(mesh.closed);
}

TEST_F(MeshImport, NeighboursAMicrometreApartStayApart) {
    const Mesh mesh = import("tiny.obj",
                             "v 0 0 0\nv 1e-6 0 0\nv 0 2e-6 0\nv 0 0 3e-6\n"
                             "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
                          .mesh;
    EXPECT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.triangles.size(), 4u);
    EXPECT_TRUE(mesh.closed);
}

TEST_F(MeshImport, AMeshFarFromTheOriginKeepsTheShapeThatItsNumbersGive) {
    // At 65536 a 32-bit float steps by 1/128: these coordinates are exact, and so is the shape.
    const Mesh mesh =
        import("far.obj", "v 65536 0 0\nv 65536.0078125 0 0\nv 65536 0.0078125 0\nf 1 2 3\n").mesh;
    EXPECT_EQ(mesh.origin.x, 65536.00390625);
    EXPECT_EQ(mesh.positions[0].x, -0.00390625f);
    EXPECT_EQ(mesh.positions[1].x, 0.00390625f);
}

TEST_F(MeshImport, TrianglesWithoutAnAreaAreDroppedAndCounted) {
    const auto imported = import("a.obj",
                                 "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\n"
                                 "f 1 2 3\nf 1 2 2\nf 1 2 4\n");
    EXPECT_EQ(imported.mesh.triangles.size(), 1u);
    EXPECT_EQ(imported.mesh.positions.size(), 3u);
    ASSERT_EQ(imported.warnings.size(), 1u);
    EXPECT_THAT(imported.warnings.front(), HasSubstr("2 triangles without an area"));
    EXPECT_THAT(errorOf("b.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"),
                HasSubstr("no triangles that have an area"));
}

TEST_F(MeshImport, ASliverThatFillsATJunctionClosesTheMesh) {
    // Corner 5 lies on the edge 2-3 of the last face, which the sliver 2-5-3 fills.
    const auto imported = import("a.obj",
                                 "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nv 0.5 1 0\n"
                                 "f 1 3 5\nf 1 5 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 2 5 3\n");
    EXPECT_EQ(imported.mesh.triangles.size(), 5u);
    EXPECT_TRUE(imported.mesh.closed);
}

TEST_F(MeshImport, SmoothingGroupsOfA3dsKeepAnEdgeSharpWhereFacesHaveNoneInCommon) {
    const auto groups = [](std::array<std::uint32_t, 4> ofFaces) {
        std::string bytes;
        for (const std::uint32_t group : ofFaces)
            bytes += littleEndian(group);
        return tetrahedron3ds(3, chunk3ds(0x4150, bytes));
    };
    // A vertex for each normal: the corners of four faces apart, those of two and two, of all.
    const Mesh flat = import("a.3ds", groups({1, 2, 4, 8})).mesh;
    EXPECT_EQ(flat.positions.size(), 12u);
    for (const glm::uvec3& triangle : flat.triangles) {
        const glm::vec3 a = flat.positions[triangle.x];
        const glm::vec3 normal = glm::normalize(
            glm::cross(flat.positions[triangle.y] - a, flat.positions[triangle.z] - a));
        for (glm::length_t corner = 0; corner < 3; ++corner)
            EXPECT_LT(glm::length(flat.normals[triangle[corner]] - normal), 1e-6f);
    }
    EXPECT_EQ(import("b.3ds", groups({1, 1, 2, 2})).mesh.positions.size(), 8u);
    // The first and the third face have nothing in common, at the two corners that they share.
    EXPECT_EQ(import("c.3ds", groups({1, 3, 2, 3})).mesh.positions.size(), 8u);
    EXPECT_EQ(import("d.3ds", groups({5, 5, 4, 12})).mesh.positions.size(), 4u);
}

TEST_F(MeshImport, UvsAreReadInEveryFormat) {
    const auto uvs = [](const Mesh& mesh) {
        std::vector<glm::vec2> found;
        for (const glm::uvec3& triangle : mesh.triangles)
            for (glm::length_t corner = 0; corner < 3; ++corner)
                found.push_back(mesh.uvs[triangle[corner]]);
        return found;
    };
    const std::vector<glm::vec2> expected{{0, 0}, {0.5f, 0}, {0, 1}};
    EXPECT_EQ(
        uvs(import("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0\nvt 0.5 0\nvt 0 1 0\nf 1/1 2/2 3/3\n")
                .mesh),
        expected);
    const auto ply = [](const std::string& ofVertices, const std::string& data) {
        return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n" +
               ofVertices + "element face 1\nproperty list uchar int vertex_indices\n" + data;
    };
    EXPECT_EQ(uvs(import("a.ply", ply("property float s\nproperty float t\n",
                                      "end_header\n0 0 0 0\n1 0 .5 0\n0 1 0 1\n3 0 1 2\n"))
                      .mesh),
              expected);
    // Of the corners of a face, as MeshLab writes them.
    EXPECT_EQ(uvs(import("b.ply", ply("",
                                      "property list uchar float texcoord\nend_header\n0 0\n"
                                      "1 0\n0 1\n3 0 1 2 6 0 0 .5 0 0 1\n"))
                      .mesh),
              expected);
    const std::string mapping = chunk3ds(
        0x4140, littleEndian(std::uint16_t{4}) + littleEndianFloats({0, 0, 0.5f, 0, 0, 1, 1, 1}));
    const Mesh mesh = import("a.3ds", tetrahedron3ds(3, "", mapping)).mesh;
    EXPECT_EQ(uvs(mesh)[1], glm::vec2(0, 1));
    EXPECT_EQ(uvs(mesh)[2], glm::vec2(0.5f, 0));
}

TEST_F(MeshImport, AVertexOfAnObjIsDividedByItsWeightAndMayHaveAColour) {
    const std::string rest = "v 1 0 0\nv 0 1 0\nf 1 2 3\n";
    EXPECT_EQ(import("a.obj", "v 2 2 -4 2\n" + rest).mesh.origin, glm::dvec3(0.5, 0.5, -1));
    EXPECT_EQ(import("b.obj", "v 1 1 -2 2 0 0\n" + rest).mesh.origin, glm::dvec3(0.5, 0.5, -1));
    EXPECT_THAT(errorOf("c.obj", "v 1 1 1 0\n" + rest),
                HasSubstr("c.obj:1: a vertex has the weight"));
}

TEST_F(MeshImport, A3dsIsDividedByItsMasterScaleAndItsKeyframesAreLeftOutWithAWarning) {
    std::string file = tetrahedron3ds();
    // Into the main chunk, and into the editor's, which comes last.
    const auto append = [&](const std::string& chunk, bool inEditor) {
        const std::size_t editor = 16;  // behind the headers of the file and of its version
        file.replace(2, 4, littleEndian(static_cast<std::uint32_t>(file.size() + chunk.size())));
        if (inEditor)
            file.replace(
                editor + 2, 4,
                littleEndian(static_cast<std::uint32_t>(file.size() - editor + chunk.size())));
        file += chunk;
    };
    append(chunk3ds(0x0100, littleEndianFloats({2.0f})), true);
    append(chunk3ds(0xb000, ""), false);
    const ImportedMesh imported = import("a.3ds", file);
    EXPECT_EQ(imported.mesh.origin, glm::dvec3(0.25, 0.75, -0.5));
    ASSERT_EQ(imported.warnings.size(), 1u);
    EXPECT_THAT(imported.warnings.front(), HasSubstr("keyframes were left out"));
}

TEST_F(MeshImport, AMeshWithAHoleIsNotClosed) {
    EXPECT_FALSE(import("a.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\n")
                     .mesh.closed);
}

TEST_F(MeshImport, AMeshThatIsInsideOutIsReadWithAWarning) {
    const auto imported = import("a.obj",
                                 "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\n"
                                 "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
    EXPECT_TRUE(imported.mesh.closed);
    ASSERT_EQ(imported.warnings.size(), 1u);
    EXPECT_THAT(imported.warnings.front(), HasSubstr("inside out"));
}

Mesh triangle() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, glm::vec3(0, 0, 1));
    mesh.uvs.assign(3, glm::vec2(0.0f));
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

TEST(MeshChecks, AValidMeshPassesAndEachFaultIsNamed) {
    const auto problem = [](auto change) {
        Mesh mesh = triangle();
        change(mesh);
        return kaustik::test::messageOf<IoError>([&] { validateMesh(mesh, "here"); });
    };
    EXPECT_EQ(problem([](Mesh&) {}), "");
    EXPECT_THAT(problem([](Mesh& m) { m.triangles.clear(); }), HasSubstr("no triangles"));
    EXPECT_THAT(problem([](Mesh& m) { m.positions[1].y = NAN; }), HasSubstr("vertex 1"));
    EXPECT_THAT(problem([](Mesh& m) { m.uvs[2].x = INFINITY; }), HasSubstr("uv of vertex 2"));
    EXPECT_THAT(problem([](Mesh& m) { m.normals[0] *= 2.0f; }), HasSubstr("length 1"));
    EXPECT_THAT(problem([](Mesh& m) { m.normals[0].x = NAN; }), HasSubstr("length 1"));
    EXPECT_THAT(problem([](Mesh& m) { m.normals.pop_back(); }), HasSubstr("2 normals"));
    EXPECT_THAT(problem([](Mesh& m) { m.triangles[0].z = 3; }), HasSubstr("vertex 3"));
    EXPECT_THAT(problem([](Mesh& m) { m.origin.z = NAN; }), HasSubstr("here: the mesh's origin"));
}

TEST(MeshChecks, ASheetIsOpenAndTwoSheetsBackToBackAreClosed) {
    Mesh mesh = triangle();
    EXPECT_FALSE(isClosed(mesh));
    mesh.triangles.emplace_back(0, 2, 1);
    EXPECT_TRUE(isClosed(mesh));
    mesh.triangles[1] = {0, 1, 2};
    EXPECT_FALSE(isClosed(mesh));
    EXPECT_FALSE(isClosed(Mesh()));
}

}  // namespace
}  // namespace kaustik::scene::test
