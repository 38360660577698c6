// SPDX-License-Identifier: MIT
// What a scene file says is what the scene holds.
#include "framework/scene/files/scene_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "framework/core/error.h"
#include "framework/scene/shapes/height_field.h"
#include "tests/unit/scene/files/scene_file_fixture.h"

namespace kaustik::scene {
namespace {

using test::SceneFile;
constexpr double kPi = glm::pi<double>();

const std::string kMaterial = "[[material]]\nname = 'm'\ntype = 'lambertian'\nalbedo = 0.5\n";

glm::dvec3 toWorld(const Object& object, const glm::dvec3& point) {
    return glm::dvec3(object.toWorld * glm::dvec4(point, 1.0));
}

void expectNear(const glm::dvec3& actual, const glm::dvec3& expected, double tolerance = 1e-6) {
    EXPECT_LT(glm::length(actual - expected), tolerance)
        << actual.x << " " << actual.y << " " << actual.z;
}

TEST_F(SceneFile, EmptyIsAnEmptySceneNamedAfterItsFile) {
    const Scene scene = load("");
    EXPECT_EQ(scene.name, "scene");
    EXPECT_EQ(scene.file, folder / "scene.toml");
    EXPECT_TRUE(scene.objects.empty());
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_TRUE(sceneBounds(scene).empty);
    EXPECT_EQ(triangleCount(scene), 0u);
}

TEST_F(SceneFile, ReadsTheTopLevelCameraAndMedium) {
    const Scene scene = load(R"(
        name = "n"
        description = "d"
        background_radiance = [1, 2, 3]
        ambient_irradiance = 4
        time = 1.5
        [camera]
        position = [1, 2, 3]
        target = [4, 5, 7]
        up = [0, 0, 2]
        vertical_fov_degrees = 30
        near = 0.5
        [medium]
        scattering_per_meter = 0.1
        absorption_per_meter = [0.1, 0.2, 0.3]
        anisotropy = -0.5
    )");
    EXPECT_EQ(scene.name, "n");
    EXPECT_EQ(scene.description, "d");
    EXPECT_EQ(scene.backgroundRadiance, glm::vec3(1, 2, 3));
    EXPECT_EQ(scene.ambientIrradiance, glm::vec3(4));
    EXPECT_EQ(scene.timeSeconds, 1.5);
    EXPECT_EQ(scene.camera.position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(scene.camera.target, glm::dvec3(4, 5, 7));
    EXPECT_EQ(scene.camera.up, glm::dvec3(0, 0, 1));
    EXPECT_EQ(scene.camera.verticalFovDegrees, 30.0);
    EXPECT_EQ(scene.camera.nearMeters, 0.5);
    ASSERT_TRUE(scene.medium.has_value());
    EXPECT_EQ(scene.medium->scatteringPerMeter, glm::vec3(0.1f));
    EXPECT_EQ(scene.medium->absorptionPerMeter, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(scene.medium->anisotropy, -0.5f);
}

TEST_F(SceneFile, ReadsLightsInTheirOwnUnits) {
    const Scene scene = load(R"(
        [[light]]
        name = "sun"
        type = "directional"
        direction = [0, -2, 0]
        irradiance = 1000
        color = [1, 0.5, 0]
        [[light]]
        name = "bulb"
        type = "point"
        position = [1, 2, 3]
        power_watts = 100
        range = 7
        [[light]]
        name = "lamp"
        type = "point"
        position = [0, 0, 0]
        intensity = 5
        color = 2
    )");
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[0].kind, LightKind::directional);
    EXPECT_EQ(scene.lights[0].direction, glm::dvec3(0, -1, 0));
    EXPECT_EQ(scene.lights[0].power, glm::vec3(1000, 500, 0));
    EXPECT_EQ(scene.lights[1].kind, LightKind::point);
    EXPECT_EQ(scene.lights[1].position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(scene.lights[1].rangeMeters, 7.0f);
    EXPECT_FLOAT_EQ(scene.lights[1].power.r, static_cast<float>(100.0 / (4.0 * kPi)));
    EXPECT_EQ(scene.lights[2].power, glm::vec3(10));
}

TEST_F(SceneFile, GivesASpotThePowerThatItsConeSendsOut) {
    const Scene scene = load(R"(
        [[light]]
        name = "spot"
        type = "spot"
        position = [0, 3, 0]
        direction = [0, -1, 0]
        inner_cone_degrees = 20
        outer_cone_degrees = 50
        power_watts = 60
    )");
    const Light& spot = scene.lights.at(0);
    EXPECT_FLOAT_EQ(spot.innerConeRadians, static_cast<float>(kPi / 9.0));
    EXPECT_FLOAT_EQ(spot.outerConeRadians, static_cast<float>(kPi / 3.6));
    // The flux by the midpoint rule over the angle; its error with 1e5 steps is below 1e-8.
    const int steps = 100000;
    double flux = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double angle = (i + 0.5) * kPi / steps;
        flux += double(spot.power.r) * spotFalloff(spot, std::cos(angle)) * 2.0 * kPi *
                std::sin(angle) * kPi / steps;
    }
    EXPECT_NEAR(flux, 60.0, 1e-4);  // the intensity and the cones are floats
    EXPECT_EQ(spotFalloff(spot, std::cos(0.3)), 1.0);
    EXPECT_EQ(spotFalloff(spot, std::cos(0.9)), 0.0);
    EXPECT_EQ(spotFalloff(spot, -1.0), 0.0);
}

TEST_F(SceneFile, AimsASpotsTextureAsItsFileSays) {
    write("slide.PFM", "never opened here");
    const std::string spot =
        "[[light]]\nname='s'\ntype='spot'\nposition=[0,3,0]\nintensity=1\ntexture='slide.PFM'\n"
        "outer_cone_degrees = 45\n";
    const Scene down = load(spot + "direction = [0, -2, 0]\n");
    ASSERT_EQ(down.images.size(), 1u);
    EXPECT_FALSE(down.images[0].srgb);  // a float image holds linear light
    EXPECT_EQ(down.lights[0].image, 0);
    EXPECT_EQ(down.lights[0].up, glm::dvec3(0, 0, -1));
    const Scene tilted = load(spot + "direction = [1, 0, 0]\nup = [5, 0, 3]\n");
    const Light& light = tilted.lights[0];
    EXPECT_LT(glm::length(light.up - glm::dvec3(0, 0, 1)), 1e-15);
    const auto at = [&](const glm::dvec3& direction) {
        return spotImagePosition(light, glm::normalize(direction));
    };
    // The middle on the axis; the side's middle at 45 degrees; the right is seen from behind the
    // light: with +x ahead and +z up that is -y. Doubles, but for the half-angle: 1e-7.
    EXPECT_LT(glm::length(at({1, 0, 0}) - glm::dvec2(0.5, 0.5)), 1e-15);
    EXPECT_LT(glm::length(at({1, 0, 1}) - glm::dvec2(0.5, 1.0)), 1e-7);
    EXPECT_LT(glm::length(at({1, -1, 0}) - glm::dvec2(1.0, 0.5)), 1e-7);
    EXPECT_LT(glm::length(at({4, 2, -1}) - glm::dvec2(0.25, 0.375)), 1e-7);
}

TEST_F(SceneFile, ReadsGlossyReceivers) {
    const Scene scene = load(
        "[[material]]\nname = 'm'\ntype = 'glossy'\nalbedo = 0.7\nspecular = [0.1, 0.2, 0.3]\n"
        "exponent = 80\npattern = 'checker'\nuv_scale = 3\n");
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(material.kind, MaterialKind::glossy);
    EXPECT_TRUE(isReceiver(material.kind));
    EXPECT_EQ(material.albedo, glm::vec3(0.7f));
    EXPECT_EQ(material.specular, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(material.exponent, 80.0f);
    EXPECT_EQ(material.pattern, Pattern::checker);
    EXPECT_EQ(material.uvScale, glm::vec2(3.0f));
}

TEST_F(SceneFile, ReadsMaterials) {
    write("wood.png", "not read here");
    const Scene scene = load(R"(
        [[material]]
        name = "tiles"
        type = "lambertian"
        albedo = [0.1, 0.2, 0.3]
        pattern = "tiles"
        pattern_albedo = [0.4, 0.5, 0.6]
        uv_scale = [4, 5]
        [[material]]
        name = "wood"
        type = "lambertian"
        albedo = 1
        texture = "wood.png"
        [[material]]
        name = "wood again"
        type = "lambertian"
        albedo = 0.5
        texture = "wood.png"
        uv_scale = 3
        [[material]]
        name = "glass"
        type = "dielectric"
        ior = 1.7
        absorption_per_meter = [1, 2, 3]
        [[material]]
        name = "silver"
        type = "mirror"
        reflectance = 0.9
    )");
    ASSERT_EQ(scene.materials.size(), 5u);
    EXPECT_EQ(scene.materials[0].albedo, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(scene.materials[0].pattern, Pattern::tiles);
    EXPECT_EQ(scene.materials[0].patternAlbedo, glm::vec3(0.4f, 0.5f, 0.6f));
    EXPECT_EQ(scene.materials[0].uvScale, glm::vec2(4, 5));
    EXPECT_EQ(scene.materials[0].image, -1);
    ASSERT_EQ(scene.images.size(), 1u);
    EXPECT_EQ(scene.images[0].file, folder / "wood.png");
    EXPECT_EQ(scene.materials[1].image, 0);
    EXPECT_EQ(scene.materials[2].image, 0);
    EXPECT_EQ(scene.materials[2].uvScale, glm::vec2(3));
    EXPECT_EQ(scene.materials[3].kind, MaterialKind::dielectric);
    EXPECT_EQ(scene.materials[3].ior, 1.7f);
    EXPECT_EQ(scene.materials[3].absorptionPerMeter, glm::vec3(1, 2, 3));
    EXPECT_EQ(scene.materials[4].kind, MaterialKind::mirror);
    EXPECT_EQ(scene.materials[4].albedo, glm::vec3(0.9f));
}

TEST_F(SceneFile, ReadsEveryShapeWithItsKeys) {
    struct Case {
        const char* keys;
        std::size_t triangles;
        bool closed;
        glm::dvec3 extent;
    };
    const double base = 2.0 * std::tan(kPi / 6.0);
    const std::vector<Case> cases{
        {"shape='plane'\nsize=[2,3]\ncells=[4,5]", 40, false, {2, 0, 3}},
        {"shape='plane'\nsize=[2,3]\ncells=2", 8, false, {2, 0, 3}},
        {"shape='box'\nsize=[1,2,3]", 12, true, {1, 2, 3}},
        {"shape='box'\nsize=[1,2,3]\ninward=true\nopen=['+y','-z']", 8, false, {1, 2, 3}},
        {"shape='sphere'\nradius=2\nsegments=8", 48, true, {4, 4, 4}},
        {"shape='cylinder'\nradius=1\nheight=3\nsegments=8", 32, true, {2, 3, 2}},
        {"shape='cylinder'\nradius=1\nheight=3\nsegments=8\nopen=true\ninward=true",
         16,
         false,
         {2, 3, 2}},
        {"shape='ring'\ninner_radius=1\nouter_radius=2\nheight=3\nsegments=8", 64, true, {4, 3, 4}},
        {"shape='torus'\nradius=2\ntube_radius=1\nsegments=8\ntube_segments=4",
         64,
         true,
         {6, 2, 6}},
        {"shape='lens'\ntop_radius=0\nbottom_radius=0\ndiameter=2\ncenter_thickness=1\nsegments=8",
         32,
         true,
         {2, 1, 2}},
        {"shape='lens'\ntop_radius=1\nbottom_radius=1\ndiameter=2\nedge_thickness=1\nsegments=8",
         64,
         true,
         {2, 3, 2}},
        {"shape='prism'\napex_degrees=60\nheight=1\nlength=4", 8, true, {base, 1, 4}},
        {"shape='paraboloid'\nfocal_length=1\ndiameter=4\nsegments=8", 56, false, {4, 1, 4}},
        {"shape='water'\nsize=[2,3]\ncells=[4,5]", 40, false, {2, 0, 3}},
    };
    for (const Case& one : cases) {
        SCOPED_TRACE(one.keys);
        const Scene scene =
            load(kMaterial + "[[object]]\nname = 'o'\nmaterial = 'm'\n" + one.keys + "\n");
        ASSERT_EQ(scene.objects.size(), 1u);
        EXPECT_EQ(triangleCount(scene), one.triangles);
        EXPECT_EQ(scene.meshes[0].closed, one.closed);
        const Bounds bounds = sceneBounds(scene);
        expectNear(bounds.maximum - bounds.minimum, one.extent);
    }
}

TEST_F(SceneFile, ReadsWavesInEitherSpelling) {
    const std::string head =
        kMaterial + "[[object]]\nname='w'\nmaterial='m'\nshape='water'\nsize=[1,1]\n";
    const std::string inlineWaves =
        "waves=[{amplitude=0.1, wavelength=2, direction_degrees=30, phase=1, omega=4}, "
        "{amplitude=0.2, wavelength=3}]\n";
    const std::string tables =
        "[[object.wave]]\namplitude=0.1\nwavelength=2\ndirection_degrees=30\nphase=1\nomega=4\n"
        "[[object.wave]]\namplitude=0.2\nwavelength=3\n";
    for (const std::string& waves : {inlineWaves, tables}) {
        const Scene scene = load("time = 0.25\n" + head + waves);
        const Mesh& mesh = scene.meshes.at(0);
        ASSERT_TRUE(mesh.heightField.has_value());
        ASSERT_EQ(mesh.heightField->waves.size(), 2u);
        const Wave& first = mesh.heightField->waves[0];
        EXPECT_EQ(first.amplitudeMeters, 0.1f);
        EXPECT_EQ(first.wavelengthMeters, 2.0f);
        EXPECT_EQ(first.directionDegrees, 30.0f);
        EXPECT_EQ(first.phaseRadians, 1.0f);
        EXPECT_EQ(first.omegaRadiansPerSecond, 4.0f);
        EXPECT_LT(mesh.heightField->waves[1].omegaRadiansPerSecond, 0.0f);
        EXPECT_EQ(mesh.heightField->cells, glm::uvec2(128));
        EXPECT_EQ(mesh.positions, makeHeightField(*mesh.heightField, 0.25).positions);
    }
}

TEST_F(SceneFile, PlacesObjectsByScaleThenRotationAboutXYZThenPosition) {
    const std::string head =
        kMaterial + "[[object]]\nname='o'\nmaterial='m'\nshape='plane'\nsize=[1,1]\n";
    const Scene one =
        load(head + "position=[10,20,30]\nrotation_degrees=[90,0,0]\nscale=[1,2,3]\n");
    // x stays, y turns to z, z to -y.
    expectNear(toWorld(one.objects[0], {1, 0, 0}), {11, 20, 30});
    expectNear(toWorld(one.objects[0], {0, 1, 0}), {10, 20, 32});
    expectNear(toWorld(one.objects[0], {0, 0, 1}), {10, 17, 30});
    // About x first (y to z), then about the fixed y axis (z to x).
    const Scene two = load(head + "rotation_degrees=[90,90,0]\nscale=2\n");
    expectNear(toWorld(two.objects[0], {0, 1, 0}), {2, 0, 0});
    const Scene three = load(head + "rotation_degrees=[0,0,90]\n");
    expectNear(toWorld(three.objects[0], {1, 0, 0}), {0, 1, 0});
}

TEST_F(SceneFile, FindsMeshesBesideItselfAndInTheMeshFolder) {
    const std::string object =
        kMaterial + "[[object]]\nname='o'\nmaterial='m'\nmesh='only-for-this-test.obj'\n";
    write("elsewhere/only-for-this-test.obj", test::kTetrahedron);
    ::setenv("KAUSTIK_MESHES", (folder / "elsewhere").c_str(), 1);
    EXPECT_EQ(triangleCount(load(object)), 4u);
    ::unsetenv("KAUSTIK_MESHES");
    write("only-for-this-test.obj", test::kTetrahedron);
    const Scene scene = load(object);
    EXPECT_EQ(triangleCount(scene), 4u);
    EXPECT_TRUE(scene.meshes[0].closed);
}

TEST_F(SceneFile, ReadsAMeshThatTwoObjectsUseOnce) {
    write("t.obj", test::kTetrahedron);
    const Scene scene = load(kMaterial +
                             "[[object]]\nname='a'\nmaterial='m'\nmesh='t.obj'\n"
                             "[[object]]\nname='b'\nmaterial='m'\nmesh='t.obj'\nscale=2\n");
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(triangleCount(scene), 8u);
}

TEST_F(SceneFile, FitsAMeshAndStandsItOnAPlane) {
    write("t.obj", test::kTetrahedron);
    const std::string object = kMaterial + "[[object]]\nname='o'\nmaterial='m'\nmesh='t.obj'\n";
    const Bounds untouched = sceneBounds(load(object + "position=[1,0,0]\n"));
    expectNear(untouched.minimum, {1, 0, 0});
    expectNear(untouched.maximum, {2, 2, 1});
    const Bounds standing =
        sceneBounds(load(object + "fit={height=0.5}\nrest_on=-1\nposition=[3,0.25,4]\n"));
    expectNear(standing.minimum, {3 - 0.125, -0.75, 4 - 0.125});
    expectNear(standing.maximum, {3 + 0.125, -0.25, 4 + 0.125});
    const Bounds centred = sceneBounds(load(object + "fit={size=4}\nposition=[0,5,0]\n"));
    expectNear(centred.minimum, {-1, 3, -1});
    expectNear(centred.maximum, {1, 7, 1});
    const Bounds lying =
        sceneBounds(load(object + "fit={height=1}\nrotation_degrees=[0,0,90]\nrest_on=0\n"));
    expectNear(lying.minimum, {-1, 0, -0.5});
    expectNear(lying.maximum, {1, 1, 0.5});
    const Bounds resting = sceneBounds(load(object + "scale=3\nrest_on=2\n"));
    expectNear(resting.minimum, {-1.5, 2, -1.5});
    expectNear(resting.maximum, {1.5, 8, 1.5});
}

}  // namespace
}  // namespace kaustik::scene
