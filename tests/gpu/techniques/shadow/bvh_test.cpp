// SPDX-License-Identifier: MIT
// shadow.bvh: the same shadows whether the device or the processor traces the rays to the lights.
#include <string>

#include "framework/numerics/cases/scene_text.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using numerics::object;

// Not of whole words of pixels.
constexpr int kWidth = 70;
constexpr int kHeight = 50;

// A sun, a lamp among what it lights, and one that nearly lies in the floor; bodies, and a sheet
// seen from its back.
scene::Scene litRoom() {
    const auto lamp = [](const std::string& name, const std::string& position) {
        return "[[light]]\nname = \"" + name + "\"\ntype = \"point\"\nposition = " + position +
               "\nintensity = 30\n";
    };
    return numerics::makeScene(
        {{0.0, 1.2, 3.0}, {0.0, 0.3, 0.0}, 50.0, 0.01},
        numerics::sun({0.5, -1.0, -0.2}) + lamp("lamp", "[0.8, 0.5, 0.6]") +
            lamp("low", "[-0.6, 0.05, 0.5]") + numerics::floorPlane("floor", "grey", 6, {0, 0, 0}) +
            object("ball", "sphere", "glass", {0, 0.5, 0}, "radius = 0.4\nsegments = 24") +
            object("box", "box", "white", {-0.9, 0.3, -0.4}, "size = [0.4, 0.6, 0.4]") +
            object("screen", "plane", "grey", {0.9, 0.5, -0.5},
                   "size = [0.7, 0.7]\nrotation_degrees = [-80, 15, 0]"));
}

Frame shadowsBy(const scene::Scene& scene, const std::string& rays) {
    return {scene,
            kWidth,
            kHeight,
            {{"emit.photons", "8x8"}, {"shadow.bvh.rays", rays}},
            {"shadow.visibility"},
            true,
            "exact_rays"};
}

std::string reasonOf(const Frame& frame) {
    for (const auto& record : frame.renderer().compiled().records) {
        if (record.name == "shadow.bvh") return record.reason;
    }
    return {};
}

class ShadowBvh : public testing::Test {
  protected:
    void SetUp() override {
        if (lacksExactTracer()) GTEST_SKIP() << "built without Embree";
    }
};

TEST_F(ShadowBvh, DarkensTheSamePixelsByTheProcessor) {
    const scene::Scene scene = litRoom();
    const Frame byDevice = shadowsBy(scene, "device");
    const Frame byProcessor = shadowsBy(scene, "processor");
    for (int light = 0; light < 3; ++light) {
        SCOPED_TRACE(light);
        const Texels device = byDevice.read("shadow.visibility", light);
        const Texels processor = byProcessor.read("shadow.visibility", light);
        int lit = 0;
        int others = 0;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                lit += device.at(x, y, 0) > 0.5f ? 1 : 0;
                others += device.at(x, y, 0) != processor.at(x, y, 0) ? 1 : 0;
            }
        }
        EXPECT_GT(lit, 100);
        EXPECT_LT(lit, kWidth * kHeight - 100);
        // Rays that graze an edge within a rounding.
        EXPECT_LE(others, 3);
    }
}

TEST_F(ShadowBvh, SaysWhoTraces) {
    const scene::Scene scene = litRoom();
    const std::string device = reasonOf(shadowsBy(scene, "device"));
    const std::string processor = reasonOf(shadowsBy(scene, "processor"));
    EXPECT_NE(device.find("by the device"), std::string::npos) << device;
    EXPECT_NE(processor.find("by the processor"), std::string::npos) << processor;
    EXPECT_EQ(reasonOf(shadowsBy(scene, "auto")), context().info().isSoftware ? processor : device);
}

}  // namespace
}  // namespace kaustik::test
