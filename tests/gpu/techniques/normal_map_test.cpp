// SPDX-License-Identifier: MIT
// Dielectrics and mirrors with a normal map: light goes where it would from a surface that is
// turned as the map says, whichever stage sees it, and the reference agrees.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "framework/core/error.h"
#include "framework/image/image.h"
#include "framework/numerics/cases/scene_text.h"
#include "framework/scene/files/scene_file.h"
#include "tests/gpu/fixture.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::test {
namespace {

constexpr double kDepth = 1.0;  // of the floor below the surface, m
constexpr double kIrradiance = 1000.0;
constexpr const char* kPlace = "position = [0, 1, 0]";

// Texels of 32-bit floats, since 8 bits are half a degree.
void writeMap(const std::filesystem::path& file, int side, const auto& normalAt) {
    Image image(side, side, 3);
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            // Row 0 is the top, where v is 1.
            const glm::dvec3 normal = normalAt((column + 0.5) / side, 1.0 - (row + 0.5) / side);
            for (int c = 0; c < 3; ++c)
                image.at(column, row, c) = static_cast<float>(0.5 + 0.5 * normal[c]);
        }
    }
    writeImage(file, image);
}

// Below a small sun straight above, a sheet of water or a mirror whose plane is horizontal.
std::string sceneOf(const std::string& material, const std::string& keys,
                    const std::string& place) {
    return fmt::format(R"(
name = "map"
[camera]
position = [0, 6, 0.01]
target = [0, 0, 0]
vertical_fov_degrees = 60
[[light]]
name = "sun"
type = "directional"
direction = [0, -1, 0]
irradiance = {}
[[material]]
name = "grey"
type = "lambertian"
albedo = 0.5
[[material]]
name = "bent"
type = "{}"
{}
[[object]]
name = "floor"
shape = "plane"
material = "grey"
size = [8, 8]
[[object]]
name = "surface"
shape = "plane"
material = "bent"
size = [1, 1]
{}
)",
                       kIrradiance, material, keys, place);
}

class NormalMap : public testing::Test {
  protected:
    scene::Scene load(const std::string& text) {
        return scene::loadScene(folder_.file("map.toml", text).string());
    }
    // The mean of where the caustic's light lies, m.
    static glm::dvec3 middleOf(const Frame& frame) {
        const Texels receiver = frame.read("eye.receiver");
        const Texels irradiance = frame.causticIrradiance();
        glm::dvec3 sum(0.0);
        double all = 0.0;
        for (int y = 0; y < receiver.height; ++y) {
            for (int x = 0; x < receiver.width; ++x) {
                const double area = static_cast<double>(receiver.at(x, y, 1));
                const double flux = irradiance.rgb(x, y).g * area;
                if (!(flux > 0.0)) continue;
                sum += flux * frame.worldAt(x, y, static_cast<double>(receiver.at(x, y, 0)));
                all += flux;
            }
        }
        return sum / all;
    }
    TemporaryFolder folder_;
};

// Sheets of water: how far a normal that is turned by θ throws the light, d tan(θ - asin(sin θ /
// n)), towards the other side than the normal leans to.
double thrown(double angle) {
    return kDepth * std::tan(angle - std::asin(std::sin(angle) / numerics::kWaterIndex));
}

TEST_F(NormalMap, OfConstantTiltRefractsLikeATiltedPlane) {
    const double angle = 0.3;
    for (const bool isAlongV : {false, true}) {
        writeMap(folder_ / "tilt.pfm", 4, [&](double, double) {
            const double sine = std::sin(angle);
            return isAlongV ? glm::dvec3(0.0, sine, std::cos(angle))
                            : glm::dvec3(sine, 0.0, std::cos(angle));
        });
        const scene::Scene scene =
            load(sceneOf("dielectric", "ior = 1.333\nnormal_map = 'tilt.pfm'", kPlace));
        for (const char* technique :
             {"screen_space_photons", "raytraced", "caustic_map", "planar", "lens_splats"}) {
            if (std::string(technique) == "raytraced" && lacksExactTracer()) continue;
            SCOPED_TRACE(fmt::format("{}, along {}", technique, isAlongV ? "v" : "u"));
            const Frame frame(scene, 160, 160,
                              {{"emit.photons", "64x64"}, {"specular", "interface"}}, {}, false,
                              technique);
            const glm::dvec3 middle = middleOf(frame);
            // u grows along x, v along z. A pixel is 4 cm, whose mean is told much better.
            const glm::dvec2 expected =
                isAlongV ? glm::dvec2(0.0, -thrown(angle)) : glm::dvec2(-thrown(angle), 0.0);
            EXPECT_NEAR(middle.x, expected.x, 4e-3);
            EXPECT_NEAR(middle.z, expected.y, 4e-3);
        }
    }
}

// Light comes down at 45 degrees; a mirror that leans away from it by θ sends it up at 45 - 2 θ, to
// a wall 2 m away.
TEST_F(NormalMap, OfAMirrorTurnsLightByTwiceItsTiltTimesItsScale) {
    // Tangents are scaled: a map of 45 degrees at a tenth leans by atan 0.1.
    writeMap(folder_ / "tilt.pfm", 4,
             [](double, double) { return glm::dvec3(std::sqrt(0.5), 0.0, std::sqrt(0.5)); });
    scene::Scene scene =
        load(sceneOf("mirror", "normal_map = 'tilt.pfm'\nnormal_scale = 0.1", kPlace) +
             "[[object]]\nname = 'wall'\nshape = 'plane'\nmaterial = 'grey'\nsize = [8, 8]\n"
             "position = [2, 2, 0]\nrotation_degrees = [0, 0, 90]\n");
    scene.lights.front().direction = glm::normalize(glm::dvec3(1.0, -1.0, 0.0));
    scene.camera.position = {-3.0, 2.0, 0.01};
    scene.camera.target = {2.0, 2.0, 0.0};
    const double elevation = std::atan(1.0) - 2.0 * std::atan(0.1);
    for (const char* tracer : {"hierarchical", "raytraced"}) {
        if (std::string(tracer) == "raytraced" && lacksExactTracer()) continue;
        const Frame frame(scene, 160, 160, {{"emit.photons", "64x64"}, {"trace", tracer}});
        EXPECT_NEAR(middleOf(frame).y, kDepth + 2.0 * std::tan(elevation), 1e-2) << tracer;
    }
}

// A map is the surface that it was made of, as far as that is flat: crests focus light where the
// height field does.
TEST_F(NormalMap, OfWavesIsTheCausticOfTheirHeightField) {
    constexpr double kAmplitude = 0.01;
    constexpr double kWave = 0.35;
    const double k = 2.0 * 3.141592653589793 / kWave;
    // y = A cos k x, x from -0.5 to 0.5 as u from 0 to 1.
    writeMap(folder_ / "waves.pfm", 256, [&](double u, double) {
        const double slope = -kAmplitude * k * std::sin(k * (u - 0.5));
        return glm::normalize(glm::dvec3(-slope, 0.0, 1.0));
    });
    const scene::Scene mapped =
        load(sceneOf("dielectric", "ior = 1.333\nnormal_map = 'waves.pfm'", kPlace));
    std::string text = sceneOf("dielectric", "ior = 1.333", kPlace);
    const std::string plane = "name = \"surface\"\nshape = \"plane\"";
    text.replace(text.find(plane), plane.size(),
                 fmt::format("name = \"surface\"\nshape = \"water\"\ncells = [256, 4]\nwaves = "
                             "[{{amplitude = {}, wavelength = {}}}]",
                             kAmplitude, kWave));
    const scene::Scene real = load(text);
    const Settings settings{{"emit.photons", "128x128"}, {"specular", "interface"}};
    for (const char* tracer : {"hierarchical", "raytraced"}) {
        if (std::string(tracer) == "raytraced" && lacksExactTracer()) continue;
        SCOPED_TRACE(tracer);
        Settings with = settings;
        with.push_back({"trace", tracer});
        const Frame ours(mapped, 200, 200, with);
        const Frame theirs(real, 200, 200, with);
        const Texels a = ours.causticIrradiance();
        const Texels b = theirs.causticIrradiance();
        double difference = 0.0;
        double sum = 0.0;
        double largest = 0.0;
        for (int y = 0; y < 200; ++y) {
            for (int x = 0; x < 200; ++x) {
                difference += std::abs(a.rgb(x, y).g - b.rgb(x, y).g);
                sum += b.rgb(x, y).g;
                largest = std::max(largest, b.rgb(x, y).g);
            }
        }
        // It is a caustic, and the same one: heights of 1 cm move light by less than a millimetre.
        EXPECT_GT(largest, 2.0 * kIrradiance);
        EXPECT_LT(difference, 0.02 * sum) << difference / sum;
    }
}

TEST_F(NormalMap, IsRefusedWhereLightStartsAtVertices) {
    writeMap(folder_ / "flat.pfm", 2, [](double, double) { return glm::dvec3(0, 0, 1); });
    const scene::Scene scene =
        load(sceneOf("dielectric", "ior = 1.333\nnormal_map = 'flat.pfm'", kPlace));
    EXPECT_THROW(Frame(scene, 32, 32, {{"emit", "vertices"}}), ConfigError);
}

// An even map changes no bit that matters: the flat surface's own caustic.
TEST_F(NormalMap, ThatIsFlatIsTheSurfaceWithoutOne) {
    writeMap(folder_ / "flat.pfm", 8, [](double, double) { return glm::dvec3(0, 0, 1); });
    const scene::Scene with =
        load(sceneOf("dielectric", "ior = 1.333\nnormal_map = 'flat.pfm'", kPlace));
    const scene::Scene without = load(sceneOf("dielectric", "ior = 1.333", kPlace));
    const Settings settings{{"emit.photons", "64x64"}};
    const Texels a = Frame(with, 120, 90, settings).causticIrradiance();
    const Texels b = Frame(without, 120, 90, settings).causticIrradiance();
    for (int y = 0; y < 90; ++y) {
        for (int x = 0; x < 120; ++x)
            ASSERT_NEAR(a.rgb(x, y).g, b.rgb(x, y).g, 1e-3 * kIrradiance) << x << " " << y;
    }
}

}  // namespace
}  // namespace kaustik::test
