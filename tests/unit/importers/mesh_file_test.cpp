// SPDX-License-Identifier: MIT
// Every format is read whole or not at all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "framework/core/files.h"
#include "framework/importers/triangle_soup.h"
#include "tests/unit/importers/mesh_file_fixture.h"

namespace kaustik::scene::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kTetrahedronObj =
    "# a tetrahedron\nv 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

void expectTetrahedron(const Mesh& mesh, const glm::dvec3& size) {
    ASSERT_EQ(mesh.triangles.size(), 4u);
    EXPECT_TRUE(mesh.closed);
    EXPECT_EQ(mesh.origin, 0.5 * size);
    // One corner at the origin: half a box away from the centre.
    EXPECT_NE(std::find(mesh.positions.begin(), mesh.positions.end(), glm::vec3(-0.5 * size)),
              mesh.positions.end());
}

TEST_F(MeshImport, AnObjIsReadWithItsNameAndItsCentreAsOrigin) {
    const Mesh mesh = import("tetra.obj", kTetrahedronObj).mesh;
    EXPECT_EQ(mesh.name, "tetra");
    EXPECT_EQ(mesh.positions.size(), 4u);
    expectTetrahedron(mesh, {1, 2, 3});
}

TEST_F(MeshImport, APlyIsReadInAllThreeEncodings) {
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        SCOPED_TRACE(format);
        expectTetrahedron(import("tetra.ply", tetrahedronPly(format)).mesh, {1, 2, 3});
    }
}

TEST_F(MeshImport, AGzippedPlyIsReadAndNamedWithoutBothEndings) {
    const auto imported = import("tetra.ply.gz", gzip(tetrahedronPly("binary_little_endian")));
    EXPECT_EQ(imported.mesh.name, "tetra");
    expectTetrahedron(imported.mesh, {1, 2, 3});
}

TEST_F(MeshImport, AGzipFileOfTwoMembersIsReadToItsEnd) {
    const std::string ply = tetrahedronPly("ascii");
    expectTetrahedron(import("a.ply.gz", gzip(ply.substr(0, 100)) + gzip(ply.substr(100))).mesh,
                      {1, 2, 3});
}

TEST_F(MeshImport, A3dsIsTurnedFromZUpToYUp) {
    // (x, y, z) becomes (x, z, -y): a rotation, so that the faces stay counter-clockwise.
    const ImportedMesh imported = import("tetra.3ds", tetrahedron3ds());
    EXPECT_EQ(imported.mesh.origin, glm::dvec3(0.5, 1.5, -1.0));
    EXPECT_TRUE(imported.mesh.closed);
    EXPECT_TRUE(imported.warnings.empty()) << imported.warnings.front();
}

TEST_F(MeshImport, AnUnknownKindOfFileIsAWrongRequest) {
    const auto file = folder_.file("mesh.fbx", "Kaydara");
    EXPECT_THROW((void)readMeshFile(file), ConfigError);
}

TEST_F(MeshImport, AMissingFileAndADirectoryAreErrors) {
    std::filesystem::create_directory(folder_ / "folder.obj");
    EXPECT_THROW((void)readMeshFile(folder_ / "none.ply"), IoError);
    EXPECT_THROW((void)readMeshFile(folder_ / "folder.obj"), IoError);
}

TEST_F(MeshImport, AFileWithoutFacesIsAnError) {
    EXPECT_THAT(errorOf("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), HasSubstr("no faces"));
    EXPECT_THAT(errorOf("a.obj", ""), HasSubstr("no faces"));
    EXPECT_THAT(errorOf("a.3ds", chunk3ds(0x4d4d, "")), HasSubstr("no faces"));
}

TEST_F(MeshImport, APlyCutOffAtAnyByteIsAnErrorOrWhole) {
    expectWholeOrErrorAtEveryLength("a.ply", tetrahedronPly("ascii"), 1);
    expectWholeOrErrorAtEveryLength("b.ply", tetrahedronPly("binary_little_endian"), 0);
    expectWholeOrErrorAtEveryLength("c.ply", tetrahedronPly("binary_big_endian"), 0);
}

TEST_F(MeshImport, AGzippedPlyCutOffAtAnyByteIsAnError) {
    expectWholeOrErrorAtEveryLength("a.ply.gz", gzip(tetrahedronPly("ascii")), 0);
}

TEST_F(MeshImport, A3dsCutOffAtAnyByteIsAnError) {
    expectWholeOrErrorAtEveryLength("a.3ds", tetrahedron3ds(), 0);
}

TEST_F(MeshImport, AGzippedPlyWithAFlippedBitIsAnError) {
    std::string zipped = gzip(tetrahedronPly("ascii"));
    for (std::size_t i = zipped.size() - 8; i < zipped.size(); ++i) {  // checksum and length
        zipped[i] = static_cast<char>(zipped[i] ^ 1);
        EXPECT_THAT(errorOf("a.ply.gz", zipped), HasSubstr("a.ply.gz is not a whole gzip file"));
        zipped[i] = static_cast<char>(zipped[i] ^ 1);
    }
}

// As many programs leave it.
TEST_F(MeshImport, TheLastLineNeedsNoLineBreak) {
    const std::string obj = kTetrahedronObj.substr(0, kTetrahedronObj.find_last_not_of('\n') + 1);
    const std::string text = tetrahedronPly("ascii");
    const std::string ply = text.substr(0, text.find_last_not_of('\n') + 1);
    for (const auto& [file, bytes] : {std::pair("a.obj", obj), {"a.ply", ply}}) {
        const ImportedMesh imported = import(file, bytes);
        EXPECT_EQ(imported.mesh.triangles.size(), 4u) << file;
        EXPECT_TRUE(imported.warnings.empty()) << imported.warnings.front();
    }
}

TEST_F(MeshImport, LinesMayEndAsOnAnySystem) {
    for (const std::string end : {"\r\n", "\r"}) {
        std::string obj;
        for (const char c : kTetrahedronObj)
            obj += c == '\n' ? end : std::string(1, c);
        std::string ply;
        for (const char c : tetrahedronPly("ascii"))
            ply += c == '\n' ? end : std::string(1, c);
        EXPECT_EQ(import("a.obj", "\xEF\xBB\xBF" + obj).mesh.triangles.size(), 4u);
        EXPECT_EQ(import("a.ply", ply).mesh.triangles.size(), 4u);
        EXPECT_THAT(errorOf("b.obj", "v 0 0 0" + end + "v 0 x 0" + end), HasSubstr("b.obj:2:"));
    }
}

TEST_F(MeshImport, AnObjCutOffWithinANumberThatItNeedsIsAnError) {
    EXPECT_THAT(errorOf("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 0 1"),
                HasSubstr("too few"));
    EXPECT_THAT(errorOf("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1"), HasSubstr("too few"));
}

// What exporters write that is of no use, but bends nothing.
TEST_F(MeshImport, WhatAnObjCanDoWithoutIsLeftOutWithAWarning) {
    const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const std::vector<std::pair<std::string, std::string>> files{
        {"f 1 2 3\nf 1 2\n", "1 faces with fewer than three corners"},
        {"f 1/1 2/1 3/1\n", "3 corners name a uv"},
        {"f 1//7 2//7 3//7\n", "3 corners name a normal"},
        {"vt nan 0\nf 1/1 2/1 3/1\n", "1 uvs are no numbers"},
        {"vn -nan(ind) 0 1\nf 1//1 2//1 3//1\n", "1 normals are no numbers"}};
    for (const auto& [rest, warning] : files) {
        const ImportedMesh imported = import("a.obj", mesh + rest);
        EXPECT_EQ(imported.mesh.triangles.size(), 1u);
        ASSERT_EQ(imported.warnings.size(), 1u) << rest;
        EXPECT_THAT(imported.warnings.front(), HasSubstr(warning));
    }
    EXPECT_EQ(import("a.obj", mesh + "fo 1 2 3\n").mesh.triangles.size(), 1u);
}

TEST_F(MeshImport, TrianglesThatFaceAgainstTheirNeighboursAreTurned) {
    const ImportedMesh imported = import("a.obj",
                                         "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\n"
                                         "f 1 3 2\nf 1 2 4\nf 1 3 4\nf 2 3 4\n");
    EXPECT_TRUE(imported.mesh.closed);
    EXPECT_GT(signedVolumeTimesSix(imported.mesh), 0.0);
    ASSERT_EQ(imported.warnings.size(), 1u);
    EXPECT_THAT(imported.warnings.front(), HasSubstr("1 of 4 triangles faced against"));
}

TEST_F(MeshImport, AnObjWithAnIndexOutOfRangeNamesTheLine) {
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    EXPECT_THAT(errorOf("a.obj", vertices + "f 1 2 4\n"),
                AllOf(HasSubstr("a.obj:4:"), HasSubstr("vertex 4, but the file has only 3")));
    EXPECT_THAT(errorOf("a.obj", vertices + "f -1 -2 -4\n"), HasSubstr("a.obj:4:"));
    EXPECT_THAT(errorOf("a.obj", vertices + "f 0 1 2\n"), HasSubstr("a.obj:4: '0'"));
    EXPECT_THAT(errorOf("a.obj", vertices + "f 1 2 x\n"), HasSubstr("'x'"));
}

TEST_F(MeshImport, AnObjWithAVertexThatIsNotANumberNamesTheLine) {
    const std::string rest = "v 1 0 0\nv 0 1 0\nf 1 2 3\n";
    EXPECT_THAT(errorOf("a.obj", "v 0 nan 0\n" + rest), HasSubstr("a.obj:1:"));
    EXPECT_THAT(errorOf("a.obj", "v 0 inf 0\n" + rest), HasSubstr("not finite"));
    EXPECT_THAT(errorOf("a.obj", "v 0 1e39 0\n" + rest), HasSubstr("not finite"));
    EXPECT_THAT(errorOf("a.obj", "v 0 0\n" + rest), HasSubstr("too few"));
    EXPECT_THAT(errorOf("a.obj", "v 0 - 0\n" + rest), HasSubstr("'-'"));
}

TEST_F(MeshImport, NegativeIndicesAndContinuedLinesAreReadInAnObj) {
    const Mesh mesh = import("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 \\\n -2 -1\n").mesh;
    EXPECT_EQ(mesh.triangles.size(), 1u);
}

TEST_F(MeshImport, LinesInAnObjAreLeftOutWithAWarning) {
    const auto imported = import("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\nl 2 3\n");
    EXPECT_EQ(imported.mesh.triangles.size(), 1u);
    ASSERT_EQ(imported.warnings.size(), 1u);
    EXPECT_THAT(imported.warnings.front(), HasSubstr("2 points, lines"));
}

TEST_F(MeshImport, APlyWithAnIndexOutOfRangeOrABadHeaderIsAnError) {
    std::string ply = tetrahedronPly("ascii");
    const auto replaced = [&](const std::string& from, const std::string& to) {
        std::string changed = ply;
        changed.replace(changed.find(from), from.size(), to);
        return errorOf("a.ply", changed);
    };
    EXPECT_THAT(replaced("3 1 2 3", "3 1 2 4"), HasSubstr("vertex 4, but there are only 4"));
    EXPECT_THAT(replaced("3 1 2 3", "3 1 2 -1"), HasSubstr("vertex -1"));
    EXPECT_THAT(replaced("1 0 0\n", "1 nan 0\n"), HasSubstr("vertex 1 whose y is not finite"));
    EXPECT_THAT(replaced("face 4", "face 5"), HasSubstr("4 of 5 elements 'face'"));
    EXPECT_THAT(replaced("face 4", "face 99999999999999"), HasSubstr("4 of 99999999999999"));
    EXPECT_THAT(replaced("float x", "quark x"), HasSubstr("'quark'"));
    EXPECT_THAT(replaced("ascii", "morse"), HasSubstr("'morse'"));
    EXPECT_THAT(replaced("vertex 4", "vertex many"), HasSubstr("count"));
}

TEST_F(MeshImport, A3dsWithAnIndexOutOfRangeIsAnErrorAndNotABentMesh) {
    EXPECT_THAT(errorOf("a.3ds", tetrahedron3ds(4)), HasSubstr("vertex 4, but there are only 4"));
}

TEST_F(MeshImport, A3dsWhoseChunksDoNotFitIsAnError) {
    const std::string inner =
        littleEndian(std::uint16_t{0x3d3d}) + littleEndian(std::uint32_t{900});
    EXPECT_THAT(errorOf("a.3ds", chunk3ds(0x4d4d, inner)), HasSubstr("3D3D does not fit"));
    EXPECT_THAT(errorOf("a.3ds", "not a 3ds file"), HasSubstr("is no 3DS file"));
}

// The papers' own bunny, which experiments/fetch_meshes.sh gets.
TEST_F(MeshImport, TheBunnyHas69666TrianglesAndIsClosed) {
    const std::filesystem::path bunny = projectRoot() / "meshes/bunny.obj";
    if (!std::filesystem::exists(bunny)) GTEST_SKIP() << bunny << " is not there";
    const ImportedMesh imported = readMeshFile(bunny);
    EXPECT_EQ(imported.mesh.triangles.size(), 69666u);
    EXPECT_TRUE(imported.mesh.closed);
    EXPECT_TRUE(imported.warnings.empty());
}

}  // namespace
}  // namespace kaustik::scene::test
