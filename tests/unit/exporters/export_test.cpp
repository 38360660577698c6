// SPDX-License-Identifier: MIT
#include "framework/exporters/export.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/render/view.h"
#include "framework/scene/dispersion.h"
#include "framework/scene/files/gltf_import.h"
#include "framework/scene/files/mesh_import.h"
#include "framework/scene/files/scene_file.h"
#include "framework/scene/foreign/foreign_export.h"
#include "framework/scene/foreign/foreign_scene.h"
#include "framework/scene/spectrum.h"
#include "tests/unit/exporters/pbrt_parser.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::exporters {
namespace {

using test::TemporaryFolder;

constexpr int kWidth = 160;
constexpr int kHeight = 120;

ExportedScene exported(const scene::Scene& scene, Format format, const TemporaryFolder& folder) {
    return exportScene(scene, {format, (folder / ""), kWidth, kHeight, 100000});
}

bool hasNote(const ExportedScene& scene, const std::string& words) {
    return std::any_of(scene.notes.begin(), scene.notes.end(), [&](const ExportNote& note) {
        return sentenceOf(note).find(words) != std::string::npos;
    });
}

// Lights of their own and discs.
std::vector<scene::Light> lightsOf(const scene::Scene& scene) {
    std::vector<scene::Light> lights;
    for (const scene::Light& light : scene.lights) {
        if (light.emitter < 0 && light.band == 0) lights.push_back(light);
    }
    for (const scene::Emitter& emitter : scene.emitters) {
        if (emitter.isDisc()) lights.push_back(emitter.light);
    }
    return lights;
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance, const char* what) {
    EXPECT_LT(glm::length(a - b), tolerance) << what;
}

// Of the vertices as they are now.
scene::Bounds boundsOf(const scene::Scene& scene, const scene::Object& object) {
    scene::Bounds bounds;
    const scene::Mesh& mesh = scene.meshes[object.mesh];
    for (const glm::vec3& position : mesh.positions)
        bounds.include(object.toWorld * glm::dvec4(mesh.origin + glm::dvec3(position), 1.0));
    return bounds;
}

// What went through a format that holds all of it, to the rounding of 32-bit floats.
void expectSame(const scene::Scene& a, const scene::Scene& b) {
    const double size = glm::length(scene::sceneBounds(a).maximum - scene::sceneBounds(a).minimum);
    expectNear(a.camera.position, b.camera.position, 1e-6 * size, "camera");
    expectNear(glm::normalize(a.camera.target - a.camera.position),
               glm::normalize(b.camera.target - b.camera.position), 1e-6, "camera's direction");
    EXPECT_NEAR(a.camera.verticalFovDegrees, b.camera.verticalFovDegrees, 1e-4);
    ASSERT_EQ(a.objects.size(), b.objects.size());
    for (std::size_t i = 0; i < a.objects.size(); ++i) {
        const scene::Bounds own = boundsOf(a, a.objects[i]);
        const scene::Bounds other = boundsOf(b, b.objects[i]);
        expectNear(own.minimum, other.minimum, 1e-5 * size, a.objects[i].name.c_str());
        expectNear(own.maximum, other.maximum, 1e-5 * size, a.objects[i].name.c_str());
        const scene::Material& material = a.materials[a.objects[i].material];
        const scene::Material& same = b.materials[b.objects[i].material];
        EXPECT_EQ(material.kind, same.kind) << a.objects[i].name;
        EXPECT_NEAR(material.ior, same.ior, 1e-5f);
        expectNear(glm::dvec3(material.absorptionPerMeter), glm::dvec3(same.absorptionPerMeter),
                   1e-4, "absorption");
        if (material.pattern == scene::Pattern::none &&
            material.kind != scene::MaterialKind::dielectric)
            expectNear(glm::dvec3(material.albedo), glm::dvec3(same.albedo), 1e-5, "albedo");
        EXPECT_EQ(a.meshes[a.objects[i].mesh].closed, b.meshes[b.objects[i].mesh].closed);
    }
    const std::vector<scene::Light> lights = lightsOf(a);
    const std::vector<scene::Light> others = lightsOf(b);
    ASSERT_EQ(lights.size(), others.size());
    for (std::size_t i = 0; i < lights.size(); ++i) {
        EXPECT_EQ(lights[i].kind, others[i].kind);
        EXPECT_LT(glm::length(lights[i].power - others[i].power),
                  1e-5f * glm::length(lights[i].power));
        if (lights[i].kind != scene::LightKind::directional)
            expectNear(lights[i].position, others[i].position, 1e-6 * size, "light");
        if (lights[i].kind != scene::LightKind::point)
            expectNear(lights[i].direction, others[i].direction, 1e-6, "light's direction");
    }
}

class EachScene : public testing::TestWithParam<const char*> {};

TEST_P(EachScene, ComesBackFromMitsubaAsItWent) {
    const scene::Scene scene = scene::loadScene(GetParam());
    const TemporaryFolder folder;
    const ExportedScene written = exported(scene, Format::mitsuba, folder);
    reading::ReaderProcess reader;
    const scene::ForeignScene foreign = scene::readForeignScene(written.sceneFile, reader);
    const std::filesystem::path back = (folder / "") / "back.toml";
    static_cast<void>(scene::exportForeignScene(foreign, {back, written.sceneFile, false}, reader));
    EXPECT_EQ(foreign.width, static_cast<std::uint32_t>(kWidth));
    expectSame(scene, scene::loadSceneFile(back));
}

TEST_P(EachScene, ComesBackFromGltfAsItWent) {
    const scene::Scene scene = scene::loadScene(GetParam());
    const TemporaryFolder folder;
    const ExportedScene written = exported(scene, Format::gltf, folder);
    const scene::Scene back = scene::importGltf(written.sceneFile);
    expectSame(scene, back);
    // Smooth surfaces stay smooth: the same normals at the same corners.
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        EXPECT_EQ(scene.meshes[scene.objects[i].mesh].triangles.size(),
                  back.meshes[back.objects[i].mesh].triangles.size());
    }
}

TEST_P(EachScene, IsSeenByPbrtsCameraInTheSamePixels) {
    const scene::Scene scene = scene::loadScene(GetParam());
    const TemporaryFolder folder;
    const ExportedScene written = exported(scene, Format::pbrt, folder);
    const test::PbrtFile file = test::parsePbrt(readFile(written.sceneFile));
    double fov = 0.0;
    for (const test::PbrtStatement& statement : file.options) {
        if (statement.directive == "Camera") fov = statement.parameters.at("fov").numbers.at(0);
    }
    const render::RasterView view = render::makeEyeView(scene.camera, kWidth, kHeight);
    const scene::Bounds bounds = scene::specularBounds(scene);
    const double tangent = std::tan(0.5 * glm::radians(fov));
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point((corner & 1) != 0 ? bounds.maximum.x : bounds.minimum.x,
                               (corner & 2) != 0 ? bounds.maximum.y : bounds.minimum.y,
                               (corner & 4) != 0 ? bounds.maximum.z : bounds.minimum.z);
        const auto ours =
            render::pixelOf(view, glm::dvec3(view.worldToView * glm::dvec4(point, 1.0)));
        ASSERT_TRUE(ours.has_value());
        // The shorter side of the picture is from -1 to 1; camera space has z forward, x right.
        const glm::dvec3 camera(file.worldToCamera * glm::dvec4(point, 1.0));
        ASSERT_GT(camera.z, 0.0);
        const glm::dvec2 screen(camera.x / camera.z / tangent, camera.y / camera.z / tangent);
        const glm::dvec2 theirs(0.5 * kWidth + 0.5 * kHeight * screen.x,
                                0.5 * kHeight * (1.0 + screen.y));
        EXPECT_LT(glm::length(*ours - theirs), 1e-6 * kWidth);
    }
}

TEST_P(EachScene, HasAllItsShapesLightsAndMaterialsInPbrtsFile) {
    const scene::Scene scene = scene::loadScene(GetParam());
    const TemporaryFolder folder;
    const ExportedScene written = exported(scene, Format::pbrt, folder);
    const test::PbrtFile file = test::parsePbrt(readFile(written.sceneFile));
    std::map<std::string, test::PbrtParameters> materials;
    std::map<std::string, test::PbrtParameters> media;
    std::size_t shapes = 0;
    std::size_t lights = 0;
    reading::ReaderProcess reader;
    for (const test::PbrtStatement& statement : file.world) {
        if (statement.directive == "MakeNamedMaterial")
            materials[statement.names.at(0)] = statement.parameters;
        if (statement.directive == "MakeNamedMedium")
            media[statement.names.at(0)] = statement.parameters;
        if (statement.directive == "LightSource") {
            const scene::Light light = lightsOf(scene).at(lights++);
            const bool isDistant = statement.names.at(0) == "distant";
            EXPECT_EQ(isDistant, light.kind == scene::LightKind::directional);
            const std::vector<double>& power =
                statement.parameters.at(isDistant ? "L" : "I").numbers;
            expectNear({power.at(0), power.at(1), power.at(2)}, glm::dvec3(light.power),
                       1e-6 * glm::length(glm::dvec3(light.power)), "light's power");
        }
        if (statement.directive != "Shape") continue;
        const scene::Object& object = scene.objects.at(shapes++);
        const scene::Material& material = scene.materials[object.material];
        const test::PbrtParameters& there = materials.at(statement.material);
        const std::string& type = there.at("type").texts.at(0);
        if (material.kind == scene::MaterialKind::dielectric) {
            EXPECT_EQ(type, "dielectric");
            EXPECT_NEAR(there.at("eta").numbers.at(0), static_cast<double>(material.ior), 1e-6);
            if (material.absorptionPerMeter != glm::vec3(0.0f)) {
                const std::vector<double>& sigma =
                    media.at(statement.interior).at("sigma_a").numbers;
                expectNear({sigma.at(0), sigma.at(1), sigma.at(2)},
                           glm::dvec3(material.absorptionPerMeter), 1e-6, "absorption");
            }
        } else {
            EXPECT_EQ(type, material.kind == scene::MaterialKind::mirror ? "conductor" : "diffuse");
        }
        const std::filesystem::path mesh =
            (folder / "") / statement.parameters.at("filename").texts.at(0);
        EXPECT_TRUE(std::filesystem::is_regular_file(mesh)) << mesh;
    }
    EXPECT_EQ(shapes, scene.objects.size());
    EXPECT_EQ(lights, lightsOf(scene).size());
}

INSTANTIATE_TEST_SUITE_P(Of, EachScene,
                         testing::Values("glass-sphere", "ring", "concave-glass",
                                         "pool-reflections", "flat-water"),
                         [](const auto& of) {
                             std::string name = of.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

// Numbers after a word of POV-Ray's language.
std::vector<double> numbersAfter(const std::string& text, const std::string& word) {
    const std::size_t at = text.find(word);
    EXPECT_NE(at, std::string::npos) << word;
    std::vector<double> numbers;
    std::size_t i = at + word.size();
    while (numbers.size() < 3) {
        i = text.find_first_of("-0123456789.", i);
        std::size_t used = 0;
        numbers.push_back(std::stod(text.substr(i), &used));
        i += used;
    }
    return numbers;
}

TEST(PovrayExport, ShowsPointsInTheSamePixelsWithTheVectorsOfItsCamera) {
    const scene::Scene scene = scene::loadScene("glass-sphere");
    const TemporaryFolder folder;
    const std::string pov = readFile(exported(scene, Format::povray, folder).sceneFile);
    const auto vectorOf = [&](const char* word) {
        const std::vector<double> numbers = numbersAfter(pov, word);
        return glm::dvec3(numbers[0], numbers[1], numbers[2]);
    };
    const glm::dvec3 location = vectorOf("location");
    // A ray through the picture at (x, y), each from -1/2 to 1/2, is direction + x right + y up.
    const glm::dmat3 basis(vectorOf("right"), vectorOf("up"), vectorOf("direction"));
    const glm::dvec3 point(0.3, 0.4, -0.2);
    const glm::dvec3 parts = glm::inverse(basis) * (point - location);
    const glm::dvec2 theirs(kWidth * (0.5 + parts.x / parts.z),
                            kHeight * (0.5 + parts.y / parts.z));
    const render::RasterView view = render::makeEyeView(scene.camera, kWidth, kHeight);
    const auto ours = render::pixelOf(view, glm::dvec3(view.worldToView * glm::dvec4(point, 1.0)));
    ASSERT_TRUE(ours.has_value());
    EXPECT_LT(glm::length(theirs - *ours), 1e-6 * kWidth);
}

TEST(PovrayExport, HasALightsIntensityByTheFormulaOfItsFading) {
    const scene::Scene scene = scene::loadScene("glass-sphere");
    const TemporaryFolder folder;
    const std::string pov = readFile(exported(scene, Format::povray, folder).sceneFile);
    const std::size_t light = pov.find("light_source");
    const std::string text = pov.substr(light, pov.find("}\n}", light) - light);
    const std::vector<double> color = numbersAfter(text, "rgb");
    const double fade = numbersAfter(text + " 0 0", "fade_distance")[0];
    // 2 / (1 + (d / fade)²) of it, times albedo, is the radiance albedo I / (π d²).
    for (const double distance : {0.5, 3.0}) {
        const double expected = static_cast<double>(lightsOf(scene).at(0).power.r) /
                                (std::acos(-1.0) * distance * distance);
        const double there = color[0] * 2.0 / (1.0 + std::pow(distance / fade, 2.0));
        EXPECT_NEAR(there / expected, 1.0, 1e-4);
    }
}

TEST(Export, SaysWhatAFormatCannotHold) {
    scene::Scene scene = scene::loadScene("glass-sphere");
    scene.medium = scene::Medium{glm::vec3(0.1f), glm::vec3(0.0f), 0.0f};
    for (scene::Material& material : scene.materials) {
        if (material.kind != scene::MaterialKind::dielectric) continue;
        material.dispersion = glm::vec4(scene::byAbbeNumber(1.5, 40.0).polynomial);
    }
    scene.lights.front().rangeMeters = 9.0f;
    for (const Format format : {Format::povray, Format::mitsuba, Format::gltf, Format::pbrt}) {
        const TemporaryFolder folder;
        const ExportedScene written = exported(scene, format, folder);
        EXPECT_TRUE(hasNote(written, "left out: ambient_irradiance"));
        EXPECT_TRUE(hasNote(written, "left out: background_radiance"));
        EXPECT_EQ(hasNote(written, "left out: medium"),
                  format == Format::povray || format == Format::gltf);
        EXPECT_EQ(hasNote(written, "beyond its range"), format != Format::gltf);
        EXPECT_EQ(hasNote(written, "left out: material 'glass': its dispersion"),
                  format == Format::mitsuba);
        EXPECT_EQ(hasNote(written, "changed: material 'glass'"),
                  format == Format::povray || format == Format::gltf);
    }
}

TEST(Export, KeepsDispersionInPbrtAtEachWavelengthAndInGltfByItsAbbeNumber) {
    scene::Scene scene = scene::loadScene("glass-sphere");
    scene::Material* glass = nullptr;
    for (scene::Material& material : scene.materials) {
        if (material.kind == scene::MaterialKind::dielectric) glass = &material;
    }
    ASSERT_NE(glass, nullptr);
    glass->dispersion = glm::vec4(scene::byAbbeNumber(1.5, 40.0).polynomial);
    const TemporaryFolder folder;
    const test::PbrtFile file =
        test::parsePbrt(readFile(exported(scene, Format::pbrt, folder).sceneFile));
    std::size_t compared = 0;
    for (const test::PbrtStatement& statement : file.world) {
        if (!statement.parameters.contains("eta")) continue;
        const std::vector<double>& eta = statement.parameters.at("eta").numbers;
        EXPECT_EQ(statement.parameters.at("eta").type, "spectrum");
        for (std::size_t i = 0; i + 1 < eta.size(); i += 2, ++compared)
            EXPECT_NEAR(eta[i + 1], scene::indexAt(*glass, scene::dispersionPlace(eta[i])), 1e-6);
    }
    EXPECT_EQ(compared, 33u);
    const scene::Scene back = scene::importGltf(exported(scene, Format::gltf, folder).sceneFile);
    for (const scene::Material& material : back.materials) {
        if (material.kind != scene::MaterialKind::dielectric) continue;
        for (const double nanometers : {450.0, 550.0, 650.0}) {
            const double place = scene::dispersionPlace(nanometers);
            EXPECT_NEAR(scene::indexAt(material, place), scene::indexAt(*glass, place), 1e-4);
        }
    }
}

TEST(Export, RefusesAFormatThatThereIsNotAndNamesTheNearest) {
    EXPECT_EQ(formatOf("pbrt"), Format::pbrt);
    try {
        static_cast<void>(formatOf("mitsubi"));
        FAIL();
    } catch (const ConfigError& error) {
        EXPECT_NE(std::string(error.what()).find("mitsuba"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace kaustik::exporters
