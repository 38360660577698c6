// SPDX-License-Identifier: MIT
// differential_area, light joined along the mesh of the water: against the closed form under still
// water up to its border, and under waves against rays that smooth_tracer.h follows in double.
#include <algorithm>
#include <cmath>
#include <optional>

#include "framework/numerics/cases/scene_text.h"
#include "framework/scene/files/scene_file.h"
#include "techniques/emit/vertices_grid.h"
#include "tests/gpu/fixture.h"
#include "tests/gpu/techniques/scene_parts.h"
#include "tests/gpu/techniques/smooth_tracer.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using namespace transport;
using glm::dvec2;
using glm::dvec3;

constexpr double kFloor = -1.0;
const std::string kFloorPlane = floorPlane("floor", "grey", 6.0, {0, kFloor, 0});
const CameraText kAbove{{0.0, 2.0, 0.6}, {0.0, kFloor, 0.0}, 45.0, 0.01};

Frame areasOf(const scene::Scene& scene, const Settings& settings = {}, int width = 240,
              int height = 180) {
    return {scene, width, height, settings, {}, false, "differential_area"};
}

// What a pixel sees of the floor.
struct FloorPixel {
    dvec2 place{0.0};    // x and z of its middle, m
    double width = 0.0;  // the side of the square of the same area, m
    double irradiance = 0.0;
};

std::vector<FloorPixel> floorPixels(const Frame& frame) {
    const Texels receiver = frame.read("eye.receiver");
    const Texels irradiance = frame.causticIrradiance();
    std::vector<FloorPixel> pixels;
    for (int y = 0; y < receiver.height; ++y) {
        for (int x = 0; x < receiver.width; ++x) {
            const double depth = double{receiver.at(x, y, 0)};
            if (depth <= 0.0) continue;
            const dvec3 world = frame.worldAt(x, y, depth);
            if (std::abs(world.y - kFloor) > 1e-3) continue;
            pixels.push_back({{world.x, world.z},
                              std::sqrt(double{receiver.at(x, y, 1)}),
                              irradiance.rgb(x, y).g});
        }
    }
    return pixels;
}

double straightTransmittance() {
    const double below = (kWaterIndex - 1.0) / (kWaterIndex + 1.0);
    return 1.0 - below * below;
}

std::string stillWater(const std::string& shape) {
    return object("water", shape, "water", {0, 0, 0}, "size = [1.6, 1.2]\ncells = [16, 12]");
}

TEST(DifferentialArea, FloorUnderStillWaterIsTheClosedFormUpToTheBorder) {
    for (const char* shape : {"water", "plane"}) {
        SCOPED_TRACE(shape);
        const scene::Scene scene =
            makeScene(kAbove, sun({0, -1, 0}) + stillWater(shape) + kFloorPlane);
        const Frame frame = areasOf(scene);
        const double expected = 1000.0 * straightTransmittance();
        int lit = 0;
        int corners = 0;
        int dark = 0;
        for (const FloorPixel& pixel : floorPixels(frame)) {
            // From the border of the light, m; negative beyond it.
            const dvec2 within = dvec2(0.8, 0.6) - glm::abs(pixel.place);
            const double inside = std::min(within.x, within.y);
            if (std::abs(inside) < pixel.width) continue;
            if (inside > 0.0) {
                ++lit;
                if (std::max(within.x, within.y) < 0.1) ++corners;
                // Cells are wider than pixels; 32-bit positions, and a pixel's area as its middle
                // sees it.
                EXPECT_NEAR(pixel.irradiance, expected, 3e-4 * expected)
                    << pixel.place.x << ", " << pixel.place.y;
            } else {
                ++dark;
                EXPECT_EQ(pixel.irradiance, 0.0) << pixel.place.x << ", " << pixel.place.y;
            }
        }
        EXPECT_GT(lit, 5000);
        EXPECT_GT(corners, 100);
        EXPECT_GT(dark, 5000);
    }
}

TEST(DifferentialArea, FloorOfFlatWaterIsTheClosedForm) {
    const scene::Scene scene = scene::loadScene("flat-water");
    const Frame frame = areasOf(scene, {}, 400, 300);
    const Texels receiver = frame.read("eye.receiver");
    const Texels irradiance = frame.causticIrradiance();
    const double expected = 1000.0 * straightTransmittance();
    double worst = 0.0;
    int pixels = 0;
    for (int y = 0; y < receiver.height; ++y) {
        for (int x = 0; x < receiver.width; ++x) {
            const double depth = double{receiver.at(x, y, 0)};
            if (depth <= 0.0) continue;
            const dvec3 world = frame.worldAt(x, y, depth);
            const bool isInside = std::abs(world.x) < 1.85 && std::abs(world.z) < 1.35;
            if (!isInside || std::abs(world.y + 1.2) > 1e-3) continue;
            ++pixels;
            worst = std::max(worst, std::abs(irradiance.rgb(x, y).g / expected - 1.0));
        }
    }
    RecordProperty("worst_ppm", static_cast<int>(1e6 * worst));
    EXPECT_GT(pixels, 20000);
    // As for triangles between the cells of a light's grid (flat_water_test.cpp).
    EXPECT_LT(worst, 3e-4);
}

// Waves of 2 m by 2 m, before their first focus, and the light that comes through them.
struct Waves {
    std::vector<SmoothWave> waves;
    dvec3 light{0.0, -1.0, 0.0};
};

const Waves kAlongX{{{0.008, 0.5, 0.0}}, {0, -1, 0}};
const Waves kCrossed{{{0.006, 0.5, 20.0}, {0.005, 0.6, 115.0}},
                     glm::normalize(dvec3(0.3, -1, 0.2))};

scene::Scene sceneOf(const Waves& water, int cells) {
    std::string waves;
    for (const SmoothWave& wave : water.waves) {
        waves += fmt::format(
            "{{amplitude = {}, wavelength = {}, direction_degrees = {}, phase = 0}}, ",
            number(wave.amplitude), number(wave.wavelength), number(wave.directionDegrees));
    }
    return makeScene(kAbove, sun(water.light) +
                                 object("water", "water", "water", {0, 0, 0},
                                        fmt::format("size = [2, 2]\ncells = [{0}, {0}]\n"
                                                    "waves = [{1}]",
                                                    cells, waves)) +
                                 kFloorPlane);
}

// Irradiance of the floor by the area that a small beam covers there: light of 1000 W/m² across its
// direction that crosses the plane y = 0 at x and z is followed to the floor.
class SmoothLight {
  public:
    explicit SmoothLight(const Waves& water)
        : light_(water.light), scene_(smoothWaves(water.waves, 4.0, kWaterIndex)) {
        const SmoothScene floor = smoothFloor(kFloor);
        scene_.insert(scene_.end(), floor.begin(), floor.end());
    }

    [[nodiscard]] double irradianceAt(const dvec2& place) const {
        // Newton's method from where it would arrive straight.
        dvec2 start = place - dvec2(light_.x, light_.z) / light_.y * kFloor;
        for (int i = 0; i < 30; ++i) {
            const dvec2 miss = arrivalOf(start) - place;
            if (glm::length(miss) < 1e-10) break;
            start -= glm::inverse(spreadAt(start)) * miss;
        }
        EXPECT_LT(glm::length(arrivalOf(start) - place), 1e-8);
        const SmoothHit hit = pathOf(start).front();
        const double flux = 1000.0 * -light_.y * transmittance(-glm::dot(light_, hit.normal));
        return flux / std::abs(glm::determinant(spreadAt(start)));
    }

  private:
    [[nodiscard]] std::vector<SmoothHit> pathOf(const dvec2& start) const {
        const dvec3 from = dvec3(start.x, 0.0, start.y) - light_;
        return followPath(scene_, {from, light_}, {false});
    }
    [[nodiscard]] dvec2 arrivalOf(const dvec2& start) const {
        const std::vector<SmoothHit> path = pathOf(start);
        EXPECT_EQ(path.size(), 2u);
        return {path.back().position.x, path.back().position.z};
    }
    // How the place of arrival changes with where the light starts.
    [[nodiscard]] glm::dmat2 spreadAt(const dvec2& start) const {
        const double step = 1e-5;
        const auto along = [&](const dvec2& side) {
            return (arrivalOf(start + step * side) - arrivalOf(start - step * side)) / (2.0 * step);
        };
        return {along({1, 0}), along({0, 1})};
    }
    // Unpolarised Fresnel into the water.
    static double transmittance(double cosine) {
        const double beyond =
            std::sqrt(1.0 - (1.0 - cosine * cosine) / (kWaterIndex * kWaterIndex));
        const double s = (cosine - kWaterIndex * beyond) / (cosine + kWaterIndex * beyond);
        const double p = (kWaterIndex * cosine - beyond) / (kWaterIndex * cosine + beyond);
        return 1.0 - 0.5 * (s * s + p * p);
    }

    dvec3 light_;
    SmoothScene scene_;
};

// Mean difference of the middle of the floor from it, as a share of the mean.
double errorOf(const Frame& frame, const SmoothLight& light) {
    double difference = 0.0;
    double total = 0.0;
    int number = 0;
    for (const FloorPixel& pixel : floorPixels(frame)) {
        if (std::abs(pixel.place.x) > 0.6 || std::abs(pixel.place.y) > 0.6) continue;
        if (++number % 3 != 0) continue;
        const double expected = light.irradianceAt(pixel.place);
        difference += std::abs(pixel.irradiance - expected);
        total += expected;
    }
    EXPECT_GT(number, 3000);
    return difference / total;
}

TEST(DifferentialArea, FloorUnderWavesIsTheClosedFormBeforeTheFirstFocus) {
    for (const Waves& water : {kAlongX, kCrossed}) {
        SCOPED_TRACE(water.waves.size());
        const SmoothLight light(water);
        const scene::Scene wide = sceneOf(water, 48);
        const scene::Scene narrow = sceneOf(water, 96);
        const double coarse = errorOf(areasOf(wide), light);
        const double fine = errorOf(areasOf(narrow), light);
        const Frame planar(narrow, 240, 180, {{"emit.photons", "97x97"}}, {}, false, "planar");
        const double grid = errorOf(planar, light);
        const std::string name = water.waves.size() == 1 ? "one_wave" : "two_waves";
        RecordProperty(name + "_coarse_ppm", static_cast<int>(1e6 * coarse));
        RecordProperty(name + "_fine_ppm", static_cast<int>(1e6 * fine));
        RecordProperty(name + "_planar_ppm", static_cast<int>(1e6 * grid));
        // Between vertices all is linear: a quarter of the error with cells half as wide.
        EXPECT_LT(fine, 0.35 * coarse);
        EXPECT_LT(fine, 0.01);
        // With as many photons no worse than those of a light's grid, give or take where they lie.
        EXPECT_LT(fine, 1.25 * grid);
    }
}

TEST(DifferentialArea, AllLightThatArrivesIsDeposited) {
    const std::string lamp =
        "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = [0.3, 1.5, 0.2]\n"
        "intensity = 300\n";
    const std::string waves = object(
        "water", "water", "water", {0, 0, 0},
        "size = [1.2, 0.9]\ncells = [24, 18]\nwaves = [{amplitude = 0.02, wavelength = 0.4}]");
    for (const std::string& light : {sun({0, -1, 0}), sun({0.2, -1, 0.1}), lamp}) {
        SCOPED_TRACE(light);
        const Frame frame = areasOf(makeScene({{0.0, 4.0, 0.6}, {0.0, kFloor, 0.0}, 60.0, 0.01},
                                              light + waves + kFloorPlane),
                                    {{"specular", "interface"}});
        const EnergyLedger ledger = frame.renderer().ledger();
        const double arrived = ledger.watts[kAccountArrived];
        EXPECT_GT(arrived, 0.0);
        EXPECT_NEAR(ledger.watts[kAccountDeposited], arrived, 1e-5 * arrived);
        EXPECT_LT(std::abs(ledger.balance()), 1e-6);
    }
}

TEST(DifferentialArea, KeepsEveryWattOfTheScenesOfWater) {
    for (const char* name : {"flat-water", "pool", "pool-reflections", "water-from-below"}) {
        SCOPED_TRACE(name);
        const scene::Scene scene = scene::loadScene(name);
        ASSERT_TRUE(specularGrid(scene));
        const Frame frame = areasOf(scene, {}, 160, 120);
        const EnergyLedger ledger = frame.renderer().ledger();
        EXPECT_GT(ledger.watts[kAccountDeposited], 0.0);
        EXPECT_LT(std::abs(ledger.balance()), 1e-6);
        for (const std::string& warning : frame.renderer().warnings())
            EXPECT_EQ(warning.find("joins nothing"), std::string::npos) << warning;
    }
}

const std::string kTwoLights =
    sun({0.2, -1.0, 0.1}) +
    "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = [0.3, 1.5, 0.2]\nintensity = 300\n";
const std::string kWavyWater = rippledWater({48, 36});

// The largest difference, as a share of the brightest pixel.
double largestDifference(const std::vector<float>& a, const std::vector<float>& b) {
    double brightest = 0.0;
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        brightest = std::max(brightest, double{a[i]});
        largest = std::max(largest, std::abs(double{a[i]} - double{b[i]}));
    }
    EXPECT_GT(brightest, 0.0);
    return largest / brightest;
}

TEST(DifferentialArea, BatchesAreTheLightOfAllAtOnce) {
    const scene::Scene scene = makeScene(kAbove, kTwoLights + kWavyWater + kFloorPlane);
    const Texels whole = areasOf(scene).causticIrradiance();
    for (const char* batch : {"49", "500"}) {
        SCOPED_TRACE(batch);
        const Texels parts = areasOf(scene, {{"emit.batch", batch}}).causticIrradiance();
        EXPECT_GT(parts.sum(), 0.0);
        EXPECT_EQ(whole.values, parts.values);
    }
}

TEST(DifferentialArea, TwoLightsAreTheSumOfEach) {
    const auto irradianceOf = [](const std::string& lights) {
        const scene::Scene scene = makeScene(kAbove, lights + kWavyWater + kFloorPlane);
        return areasOf(scene).causticIrradiance().values;
    };
    const std::size_t second = kTwoLights.find("[[light]]", 1);
    const std::vector<float> both = irradianceOf(kTwoLights);
    std::vector<float> sum = irradianceOf(kTwoLights.substr(0, second));
    const std::vector<float> other = irradianceOf(kTwoLights.substr(second));
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += other[i];
    // The unit of flux is another one, and the sums of floats.
    EXPECT_LE(largestDifference(both, sum), 1e-6);
}

TEST(DifferentialArea, SaysInOneSentenceWhyVerticesAreNotJoined) {
    const std::string ball =
        object("ball", "sphere", "glass", {0.2, 0.5, 0}, "radius = 0.3\nsegments = 24");
    const auto warningsOf = [](const std::string& objects) {
        const scene::Scene scene = makeScene(kAbove, sun({0, -1, 0}) + objects + kFloorPlane);
        const Frame frame = areasOf(scene, {{"specular", "two_interfaces"}});
        std::vector<std::string> found;
        for (const std::string& warning : frame.renderer().warnings()) {
            if (warning.find("joins nothing") != std::string::npos) found.push_back(warning);
        }
        return found;
    };
    EXPECT_TRUE(warningsOf(stillWater("water")).empty());
    const std::vector<std::string> one = warningsOf(ball);
    ASSERT_EQ(one.size(), 1u);
    EXPECT_NE(one[0].find("here 'ball' is specular"), std::string::npos) << one[0];
    const std::vector<std::string> two = warningsOf(stillWater("water") + ball);
    ASSERT_EQ(two.size(), 1u);
    EXPECT_NE(two[0].find("'water' and 'ball' are specular"), std::string::npos) << two[0];
}

TEST(VertexGrids, AreFoundInSheetsAlone) {
    const auto gridOfObject = [](const std::string& text) {
        const scene::Scene scene = makeScene(kAbove, sun({0, -1, 0}) + text + kFloorPlane);
        return specularGrid(scene);
    };
    for (const char* shape : {"water", "plane"}) {
        const std::optional<VertexGrid> grid = gridOfObject(stillWater(shape));
        ASSERT_TRUE(grid) << shape;
        EXPECT_EQ(grid->vertices, (params::Extent{17, 13})) << shape;
    }
    EXPECT_FALSE(
        gridOfObject(object("ball", "sphere", "glass", {0, 0, 0}, "radius = 0.3\nsegments = 24")));
    EXPECT_FALSE(gridOfObject(object("torus", "torus", "glass", {0, 0, 0},
                                     "radius = 0.3\ntube_radius = 0.1\nsegments = 24\n"
                                     "tube_segments = 12")));
    EXPECT_FALSE(gridOfObject(object("box", "box", "glass", {0, 0, 0}, "size = [1, 1, 1]")));
    EXPECT_FALSE(gridOfObject(stillWater("water") +
                              object("pane", "plane", "mirror", {0, -0.5, 0}, "size = [1, 1]")));
    EXPECT_FALSE(gridOfObject(""));
    // A triangle that is turned over, or runs elsewhere.
    scene::Mesh mesh = makeScene(kAbove, stillWater("plane")).meshes[0];
    ASSERT_TRUE(gridOf(mesh));
    std::swap(mesh.triangles[40].y, mesh.triangles[40].z);
    EXPECT_FALSE(gridOf(mesh));
    std::swap(mesh.triangles[40].y, mesh.triangles[40].z);
    ++mesh.triangles[100].x;
    EXPECT_FALSE(gridOf(mesh));
    mesh.triangles.clear();
    EXPECT_FALSE(gridOf(mesh));
}

}  // namespace
}  // namespace kaustik::test
