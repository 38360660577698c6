// SPDX-License-Identifier: MIT
// Glossy receivers and textured spots on the device against closed forms.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/core/files.h"
#include "framework/image/image.h"
#include "framework/scene/files/scene_file.h"
#include "framework/transport/brdf.h"
#include "tests/gpu/fixture.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::test {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(GlossyReceivers, StillWaterGivesAGlossyFloorTheClosedFormRadiance) {
    scene::Scene scene = scene::loadScene("flat-water");
    for (scene::Material& material : scene.materials) {
        if (material.name != "tiles") continue;
        material.kind = scene::MaterialKind::glossy;
        material.pattern = scene::Pattern::none;
        material.albedo = {0.5f, 0.25f, 0.0f};
        material.specular = {0.0f, 0.25f, 0.5f};
        // The sun is mirrored straight up; the eye looks down at 20 degrees from that.
        material.exponent = 12.0f;
    }
    const Frame frame(scene, 400, 300, {}, {"caustic.radiance"});
    const Texels receiver = frame.read("eye.receiver");
    const Texels radiance = frame.read("caustic.radiance");
    const Texels irradiance = frame.causticIrradiance();
    const double closed = 1000.0 * (1.0 - std::pow(0.333 / 2.333, 2));
    const glm::dvec3 up(0.0, 1.0, 0.0);
    int floorPixels = 0;
    double worst = 0.0;
    double worstAgainstOwn = 0.0;
    for (int y = 0; y < receiver.height; ++y) {
        for (int x = 0; x < receiver.width; ++x) {
            const auto depth = static_cast<double>(receiver.at(x, y, 0));
            const glm::dvec3 world = frame.worldAt(x, y, depth);
            // Away from the walls, as in flat_water_test.cpp.
            if (depth <= 0.0 || std::abs(world.y + 1.2) > 1e-3 || std::abs(world.x) > 1.8 ||
                std::abs(world.z) > 1.3) {
                continue;
            }
            ++floorPixels;
            const glm::dvec3 toEye = glm::normalize(scene.camera.position - world);
            const glm::dvec3 brdf =
                transport::receiverBrdf({0.5, 0.25, 0.0}, {0.0, 0.25, 0.5}, 12.0, up, up, toEye);
            for (int c = 0; c < 3; ++c) {
                const double value = radiance.rgb(x, y)[c];
                worst = std::max(worst, std::abs(value / (closed * brdf[c]) - 1.0));
                const double own = irradiance.rgb(x, y)[c] * brdf[c];
                worstAgainstOwn = std::max(worstAgainstOwn, std::abs(value / own - 1.0));
            }
        }
    }
    RecordProperty("worst_ppm", static_cast<int>(1e6 * worst));
    RecordProperty("worst_against_own_ppm", static_cast<int>(1e6 * worstAgainstOwn));
    EXPECT_GT(floorPixels, 20000);
    // 1 % is what the irradiance keeps to. The BRDF on it adds the rounding of directions, 1e-6
    // times the exponent; these albedos are exact in the eye buffer's 16 bits.
    EXPECT_LT(worst, 1e-2);
    EXPECT_LT(worstAgainstOwn, 3e-5);
}

TEST(GlossyReceivers, HaveTheirPassesOnlyWhereTheSceneHasOne) {
    scene::Scene scene = scene::loadScene("glossy-table");
    const Frame glossy(scene, 64, 48, {{"emit.photons", "16x16"}});
    EXPECT_TRUE(glossy.renderer().graph().find("caustic.radiance").valid());
    EXPECT_TRUE(glossy.renderer().graph().find("direct.radiance").valid());
    for (scene::Material& material : scene.materials) {
        if (isReceiver(material.kind)) material.kind = scene::MaterialKind::lambertian;
    }
    const Frame matt(scene, 64, 48, {{"emit.photons", "16x16"}});
    EXPECT_FALSE(matt.renderer().graph().find("caustic.radiance").valid());
    EXPECT_FALSE(matt.renderer().graph().find("direct.radiance").valid());
}

// A lobe of nothing: the picture must be the Lambertian's, though it takes the other way there.
// By reconstructions that store what glossy and matt receivers get alike: wide beams of triangles
// that are not joined go to matt ones by squares of pixels (triangles_pixel_blocks.glsl).
TEST(GlossyReceivers, WithoutSpecularReflectanceLookLambertian) {
    scene::Scene without = scene::loadScene("glossy-table");
    for (scene::Material& material : without.materials)
        material.specular = glm::vec3(0.0f);
    scene::Scene lambertian = without;
    for (scene::Material& material : lambertian.materials) {
        if (isReceiver(material.kind)) material.kind = scene::MaterialKind::lambertian;
    }
    for (const Settings& settings :
         {Settings{{"emit.photons", "64x64"}, {"reconstruct.triangles.unjoined", "discard"}},
          Settings{{"emit.photons", "64x64"}, {"reconstruct", "beams"}}}) {
        const auto radiance = [&](const scene::Scene& scene) {
            return Frame(scene, 160, 120, settings, {"compose.receiver_radiance"})
                .read("compose.receiver_radiance");
        };
        const Texels glossy = radiance(without);
        const Texels matt = radiance(lambertian);
        float largest = 0.0f;
        for (std::size_t i = 0; i < matt.values.size(); ++i) {
            const float difference = std::abs(glossy.values[i] - matt.values[i]);
            // Sums of up to hundreds of splats in 32 bits, multiplied before or after.
            EXPECT_LE(difference, 1e-4f * matt.values[i] + 1e-6f);
            largest = std::max(largest, matt.values[i]);
        }
        EXPECT_GT(largest, 1.0f);
    }
}

// The same place for the same uv as in the reference (tests/accuracy/glossy_test.cpp): (0, 0) is
// the image's lower left.
TEST(GlossyReceivers, WearTheirImageAsTheReferenceDoes) {
    const TemporaryFolder folder;
    // Red grows to the right, green upwards.
    Image image(64, 32, 3);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 64; ++x) {
            image.at(x, y, 0) = (static_cast<float>(x) + 0.5f) / 64.0f;
            image.at(x, y, 1) = 1.0f - (static_cast<float>(y) + 0.5f) / 32.0f;
            image.at(x, y, 2) = 0.5f;
        }
    }
    writeImage(folder / "floor.pfm", image);
    writeFileWhole(folder / "scene.toml", R"(
        [camera]
        position = [0, 3, 0]
        up = [0, 0, -1]
        [[material]]
        name = "printed"
        type = "glossy"
        albedo = [0.5, 0.8, 0.5]
        specular = 0.2
        texture = "floor.pfm"
        uv_scale = 0.5
        [[object]]
        name = "floor"
        shape = "plane"
        material = "printed"
        size = [2, 2]
    )");
    const scene::Scene scene = scene::loadSceneFile(folder / "scene.toml");
    const Frame frame(scene, 128, 128, {}, {"eye.receiver_albedo"});
    const Texels receiver = frame.read("eye.receiver");
    const Texels albedo = frame.read("eye.receiver_albedo");
    // The plane's uv in metres, from its mesh.
    const scene::Mesh& mesh = scene.meshes[0];
    const auto uvAt = [&](const glm::dvec3& world) {
        glm::dvec2 uv(mesh.uvs[0]);
        for (std::size_t i = 1; i < mesh.positions.size(); ++i) {
            const glm::dvec3 side(mesh.positions[i] - mesh.positions[0]);
            if (side.x != 0.0 && side.z != 0.0) continue;  // the far corner
            uv += glm::dvec2(mesh.uvs[i] - mesh.uvs[0]) *
                  glm::dot(world - glm::dvec3(mesh.positions[0]), side) / glm::dot(side, side);
        }
        return uv;
    };
    int tested = 0;
    for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 128; ++x) {
            const auto depth = static_cast<double>(receiver.at(x, y, 0));
            if (depth <= 0.0) continue;
            const glm::dvec2 at = 0.5 * uvAt(frame.worldAt(x, y, depth));
            // Away from the edges, where the image begins again.
            if (glm::min(at.x, at.y) < 0.1 || glm::max(at.x, at.y) > 0.9) continue;
            ++tested;
            // 11 bits in the image and in the eye buffer, and filters of 8 bits.
            EXPECT_NEAR(albedo.at(x, y, 0), 0.5 * at.x, 2e-3);
            EXPECT_NEAR(albedo.at(x, y, 1), 0.8 * at.y, 2e-3);
            EXPECT_NEAR(albedo.at(x, y, 2), 0.25, 2e-3);
        }
    }
    EXPECT_GT(tested, 3000);
}

class TexturedSpot : public testing::Test {
  protected:
    // A spot above an interface that bends nothing, above a floor; only the interface's half x < 0
    // is there, so that light comes to the floor both as caustic and directly.
    scene::Scene load(const Image& image) const {
        writeImage(folder_ / "slide.pfm", image);
        writeFileWhole(folder_ / "scene.toml", R"(
            [camera]
            position = [0, 5.2, 0]
            up = [0, 0, -1]
            vertical_fov_degrees = 40
            [[light]]
            name = "spot"
            type = "spot"
            position = [0, 3, 0]
            direction = [0.1, -1, 0.05]
            up = [0.2, 0, -1]
            intensity = 100
            inner_cone_degrees = 15
            outer_cone_degrees = 35
            texture = "slide.pfm"
            [[material]]
            name = "white"
            type = "lambertian"
            albedo = 0.8
            [[material]]
            name = "nothing"
            type = "dielectric"
            ior = 1
            [[object]]
            name = "floor"
            shape = "plane"
            material = "white"
            size = [8, 8]
            [[object]]
            name = "pane"
            shape = "plane"
            material = "nothing"
            size = [4, 8]
            position = [-2, 1, 0]
        )");
        return scene::loadSceneFile(folder_ / "scene.toml");
    }
    // Irradiance of the floor by hand.
    static double irradianceAt(const scene::Light& light, const glm::dvec3& point, double color) {
        const glm::dvec3 toPoint = point - light.position;
        const double distance = glm::length(toPoint);
        const double cosine = glm::dot(toPoint, light.direction) / distance;
        return 100.0 * color * scene::spotFalloff(light, cosine) * (-toPoint.y / distance) /
               (distance * distance);
    }
    const TemporaryFolder folder_;
};

TEST_F(TexturedSpot, ShowsItsImageInDirectLightAndInCaustics) {
    // Gradients, which bilinear filtering and mip levels keep: red grows to the right, green
    // upwards.
    Image image(64, 64, 3);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            image.at(x, y, 0) = (static_cast<float>(x) + 0.5f) / 64.0f;
            image.at(x, y, 1) = 1.0f - (static_cast<float>(y) + 0.5f) / 64.0f;
            image.at(x, y, 2) = 0.5f;
        }
    }
    const scene::Scene scene = load(image);
    const scene::Light& light = scene.lights[0];
    const Frame frame(scene, 200, 200, {}, {"direct.irradiance"});
    const Texels receiver = frame.read("eye.receiver");
    const Texels direct = frame.read("direct.irradiance");
    const Texels caustic = frame.causticIrradiance();
    // The pane's edge is at x = 0, its shadow there too.
    constexpr int kBlock = 20;
    int directPixels = 0;
    int causticBlocks = 0;
    for (int block = 0; block < (200 / kBlock) * (200 / kBlock); ++block) {
        glm::dvec3 sum(0.0);
        glm::dvec3 closed(0.0);
        bool isWhole = true;
        for (int i = 0; i < kBlock * kBlock; ++i) {
            const int x = block % (200 / kBlock) * kBlock + i % kBlock;
            const int y = block / (200 / kBlock) * kBlock + i / kBlock;
            const glm::dvec3 world = frame.worldAt(x, y, static_cast<double>(receiver.at(x, y, 0)));
            const glm::dvec3 toPoint = glm::normalize(world - light.position);
            // Within 28 degrees: where the cone's flank is not dark.
            const bool isLit = glm::dot(toPoint, light.direction) > std::cos(28.0 * kPi / 180.0);
            isWhole = isWhole && isLit && world.x < -0.2;
            if (!isLit) continue;
            const glm::dvec2 at = spotImagePosition(light, toPoint);
            const glm::dvec3 expected =
                irradianceAt(light, world, 1.0) * glm::dvec3(at.x, at.y, 0.5);
            sum += caustic.rgb(x, y);
            closed += expected;
            if (world.x < 0.2) continue;
            ++directPixels;
            // Images are of 11 bits.
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(direct.rgb(x, y)[c], expected[c], 2e-3 * expected[c] + 1e-3);
        }
        if (!isWhole) continue;
        ++causticBlocks;
        // Photons lie 5 cm apart and their splats reach 12 cm: over a block of 38 cm they count
        // exactly, but for those at its edge.
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(sum[c], closed[c], 0.04 * closed[c]) << block << ", channel " << c;
    }
    EXPECT_GT(directPixels, 3000);
    EXPECT_GT(causticBlocks, 5);
}

TEST_F(TexturedSpot, EmitsTheClosedFormFluxOfTheHalfThatIsWhite) {
    Image image(2, 2, 3);
    for (std::size_t i = 0; i < image.values.size(); ++i)
        image.values[i] = i % 6 < 3 ? 0.0f : 1.0f;  // the right column
    scene::Scene scene = load(image);
    scene.objects[1].toWorld[3].x = 0.0;  // the pane under the whole cone
    const scene::Light& light = scene.lights[0];
    const double inner = std::cos(static_cast<double>(light.innerConeRadians));
    const double outer = std::cos(static_cast<double>(light.outerConeRadians));
    const double whole = 100.0 * 2.0 * kPi * ((1.0 - inner) + (inner - outer) / 3.0);
    Frame frame(scene, 64, 64);
    // Between two texels the ramp is even about the middle: half of the flux in each channel. The
    // grid samples it at 256 by 256 points over a pane five times as large as the cone: one part in
    // 1e3.
    EXPECT_NEAR(frame.renderer().ledger().watts[transport::kAccountEmitted], 0.5 * whole,
                1e-3 * whole / 3.0);
}

}  // namespace
}  // namespace kaustik::test
