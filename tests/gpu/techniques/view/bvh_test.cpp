// SPDX-License-Identifier: MIT
// view.bvh: the same picture whether the device or the processor follows the eye's rays.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "framework/numerics/cases/scene_text.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using numerics::floorPlane;
using numerics::object;

const numerics::CameraText kCamera{{0.0, 1.2, 3.0}, {0.0, 0.4, 0.0}, 45.0, 0.01};

// The parameters' end: who traces.
Texels radianceBy(const std::string& rays, const scene::Scene& scene,
                  const numerics::Settings& more = {}) {
    numerics::Settings settings{{"emit.photons", "8x8"}, {"view.bvh.rays", rays}};
    settings.insert(settings.end(), more.begin(), more.end());
    const Frame frame(scene, 96, 72, settings, {"view.radiance"}, true, "exact_rays");
    return frame.read("view.radiance");
}

struct Difference {
    double mean = 0.0;    // of the absolute differences, of the mean radiance
    double pixels = 0.0;  // share of pixels that differ by more than a hundredth
};
Difference between(const Texels& a, const Texels& b) {
    Difference found;
    double sum = 0.0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const double off = std::abs(a.rgb(x, y).g - b.rgb(x, y).g);
            found.mean += off;
            sum += b.rgb(x, y).g;
            if (off > 0.01 * b.rgb(x, y).g) found.pixels += 1.0 / (a.width * a.height);
        }
    }
    found.mean /= sum;
    return found;
}

void areTheSame(const scene::Scene& scene, const numerics::Settings& more = {}) {
    const Texels device = radianceBy("device", scene, more);
    const Texels processor = radianceBy("processor", scene, more);
    const Difference difference = between(processor, device);
    // Where two surfaces meet within a ray's rounding either is seen.
    EXPECT_LT(difference.mean, 2e-4);
    EXPECT_LT(difference.pixels, 1e-3);
}

class ViewBvh : public testing::Test {
  protected:
    void SetUp() override {
        if (lacksExactTracer()) GTEST_SKIP() << "built without Embree";
    }
};

// Through the ball and in the mirror the floor is seen where the picture has it, and where it does
// not: behind the ball, and behind the eye; its pattern and its shadows too.
std::string ballAndMirror() {
    return "[[material]]\nname = \"tiles\"\ntype = \"lambertian\"\nalbedo = [0.6, 0.5, 0.4]\n"
           "pattern = \"checker\"\npattern_albedo = [0.1, 0.2, 0.3]\nuv_scale = 8\n" +
           floorPlane("floor", "tiles", 12, {0, 0, 0}) +
           object("ball", "sphere", "glass", {0, 0.6, 0}, "radius = 0.5\nsegments = 48") +
           object("glass", "plane", "mirror", {-1.2, 0.6, -0.6},
                  "size = [1, 1]\nrotation_degrees = [80, 20, 0]");
}
std::string lamp(const glm::dvec3& position, double intensity) {
    return "[[light]]\nname = \"lamp" + numerics::number(position.x) + "\"\ntype = \"point\"\n" +
           "position = " + numerics::numbers(position) +
           "\nintensity = " + numerics::number(intensity) + "\n";
}

TEST_F(ViewBvh, SeesTheSameByTheProcessorInTheSun) {
    areTheSame(numerics::makeScene(kCamera, numerics::sun({0.4, -1.0, 0.3}) + ballAndMirror()));
}

TEST_F(ViewBvh, SeesTheSameBySeveralRaysAPixel) {
    const scene::Scene scene =
        numerics::makeScene(kCamera, numerics::sun({0.4, -1.0, 0.3}) + ballAndMirror());
    areTheSame(scene, {{"view.samples", "4"}});
    // Each is another ray.
    const Difference moved = between(radianceBy("processor", scene),
                                     radianceBy("processor", scene, {{"view.samples", "4"}}));
    EXPECT_GT(moved.pixels, 0.01);
}

TEST_F(ViewBvh, SeesTheSameWithMoreLightsThanAWordHasBits) {
    std::string lights;
    for (int i = 0; i < 40; ++i)
        lights += lamp({-1.95 + 0.1 * i, 2.0 + 0.02 * i, 0.5}, 3.0 + i);
    const std::string parts = ballAndMirror();
    areTheSame(numerics::makeScene(kCamera, lights + parts));
    // The last of them counts.
    const scene::Scene one = numerics::makeScene(kCamera, lamp({1.95, 2.8, 0.5}, 42.0) + parts);
    areTheSame(one);
}

TEST_F(ViewBvh, SeesTheSameByEachCap) {
    const scene::Scene scene =
        numerics::makeScene(kCamera, numerics::sun({0.4, -1.0, 0.3}) + ballAndMirror());
    const Texels all = radianceBy("processor", scene);
    for (const numerics::Settings& cap : std::vector<numerics::Settings>{
             {{"view.bvh.branches", "0"}},
             {{"view.bvh.branches", "4"}},
             {{"view.bvh.interfaces", "1"}},
             {{"view.bvh.branches", "4"}, {"view.bvh.reflections", "0"}}}) {
        SCOPED_TRACE(cap.back().first + cap.back().second);
        areTheSame(scene, cap);
    }
    EXPECT_GT(between(radianceBy("processor", scene, {{"view.bvh.branches", "0"}}), all).mean,
              1e-3);
}

// An extinction that is infinite, as a black tint's is, over a length of 0 takes nothing away.
TEST_F(ViewBvh, SeesTheSameThroughTintedGlass) {
    scene::Scene scene =
        numerics::makeScene(kCamera, numerics::sun({0.4, -1.0, 0.3}) + ballAndMirror());
    for (scene::Material& material : scene.materials) {
        if (material.name == "glass")
            material.absorptionPerMeter = {0.5f, std::numeric_limits<float>::infinity(), 1.0f};
    }
    areTheSame(scene);
}

TEST_F(ViewBvh, SeesTheSameUnderWater) {
    const std::string pool = object("water", "plane", "water", {0, 0.5, 0}, "size = [3, 3]") +
                             floorPlane("floor", "grey", 3, {0, 0, 0}) +
                             numerics::sun({0.4, -1.0, 0.3});
    areTheSame(numerics::makeScene(kCamera, pool));
    // From below, where most is totally reflected.
    areTheSame(numerics::makeScene({{0.0, 0.2, 1.0}, {0.0, 0.5, -0.5}, 70.0, 0.01}, pool));
}

TEST_F(ViewBvh, SaysWhoTraces) {
    const scene::Scene scene =
        numerics::makeScene(kCamera, numerics::sun({0.4, -1.0, 0.3}) + ballAndMirror());
    const auto why = [&](const std::string& rays) {
        const Frame frame(scene, 32, 24, {{"emit.photons", "8x8"}, {"view.bvh.rays", rays}}, {},
                          false, "exact_rays");
        for (const auto& record : frame.renderer().compiled().records) {
            if (record.name == "view.bvh") return record.reason;
        }
        return std::string();
    };
    EXPECT_NE(why("device").find("by the device"), std::string::npos) << why("device");
    EXPECT_NE(why("processor").find("by the processor"), std::string::npos);
    EXPECT_EQ(why("auto"), why(context().info().isSoftware ? "processor" : "device"));
}

}  // namespace
}  // namespace kaustik::test
