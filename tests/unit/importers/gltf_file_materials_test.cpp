// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "framework/importers/gltf_materials.h"
#include "framework/scene/dispersion.h"
#include "tests/unit/importers/gltf_file_fixture.h"

namespace kaustik::scene::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kMaterial = "/materials/0";
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST_F(GltfImport, ATransmittingMaterialIsADielectricWithItsIndexOfRefraction) {
    const Material material =
        import(changed("/materials/0/extensions/KHR_materials_ior/ior", 1.333)).materials.at(0);
    EXPECT_EQ(material.kind, MaterialKind::dielectric);
    EXPECT_EQ(material.ior, 1.333f);
    EXPECT_EQ(material.absorptionPerMeter, glm::vec3(0.0f));
}

// KHR_materials_dispersion: 20 over the Abbe number.
TEST_F(GltfImport, DispersionIsByTheAbbeNumber) {
    Json document = tetrahedronScene();
    document["materials"][0]["extensions"]["KHR_materials_ior"]["ior"] = 1.6;
    document["materials"][0]["extensions"]["KHR_materials_dispersion"]["dispersion"] = 0.5;
    const Material material = import(document).materials.at(0);
    const Dispersion expected = byAbbeNumber(1.6, 40.0);
    EXPECT_NEAR(static_cast<double>(material.dispersion.x), expected.polynomial.x, 1e-7);
    EXPECT_EQ(material.ior, 1.6f);
    document["materials"][0]["extensions"]["KHR_materials_dispersion"]["dispersion"] = -1.0;
    EXPECT_THAT(errorOf<ConfigError>(document), HasSubstr("KHR_materials_dispersion.dispersion"));
}

TEST_F(GltfImport, TheIndexOfRefractionIsOnePointFiveWhereTheFileHasNone) {
    Json document = tetrahedronScene();
    document["materials"][0]["extensions"].erase("KHR_materials_ior");
    EXPECT_EQ(import(document).materials.at(0).ior, 1.5f);
}

TEST_F(GltfImport, TheAttenuationColourIsWhatIsLeftAfterTheAttenuationDistance) {
    Json document = tetrahedronScene();
    document["materials"][0]["extensions"]["KHR_materials_volume"] = {
        {"thicknessFactor", 1.0},
        {"attenuationDistance", 2.0},
        {"attenuationColor", {1.0, 0.5, 0.0}}};
    const glm::vec3 absorption = import(document).materials.at(0).absorptionPerMeter;
    EXPECT_EQ(absorption.r, 0.0f);
    EXPECT_FALSE(std::signbit(absorption.r));
    EXPECT_NEAR(std::exp(-2.0 * double{absorption.g}), 0.5, 1e-7);
    // Black keeps all after no distance and nothing after a micrometre.
    EXPECT_EQ(std::exp(-absorption.b * 0.0f), 1.0f);
    EXPECT_EQ(std::exp(-absorption.b * 1e-6f), 0.0f);
}

TEST(GltfAbsorption, IsFiniteForEveryTintAndDistance) {
    for (const double color : {0.0, 5e-324, 0.5, 1.0}) {
        for (const double distance : {5e-324, 1e-30, 1.0, 1e300, kInfinity}) {
            const glm::vec3 absorption = absorptionFromAttenuation(glm::dvec3(color), distance);
            EXPECT_TRUE(std::isfinite(absorption.r)) << color << " " << distance;
            EXPECT_GE(absorption.r, 0.0f);
        }
        EXPECT_EQ(absorptionFromAttenuation(glm::dvec3(color), kInfinity).r, 0.0f) << color;
    }
}

TEST_F(GltfImport, WithoutAThicknessNothingIsAbsorbedAndAWarningSaysSo) {
    Json document = tetrahedronScene();
    document["materials"][0]["extensions"]["KHR_materials_volume"] = {
        {"attenuationDistance", 2.0}, {"attenuationColor", {0.5, 0.5, 0.5}}};
    const Scene scene = import(document);
    EXPECT_EQ(scene.materials.at(0).absorptionPerMeter, glm::vec3(0.0f));
    EXPECT_THAT(warnings(scene), HasSubstr("materials[0].extensions.KHR_materials_volume"));
}

TEST_F(GltfImport, ATransmissionBetweenNothingAndAllIsRoundedWithAWarning) {
    const char* factor = "/materials/0/extensions/KHR_materials_transmission/transmissionFactor";
    const Scene maximum = import(changed(factor, 0.75));
    EXPECT_EQ(maximum.materials.at(0).kind, MaterialKind::dielectric);
    EXPECT_THAT(warnings(maximum), HasSubstr("transmissionFactor is 0.75"));
    const Scene little = import(changed(factor, 0.25));
    EXPECT_EQ(little.materials.at(0).kind, MaterialKind::lambertian);
    EXPECT_THAT(warnings(little), HasSubstr("transmissionFactor is 0.25"));
    EXPECT_EQ(warnings(import(changed(factor, 0))), "");
}

TEST_F(GltfImport, ASmoothMetalIsAMirrorAndOtherMaterialsAreDiffuse) {
    const auto kind = [&](double metallic, double roughness) {
        return import(changed(kMaterial, {{"pbrMetallicRoughness",
                                           {{"metallicFactor", metallic},
                                            {"roughnessFactor", roughness},
                                            {"baseColorFactor", {0.25, 0.5, 0.75, 1.0}}}}}))
            .materials.at(0);
    };
    EXPECT_EQ(kind(1.0, 0.0).kind, MaterialKind::mirror);
    EXPECT_EQ(kind(1.0, 0.0).albedo, glm::vec3(0.25f, 0.5f, 0.75f));
    EXPECT_EQ(kind(1.0, 0.5).kind, MaterialKind::lambertian);
    EXPECT_EQ(kind(0.0, 0.0).kind, MaterialKind::lambertian);
    EXPECT_EQ(kind(0.0, 1.0).albedo, glm::vec3(0.25f, 0.5f, 0.75f));
}

TEST_F(GltfImport, APrimitiveWithoutAMaterialIsWhiteAndDiffuse) {
    Json document = tetrahedronScene();
    document["meshes"][0]["primitives"][0].erase("material");
    const Scene scene = import(document);
    const Material& material = scene.materials.at(scene.objects.at(0).material);
    EXPECT_EQ(material.kind, MaterialKind::lambertian);
    EXPECT_EQ(material.albedo, glm::vec3(1.0f));
}

TEST_F(GltfImport, ValuesOutOfRangeAreWrongRequestsThatNameTheField) {
    const auto refuse = [&](const std::string& pointer, const Json& value) {
        return errorOf<ConfigError>(changed(pointer, value));
    };
    const std::string extensions = "/materials/0/extensions/";
    const std::string ior = extensions + "KHR_materials_ior/ior";
    EXPECT_THAT(refuse(ior, 0.5),
                AllOf(HasSubstr("scene.glb: materials[0].extensions.KHR_materials_ior.ior is 0.5"),
                      HasSubstr("at least 1")));
    EXPECT_THAT(refuse(ior, 0), HasSubstr("ior is 0;"));
    EXPECT_THAT(refuse(ior, -2), HasSubstr("ior is -2;"));
    EXPECT_THAT(refuse(ior, "glass"), HasSubstr("ior is \"glass\";"));
    const std::string transmission = extensions + "KHR_materials_transmission/transmissionFactor";
    EXPECT_THAT(refuse(transmission, 7), HasSubstr("transmissionFactor is 7; it must be a number "
                                                   "from 0 to 1"));
    EXPECT_THAT(refuse(transmission, -0.1), HasSubstr("transmissionFactor is -0.1"));
    const std::string volume = extensions + "KHR_materials_volume/";
    EXPECT_THAT(refuse(volume + "attenuationDistance", 0), HasSubstr("above 0"));
    EXPECT_THAT(refuse(volume + "attenuationColor", {0.5, 1.5, 0.5}), HasSubstr("[0.5,1.5,0.5]"));
    EXPECT_THAT(refuse(volume + "attenuationColor", {0.5, 0.5}), HasSubstr("three numbers"));
    EXPECT_THAT(refuse(volume + "thicknessFactor", -1), HasSubstr("at least 0"));
    const std::string pbr = "/materials/0/pbrMetallicRoughness/";
    EXPECT_THAT(refuse(pbr + "metallicFactor", 2), HasSubstr("metallicFactor is 2"));
    EXPECT_THAT(refuse(pbr + "roughnessFactor", -1), HasSubstr("roughnessFactor is -1"));
    EXPECT_THAT(refuse(pbr + "baseColorFactor", {1, 1, 1, 2}), HasSubstr("four numbers"));
    const std::string light = "/extensions/KHR_lights_punctual/lights/0/";
    EXPECT_THAT(refuse(light + "intensity", -1),
                HasSubstr("extensions.KHR_lights_punctual.lights[0].intensity is -1"));
    EXPECT_THAT(refuse(light + "type", "area"), HasSubstr("type is 'area'"));
    EXPECT_THAT(refuse(light + "range", 0), HasSubstr("range is 0"));
    EXPECT_THAT(refuse("/extensions/KHR_lights_punctual/lights/0",
                       Json::parse(R"({"type": "spot", "spot": {"innerConeAngle": 0.9}})")),
                HasSubstr("innerConeAngle is 0.9"));
    EXPECT_THAT(refuse("/cameras/0/perspective/yfov", 4), HasSubstr("yfov is 4"));
    EXPECT_THAT(refuse("/cameras/0/perspective/znear", 0), HasSubstr("znear is 0"));
    EXPECT_THAT(refuse("/extensionsRequired", {"KHR_draco_mesh_compression"}),
                HasSubstr("KHR_draco_mesh_compression"));
    EXPECT_THAT(refuse("/asset/version", "1.0"), HasSubstr("\"1.0\""));
    EXPECT_THAT(refuse("/nodes/0/rotation", {0, 0, 0, 0}), HasSubstr("nodes[0].rotation"));
    EXPECT_THAT(refuse("/nodes/0/scale", {1e300, 1e300, "x"}), HasSubstr("nodes[0].scale"));
}

// A 1x1 PNG is 8 bytes of signature and more; here only the bytes are looked at.
const std::string kImage = "\x89PNG and more";

Json texturedScene(const Json& image) {
    Json document = tetrahedronScene();
    document["materials"][0] = {
        {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}}}};
    document["textures"] = {{{"source", 0}}};
    document["images"] = Json::array({image});
    return document;
}

TEST_F(GltfImport, AnImageInABufferStaysEncoded) {
    Json document = texturedScene({{"bufferView", 2}, {"mimeType", "image/png"}});
    document["bufferViews"][2] = {{"buffer", 0}, {"byteOffset", 72}, {"byteLength", kImage.size()}};
    document["buffers"][0]["byteLength"] = 72 + kImage.size();
    const Scene scene = import(document, tetrahedronBytes() + kImage);
    ASSERT_EQ(scene.images.size(), 1u);
    EXPECT_EQ(scene.images[0].bytes, kImage);
    EXPECT_TRUE(scene.images[0].srgb);
    EXPECT_EQ(scene.materials.at(0).image, 0);
}

TEST_F(GltfImport, AnImageInADataUriStaysEncoded) {
    const Scene scene = import(texturedScene({{"uri", "data:image/png;base64,iVBORyBhbmQ="}}));
    EXPECT_EQ(scene.images.at(0).bytes, "\x89PNG and");
}

TEST_F(GltfImport, ANormalTextureIsTheMapOfGlassAndMirrorsAndOfNothingElse) {
    Json document = texturedScene({{"uri", "data:image/png;base64,iVBORyBhbmQ="}});
    document["materials"][0] = {
        {"pbrMetallicRoughness", {{"metallicFactor", 1}, {"roughnessFactor", 0}}},
        {"normalTexture", {{"index", 0}, {"scale", 0.25}}}};
    const Scene mirror = import(document);
    EXPECT_EQ(mirror.materials.at(0).kind, MaterialKind::mirror);
    EXPECT_EQ(mirror.materials.at(0).normalMap, 0);
    EXPECT_EQ(mirror.materials.at(0).normalScale, 0.25f);
    EXPECT_TRUE(mirror.images.at(0).isNormalMap);
    EXPECT_FALSE(mirror.images.at(0).srgb);
    document["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = 0;
    const Scene diffuse = import(document);
    EXPECT_EQ(diffuse.materials.at(0).normalMap, -1);
    EXPECT_THAT(diffuse.warnings,
                testing::Contains(HasSubstr("materials[0].normalTexture is left out")));
}

TEST_F(GltfImport, AnImageBesideTheSceneIsNamedAndMustBeThere) {
    const Json document = texturedScene({{"uri", "wood%20grain.png"}});
    EXPECT_THAT(errorOf<IoError>(document),
                AllOf(HasSubstr("images[0].uri"), HasSubstr("wood grain.png")));
    const auto file = folder_.file("wood grain.png", kImage);
    const Scene scene = import(document);
    EXPECT_EQ(scene.images.at(0).file, file);
    EXPECT_TRUE(scene.images.at(0).bytes.empty());
}

}  // namespace
}  // namespace kaustik::scene::test
