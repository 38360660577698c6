// SPDX-License-Identifier: MIT
// Small files that have brought down what reads them, or eaten time and memory: each is read, or an
// error that says what is wrong. Where the reader process is what stops them, it does so here too;
// all others are read in this process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/importers/mesh_formats.h"
#include "framework/importers/toml_file.h"
#include "framework/scene/files/gltf_import.h"
#include "framework/scene/files/mesh_import.h"
#include "framework/scene/files/toml_node.h"
#include "tests/unit/importers/gltf_file_fixture.h"
#include "tests/unit/importers/mesh_file_fixture.h"
#include "tests/unit/peak_memory.h"

namespace kaustik::scene::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string plyWith(const std::string& faces, const std::string& data) {
    return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
           "property float z\n" +
           faces + "end_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n" + data;
}
const std::string kFaceList = "property list int int vertex_indices\n";

TEST_F(MeshImport, FacesOfAPlyWithFewerThanThreeCornersAreLeftOutWithAWarning) {
    const auto imported =
        import("a.ply", plyWith("element face 4\n" + kFaceList, "0\n1 2\n2 0 1\n3 0 1 2\n"));
    EXPECT_EQ(imported.mesh.triangles.size(), 1u);
    EXPECT_THAT(imported.warnings, ElementsAre(HasSubstr("3 faces or strips with fewer")));
    EXPECT_THAT(errorOf("b.ply", plyWith("element face 1\n" + kFaceList, "0\n")),
                HasSubstr("no faces"));
}

TEST_F(MeshImport, StripsOfAPlyAreReadWholeOrNotAtAll) {
    const std::string header = "element tristrips 1\n" + kFaceList;
    const std::string twoStrips = "element tristrips 2\n" + kFaceList;
    EXPECT_EQ(import("a.ply", plyWith(header, "3 0 1 2\n")).mesh.triangles.size(), 1u);
    // Every second triangle of a strip is turned, so that this one is closed; -1 begins anew.
    const Mesh closed = import("b.ply", plyWith(header, "6 0 2 1 3 0 2\n")).mesh;
    EXPECT_EQ(closed.triangles.size(), 4u);
    EXPECT_TRUE(closed.closed);
    EXPECT_GT(signedVolumeTimesSix(closed), 0.0);
    EXPECT_EQ(import("b.ply", plyWith(header, "8 0 2 1 3 -1 1 3 0\n")).mesh.triangles.size(), 3u);
    const auto imported = import("c.ply", plyWith(twoStrips, "2 0 1\n3 0 1 2\n"));
    EXPECT_EQ(imported.mesh.triangles.size(), 1u);
    EXPECT_THAT(imported.warnings, ElementsAre(HasSubstr("1 faces or strips with fewer")));
    for (const char* strip : {"2 0 1\n", "1 0\n", "0\n", "3 0 1 -1\n", "1 -1\n"}) {
        EXPECT_THAT(errorOf("b.ply", plyWith(header, strip)), HasSubstr("no faces")) << strip;
    }
}

TEST_F(MeshImport, AnElementOfATextPlyThatDoesNotEndWithItsLineIsAnError) {
    const std::string header = "element face 1\n" + kFaceList;
    const std::string whole = plyWith(header, "3 0 1 2\n");
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string changed = whole;
        changed.replace(changed.find(from), from.size(), to);
        return errorOf("a.ply", changed);
    };
    // What reads by words finds a face here, what reads by lines a list of 900 million corners.
    EXPECT_THAT(with("0 0 1\n3 0 1 2\n", "0 0 1 3 0 1 2\n900000000\n"),
                HasSubstr("it holds 0 of 1 elements 'face'"));
    EXPECT_THAT(with("1 0 0\n", "1\n0 0\n"), HasSubstr("too few numbers on the line of element"));
    EXPECT_THAT(with("3 0 1 2\n", "3 0 1\n2\n"), HasSubstr("too few numbers"));
}

TEST_F(MeshImport, AnElementOfATextPlyMayHaveMoreOnItsLineAndBlankLinesBeforeIt) {
    const std::string header = "element face 1\n" + kFaceList;
    const auto more = import("a.ply", plyWith(header, "3 0 1 2 255 0 0\n"));
    EXPECT_EQ(more.mesh.triangles.size(), 1u);
    EXPECT_THAT(more.warnings, ElementsAre(HasSubstr("1 lines have more numbers")));
    const auto blank = import("b.ply", plyWith(header, "\n \n3 0 1 2"));
    EXPECT_EQ(blank.mesh.triangles.size(), 1u);
    EXPECT_THAT(blank.warnings, ElementsAre());
}

TEST_F(MeshImport, APlyReadsBlanksAndBothKindsOfLineEnds) {
    std::string ply = plyWith("element face 1\n" + kFaceList, "  3\t0 1  2 \n");
    EXPECT_EQ(import("a.ply", ply).mesh.triangles.size(), 1u);
    std::string windows;
    for (const char c : ply)
        windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    EXPECT_EQ(import("b.ply", windows).mesh.triangles.size(), 1u);
}

TEST_F(MeshImport, AnElementOfAPlyWithoutPropertiesIsAnErrorHoweverManyThereAre) {
    for (const char* count : {"1", "100000000", "4000000000", "18446744073709551615"}) {
        const std::string ply = std::string("ply\nformat ascii 1.0\nelement vertex ") + count +
                                "\nelement face 1\n" + kFaceList + "end_header\n3 0 1 2\n";
        EXPECT_THAT(errorOf("a.ply", ply), HasSubstr("elements 'vertex' without properties"));
    }
}

// Readers differ in which of the two the faces mean.
TEST_F(MeshImport, AnElementThatAPlyDeclaresTwiceIsAnError) {
    const std::string faces = "element face 1\n" + kFaceList;
    EXPECT_THAT(errorOf("a.ply", plyWith(faces + "element face 2\n" + kFaceList,
                                         "3 0 1 2\n3 0 1 2\n3 0 1 2\n")),
                HasSubstr("declares the element 'face' twice"));
    EXPECT_THAT(
        errorOf("b.ply", plyWith("element vertex 1\nproperty float x\n" + faces, "0\n3 0 1 2\n")),
        HasSubstr("declares the element 'vertex' twice"));
    EXPECT_THAT(errorOf("c.ply", plyWith(faces + "element tristrips 1\n" + kFaceList,
                                         "3 0 1 2\n4 0 1 2 3\n")),
                HasSubstr("both faces and strips"));
}

TEST_F(MeshImport, ALineOfAPlysHeaderThatIsNoneIsAnError) {
    std::string ply = plyWith("element face 1\n" + kFaceList, "3 0 1 2\n");
    const std::string whole = ply;
    const std::size_t afterFormat = ply.find("element");
    ply.insert(afterFormat, "comment made by hand\nobj_info 1\n");
    EXPECT_EQ(import("a.ply", ply).mesh.triangles.size(), 1u);
    ply.insert(afterFormat, "elements vertex 100000000\n");
    EXPECT_THAT(errorOf("b.ply", ply), HasSubstr("a line 'elements' in its header"));
    EXPECT_THAT(errorOf("d.ply", "ply2" + whole.substr(3)), HasSubstr("a line 'ply'"));
}

// Readers differ in which of the two counts: one of them took 34 GB for 300 bytes.
TEST_F(MeshImport, APlyOfTwoFormatsIsAnError) {
    std::string ply = plyWith("element face 1\n" + kFaceList, "3 0 1 2\n");
    ply.insert(4, "format binary_little_endian 1.0\n");
    EXPECT_THAT(errorOf("a.ply", ply), HasSubstr("has two formats in its header"));
}

TEST_F(MeshImport, WholeNumbersOfATextPlyAreWrittenAsSuchAndFitTheirType) {
    const auto error = [&](const std::string& face) {
        return errorOf("a.ply",
                       plyWith("element face 1\nproperty list uchar uint vertex_index\n", face));
    };
    EXPECT_EQ(error("3 0 1 2\n"), "");
    EXPECT_THAT(error("3e0 0 1 2\n"), HasSubstr("'3e0' in place of a whole number"));
    EXPECT_THAT(error("3 0 1.0 2\n"), HasSubstr("'1.0' in place of a whole number"));
    EXPECT_THAT(error("300 0 1 2\n"), HasSubstr("'300' in element 'face' (0), which its type"));
    EXPECT_THAT(error("3 0 1 -1\n"), HasSubstr("'-1' in element 'face' (0), which its type"));
    EXPECT_THAT(errorOf("a.ply", plyWith("element face 1\nproperty list float int vertex_index\n",
                                         "3 0 1 2\n")),
                HasSubstr("no whole number"));
}

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST_F(MeshImport, AnObjWhoseMaterialLibraryIsMissingOrDamagedIsReadWithoutIt) {
    EXPECT_EQ(import("a.obj", "mtllib none.mtl\n" + kTriangle + "a 1\n").mesh.triangles.size(), 1u);
    static_cast<void>(folder_.file("b.mtl", std::string("newmtl \xff\0 map_Kd", 16)));
    EXPECT_EQ(import("b.obj", "mtllib b.mtl\nusemtl x\n" + kTriangle).mesh.triangles.size(), 1u);
}

TEST_F(MeshImport, GroupsObjectsAndMaterialsOfAnObjMakeOneMesh) {
    std::string grouped = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    std::string plain = grouped;
    const std::vector<std::string> faces = {"f 1 3 2\n", "f 1 2 4\n", "f 1 4 3\n", "f 2 3 4\n"};
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const std::string name = std::to_string(i) + "\n";
        grouped += "g " + name + "o " + name + "usemtl " + name + "s " + name + faces[i];
        plain += faces[i];
    }
    const Mesh mesh = import("a.obj", grouped).mesh;
    const Mesh expected = import("a.obj", plain).mesh;
    EXPECT_EQ(mesh.positions, expected.positions);
    EXPECT_EQ(mesh.normals, expected.normals);
    EXPECT_EQ(mesh.triangles, expected.triangles);
    EXPECT_TRUE(mesh.closed);
}

TEST_F(MeshImport, OnlyWhatMakesTrianglesOfAnObjIsRead) {
    std::string text = "mtllib m.mtl\n";
    for (int i = 0; i < 1000; ++i)
        text += "g a\no b\nusemtl c\ns 1\nl 1 2\n# comment\n";
    const Mesh mesh = import("a.obj", text + kTriangle + "f 3 \\\n 2 1 # end\n").mesh;
    EXPECT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.positions, import("a.obj", kTriangle).mesh.positions);
}

std::string nested3ds(int depth) {
    std::string file;
    for (int i = 0; i < depth; ++i)
        file = chunk3ds(i + 1 == depth ? 0x4d4d : 0x3d3d, file);
    return file;
}

TEST_F(MeshImport, A3dsWhoseChunksAreNestedDeepIsAnError) {
    EXPECT_THAT(errorOf("a.3ds", nested3ds(4)), HasSubstr("no faces"));
    // 80,000 fill the stack of whoever recurses; they are made here without copying them so often.
    constexpr std::uint32_t kDepth = 80000;
    std::string deep;
    for (std::uint32_t i = 0; i < kDepth; ++i) {
        deep += littleEndian(std::uint16_t{i == 0 ? std::uint16_t{0x4d4d} : std::uint16_t{0x3d3d}});
        deep += littleEndian(6 * (kDepth - i));
    }
    EXPECT_THAT(errorOf("b.3ds", deep), HasSubstr("nested more than 16 deep"));
}

TEST_F(GltfImport, AChunkOfAGlbThatIsLongerThanTheFileIsAnError) {
    const std::string whole = glb(tetrahedronScene(), tetrahedronBytes());
    const std::size_t binary = whole.size() - tetrahedronBytes().size() - 8;
    for (const std::uint32_t more : {4u, 8u, 4000000000u}) {
        std::string damaged = whole;
        damaged.replace(binary, 4,
                        word32(static_cast<std::uint32_t>(tetrahedronBytes().size()) + more));
        EXPECT_THAT(kaustik::test::messageOf<IoError>(
                        [&] { (void)readGltfFile(folder_.file("a.glb", damaged)); }),
                    AllOf(HasSubstr("a.glb is damaged"), HasSubstr("beyond the file")))
            << more;
    }
}

TEST_F(GltfImport, RefusesJsonThatIsNestedAMillionDeep) {
    constexpr std::size_t kDepth = 1000000;
    const std::string opened(kDepth, '[');
    const std::string closed(kDepth, ']');
    reading::ReaderProcess reader;
    const auto refusal = [&](const std::string& name, const std::string& text) {
        const auto file = folder_.file(name, text);
        return kaustik::test::messageOf<Error>([&] { (void)importGltf(file, reader); });
    };
    EXPECT_THAT(refusal("open.gltf", opened), HasSubstr("open.gltf is damaged or cut off"));
    EXPECT_THAT(refusal("list.gltf", opened + closed), HasSubstr("list.gltf"));
    // What is no scene may be anything; tinygltf recurses over it.
    std::string scene = tetrahedronScene().dump();
    scene.pop_back();
    scene += ",\"extras\":" + opened + closed + "}";
    EXPECT_THAT(refusal("extras.gltf", scene), HasSubstr("extras.gltf"));
    // The next file has a reader of its own.
    EXPECT_EQ(
        importGltf(folder_.file("sound.glb", glb(tetrahedronScene(), tetrahedronBytes())), reader)
            .objects.size(),
        1u);
}

TEST_F(GltfImport, EachOfManyNodesBecomesAnObjectInItsPlace) {
    Json document = tetrahedronScene();
    Json nodes = document["nodes"];
    for (int i = 0; i < 20000; ++i) {
        nodes.push_back({{"mesh", 0}, {"translation", {i, 0, 0}}});
        document["scenes"][0]["nodes"].push_back(3 + i);
    }
    document["nodes"] = nodes;
    const Scene scene = import(document);
    ASSERT_EQ(scene.objects.size(), 20001u);
    ASSERT_EQ(scene.meshes.size(), 1u);
    for (std::size_t i = 0; i < 20000; ++i)
        ASSERT_EQ(scene.objects[1 + i].toWorld[3].x, static_cast<double>(i));
}

TEST_F(MeshImport, AGzippedBombIsStoppedByTheReadersLimitOfMemory) {
    const std::string zipped = gzip(std::string(std::size_t{1} << 20, '\0'));
    // A file of many members: 1 GiB of zeros in a megabyte.
    std::string bomb;
    for (int i = 0; i < 1024; ++i)
        bomb += zipped;
    const auto file = folder_.file("bomb.ply.gz", bomb);
    reading::ReaderProcess reader(reading::ReaderProcess::defaultProgram(), {.mebibytes = 512});
    const std::size_t before = kaustik::test::peakBytes();
    const std::string problem =
        kaustik::test::messageOf<ConfigError>([&] { (void)importMeshWithWarnings(file, reader); });
#ifdef __SANITIZE_ADDRESS__
    // The sanitizer ends the process with an exit code of its own; that it is ended counts.
    EXPECT_THAT(problem, HasSubstr("bomb.ply.gz"));
#else
    EXPECT_THAT(problem, HasSubstr("bomb.ply.gz needs more than 512 MiB"));
#endif
    // This process has none of it; what it takes is the allocator's.
    EXPECT_LT(kaustik::test::peakBytes() - before, std::size_t{16} << 20);
}

TEST(Gunzip, OfAMeshOfZerosThatIsNotLargeIsAllowed) {
    const std::string zeros(std::size_t{20} << 20, '\0');
    EXPECT_EQ(gunzip(gzip(zeros), "zeros.ply.gz"), zeros);
}

class TomlFile : public ::testing::Test {
  protected:
    TomlNode parse(const std::string& text) const {
        return parseTomlFile(folder_.file("a.toml", text));
    }
    std::string errorOf(const std::string& text) const {
        return kaustik::test::messageOf<ConfigError>([&] { (void)parse(text); });
    }
    static std::string dotted(int parts, const std::string& part = "a") {
        std::string key = part;
        for (int i = 1; i < parts; ++i)
            key += "." + part;
        return key;
    }
    kaustik::test::TemporaryFolder folder_;
};

TEST_F(TomlFile, WithADottedKeyThatIsDeepIsAnErrorWithItsLine) {
    EXPECT_EQ(errorOf(dotted(32) + " = 1\n"), "");
    for (const int parts : {33, 200}) {
        EXPECT_THAT(errorOf("x = 1\n" + dotted(parts) + " = 1\n"),
                    AllOf(HasSubstr("a.toml:2:"), HasSubstr("nested more than 32 deep")));
        EXPECT_THAT(errorOf("\n\n[" + dotted(parts) + "]\n"), HasSubstr("a.toml:3:"));
        EXPECT_THAT(errorOf("[[" + dotted(parts, "'a'") + "]]\n"), HasSubstr("a.toml:1:"));
        EXPECT_THAT(errorOf("x = {" + dotted(parts, " \"a\" ") + " = 1}\n"),
                    HasSubstr("a.toml:1:"));
    }
}

// toml++ recurses over the parts of a key: here until the stack is full, which is the reader's.
TEST_F(TomlFile, WithADottedKeyThatFillsTheStackIsAnErrorThatNamesTheFile) {
    const auto file = folder_.file("a.toml", dotted(400000) + " = 1\n");
    EXPECT_THAT(kaustik::test::messageOf<ConfigError>([&] { (void)readToml(file); }),
                AllOf(HasSubstr("a.toml"), HasSubstr("damaged"), HasSubstr("Export it again")));
}

TEST_F(TomlFile, WithTablesOrListsThatAreDeepIsAnError) {
    EXPECT_THAT(errorOf("a = " + std::string(33, '[') + std::string(33, ']') + "\n"),
                HasSubstr("a.toml:1: This is nested more than 32 deep"));
    EXPECT_THAT(errorOf("[" + dotted(20) + "]\n" + dotted(20, "b") + " = 1\n"),
                HasSubstr("nested more than 32 deep"));
    EXPECT_THAT(errorOf("a = " + std::string(100000, '[')), HasSubstr("a.toml:1:"));
}

TEST_F(TomlFile, MayHaveDotsInTextsAndComments) {
    const std::string dots(200, '.');
    const TomlNode node =
        parse("# " + dots + "\na = \"\\\"" + dots + "\" # '" + dots + "\nb = '''\n" + dots + "'" +
              dots + "\n'''\nc = \"\"\"" + dots + "\\\"\"\"\"\nd = [1.5, 2.5e3]\n");
    EXPECT_EQ(*node.find("a")->as<std::string>(), "\"" + dots);
    EXPECT_EQ(*node.find("b")->as<std::string>(), dots + "'" + dots + "\n");
    EXPECT_EQ(*node.find("c")->as<std::string>(), dots + "\"");
    EXPECT_EQ(node.find("d")->list()->size(), 2u);
    EXPECT_EQ(node.find("d")->line, 7u);
}

}  // namespace
}  // namespace kaustik::scene::test
