// SPDX-License-Identifier: MIT
// Damaged glTF files: one clear error, never a crash and never a part of the scene.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/importers/gltf_file_fixture.h"

namespace kaustik::scene::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST_F(GltfImport, AGlbCutOffAtAnyByteIsAnError) {
    const std::string whole = glb(tetrahedronScene(), tetrahedronBytes());
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const auto path = folder_.file("cut.glb", std::string_view(whole).substr(0, length));
        EXPECT_THAT(kaustik::test::messageOf<IoError>([&] { (void)readGltfFile(path); }),
                    HasSubstr("cut.glb"))
            << "cut after byte " << length;
    }
}

TEST_F(GltfImport, ATextFileCutOffAtAnyByteIsAnError) {
    Json document = tetrahedronScene();
    document["buffers"][0]["uri"] = "buffer.bin";
    (void)folder_.file("buffer.bin", tetrahedronBytes());
    const std::string whole = document.dump();
    ASSERT_NO_THROW((void)readGltfFile(folder_.file("cut.gltf", whole)));
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const auto path = folder_.file("cut.gltf", std::string_view(whole).substr(0, length));
        EXPECT_THAT(kaustik::test::messageOf<IoError>([&] { (void)readGltfFile(path); }),
                    HasSubstr("cut.gltf"))
            << "cut after byte " << length;
    }
}

TEST_F(GltfImport, AGlbWithAnyByteChangedIsReadOrRefused) {
    const std::string whole = glb(tetrahedronScene(), tetrahedronBytes());
    constexpr std::string_view kValues(
        "\x00\x7f\xff"
        "9\"",
        5);
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string damaged = whole;
        damaged[i] = kValues[i % kValues.size()];
        try {
            (void)readGltfFile(folder_.file("damaged.glb", damaged));
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("damaged.glb")) << "byte " << i;
        }
    }
}

TEST_F(GltfImport, IndicesIntoListsThatAreTooShortNameTheField) {
    const auto refuse = [&](const std::string& pointer, const Json& value) {
        return errorOf<IoError>(changed(pointer, value));
    };
    EXPECT_THAT(refuse("/nodes/0/mesh", 1),
                HasSubstr("nodes[0].mesh is 1, but meshes has 1 entries"));
    EXPECT_THAT(refuse("/nodes/0/mesh", -1), HasSubstr("nodes[0].mesh is -1"));
    EXPECT_THAT(refuse("/nodes/0/mesh", 0.5), HasSubstr("nodes[0].mesh is 0.5"));
    EXPECT_THAT(refuse("/nodes/1/camera", 5), HasSubstr("nodes[1].camera is 5"));
    EXPECT_THAT(refuse("/nodes/2/extensions/KHR_lights_punctual/light", 3),
                HasSubstr("nodes[2].extensions.KHR_lights_punctual.light is 3"));
    EXPECT_THAT(refuse("/scenes/0/nodes/1", 99), HasSubstr("scenes[0].nodes[1] is 99"));
    EXPECT_THAT(refuse("/scene", 1), HasSubstr("scene is 1"));
    EXPECT_THAT(refuse("/meshes/0/primitives/0/attributes/POSITION", 77),
                HasSubstr("meshes[0].primitives[0].attributes.POSITION is 77"));
    EXPECT_THAT(refuse("/meshes/0/primitives/0/indices", 2), HasSubstr("indices is 2"));
    EXPECT_THAT(refuse("/meshes/0/primitives/0/material", 1), HasSubstr("material is 1"));
    EXPECT_THAT(refuse("/accessors/0/bufferView", 2), HasSubstr("accessors[0].bufferView is 2"));
    EXPECT_THAT(refuse("/bufferViews/0/buffer", 1), HasSubstr("bufferViews[0].buffer is 1"));
}

TEST_F(GltfImport, AnAccessorOutOfRangeNamesTheFieldAndTheSizes) {
    const auto refuse = [&](const std::string& pointer, const Json& value) {
        return errorOf<IoError>(changed(pointer, value));
    };
    EXPECT_THAT(refuse("/accessors/0/count", 5),
                AllOf(HasSubstr("meshes[0].primitives[0].attributes.POSITION is out of range"),
                      HasSubstr("accessors[0]) ends at byte 60 of bufferViews[0], which has 48")));
    EXPECT_THAT(refuse("/accessors/0/count", 4294967295), HasSubstr("out of range"));
    EXPECT_THAT(refuse("/accessors/0/byteOffset", 4), HasSubstr("out of range"));
    EXPECT_THAT(refuse("/accessors/1/count", 15), HasSubstr("indices is out of range"));
    EXPECT_THAT(refuse("/bufferViews/0/byteStride", 16), HasSubstr("out of range"));
    EXPECT_THAT(refuse("/bufferViews/1/byteLength", 25),
                HasSubstr("bufferViews[1] ends at byte 73, but buffers[0] has only 72"));
    EXPECT_THAT(refuse("/bufferViews/1/byteOffset", 49), HasSubstr("bufferViews[1]"));
    EXPECT_THAT(refuse("/buffers/0/byteLength", 71), HasSubstr("bufferViews[1]"));
    EXPECT_THAT(refuse("/buffers/0/byteLength", 80), HasSubstr("cannot be read as glTF"));
}

TEST_F(GltfImport, AnAccessorOfAWrongTypeNamesTheField) {
    const auto refuse = [&](const std::string& pointer, const Json& value) {
        return errorOf<IoError>(changed(pointer, value));
    };
    EXPECT_THAT(refuse("/accessors/0/componentType", 5123), HasSubstr("32-bit floats"));
    EXPECT_THAT(refuse("/accessors/0/type", "VEC2"), HasSubstr("3 components"));
    EXPECT_THAT(refuse("/accessors/1/componentType", 5122), HasSubstr("unsigned integers"));
    EXPECT_THAT(refuse("/accessors/1/count", 11), HasSubstr("no whole triangles"));
    EXPECT_THAT(refuse("/meshes/0/primitives/0/attributes/NORMAL", 1), HasSubstr("NORMAL"));
}

TEST_F(GltfImport, AVertexIndexOutOfRangeIsAnError) {
    std::string binary = tetrahedronBytes();
    binary[48 + 2 * 7] = 4;
    EXPECT_THAT(errorOf<IoError>(tetrahedronScene(), binary),
                HasSubstr("indices has vertex 4 at place 7, but there are only 4"));
}

TEST_F(GltfImport, AVertexThatIsNotFiniteIsAnError) {
    for (const float value :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        std::string binary = tetrahedronBytes();
        binary.replace(12, 4, floatBytes({value}));
        EXPECT_THAT(
            errorOf<IoError>(tetrahedronScene(), binary),
            AllOf(HasSubstr("meshes[0].primitives[0]"), HasSubstr("vertex 1 is not finite")));
    }
}

TEST_F(GltfImport, AMissingOrShortBufferFileIsAnErrorThatNamesBoth) {
    Json document = tetrahedronScene();
    document["buffers"][0]["uri"] = "buffer.bin";
    const auto path = folder_.file("a.gltf", document.dump());
    const auto message = [&] {
        return kaustik::test::messageOf<IoError>([&] { (void)readGltfFile(path); });
    };
    EXPECT_THAT(message(), AllOf(HasSubstr("a.gltf: buffers[0].uri"), HasSubstr("buffer.bin")));
    (void)folder_.file("buffer.bin", tetrahedronBytes().substr(0, 71));
    EXPECT_THAT(message(), AllOf(HasSubstr("buffers[0].byteLength is 72"), HasSubstr("71 bytes")));
}

TEST_F(GltfImport, NodesThatGoInACircleAreAnError) {
    Json document = tetrahedronScene();
    document["nodes"][0]["children"] = {1};
    EXPECT_THAT(errorOf<IoError>(document), HasSubstr("nodes[1] has two parents"));
    document["scenes"][0]["nodes"] = {0};
    document["nodes"][1]["children"] = {0};
    EXPECT_THAT(errorOf<IoError>(document), HasSubstr("nodes[0] has two parents"));
}

TEST_F(GltfImport, AChainOfThirtyThousandNodesIsRead) {
    Json document = tetrahedronScene();
    document["scenes"][0]["nodes"] = {3};
    for (int i = 0; i < 30000; ++i) {
        document["nodes"].push_back({{"children", {i + 4}}});
    }
    document["nodes"].push_back({{"mesh", 0}, {"translation", {1, 2, 3}}});
    const Scene scene = import(document);
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_EQ(glm::dvec3(scene.objects[0].toWorld[3]), glm::dvec3(1, 2, 3));
}

TEST_F(GltfImport, MembersOfAWrongTypeAreErrors) {
    for (const char* pointer :
         {"/nodes", "/nodes/0", "/meshes/0", "/meshes/0/primitives", "/meshes/0/primitives/0",
          "/meshes/0/primitives/0/attributes", "/materials/0/extensions", "/accessors", "/buffers",
          "/materials/0/pbrMetallicRoughness", "/extensions/KHR_lights_punctual/lights",
          "/materials/0/extensions/KHR_materials_ior", "/cameras/0/perspective", "/asset",
          "/scenes/0/nodes", "/bufferViews/0", "/extensionsRequired"}) {
        EXPECT_THAT(errorOf<IoError>(changed(pointer, 3.5)), HasSubstr("scene.glb")) << pointer;
    }
    EXPECT_THAT(errorOf<IoError>(Json::array()), HasSubstr("is no object"));
    Json document = tetrahedronScene();
    document["meshes"][0]["primitives"][0].erase("attributes");
    EXPECT_THAT(errorOf<IoError>(document), HasSubstr("primitives[0].attributes is missing"));
    document = tetrahedronScene();
    document["meshes"][0]["primitives"][0]["attributes"].erase("POSITION");
    EXPECT_THAT(errorOf<IoError>(document), HasSubstr("POSITION is missing"));
    document = tetrahedronScene();
    document["cameras"][0].erase("perspective");
    EXPECT_THAT(errorOf<IoError>(document), HasSubstr("scene.glb"));
}

}  // namespace
}  // namespace kaustik::scene::test
