// SPDX-License-Identifier: MIT
// reconstruct.triangles: the same light in each pixel, and the same ledger, whether the device or
// the processor covers them.
#include <algorithm>
#include <cmath>
#include <string>

#include "framework/numerics/cases/scene_text.h"
#include "framework/pipeline/ledger.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using numerics::floorPlane;
using numerics::object;

struct Covered {
    Texels irradiance;
    EnergyLedger ledger;
    std::string reason;
};

class TrianglesCover : public testing::Test {
  protected:
    void SetUp() override {
        if (lacksExactTracer()) GTEST_SKIP() << "built without Embree";
    }
    Covered coveredBy(const std::string& who, const scene::Scene& scene,
                      const numerics::Settings& more, const std::string& technique) {
        numerics::Settings settings{{"reconstruct.triangles.cover", who}};
        settings.insert(settings.end(), more.begin(), more.end());
        Frame frame(scene, 120, 90, settings, {}, true, technique);
        Covered found{frame.causticIrradiance(), frame.renderer().ledger(), ""};
        for (const auto& record : frame.renderer().compiled().records) {
            if (record.name == "reconstruct.triangles") found.reason = record.reason;
        }
        return found;
    }
    // Of a small frame that the processor covers.
    static RenderSettings settings(const Registry& registry) {
        RenderSettings made;
        made.technique = registry.findTechnique("exact_rays");
        made.params = registry.makeParams(made.technique);
        made.params.set("emit.photons", "64x64", "test");
        made.params.set("reconstruct.triangles.cover", "processor", "test");
        made.width = 120;
        made.height = 90;
        return made;
    }
    void areTheSame(const scene::Scene& scene, const numerics::Settings& more = {},
                    const std::string& technique = "exact_rays") {
        const Covered device = coveredBy("device", scene, more, technique);
        const Covered processor = coveredBy("processor", scene, more, technique);
        EXPECT_EQ(device.reason.find("the processor"), std::string::npos);
        EXPECT_NE(processor.reason.find("the processor"), std::string::npos);
        double off = 0.0;
        double sum = 0.0;
        for (std::size_t i = 0; i < device.irradiance.values.size(); ++i) {
            off += std::abs(device.irradiance.values[i] - processor.irradiance.values[i]);
            sum += device.irradiance.values[i];
        }
        ASSERT_GT(sum, 0.0);
        // What decides with 32 bits whether a pixel shows a patch's surface may go either way.
        EXPECT_LT(off / sum, 1e-4);
        const double emitted = device.ledger.watts[transport::kAccountEmitted];
        EXPECT_LT(std::abs(processor.ledger.balance()), 1e-5);
        for (std::size_t account = 0; account < device.ledger.watts.size(); ++account) {
            EXPECT_NEAR(processor.ledger.watts[account], device.ledger.watts[account],
                        1e-4 * emitted)
                << "account " << account;
        }
    }
};

const std::string kSun = numerics::sun({0.4, -1.0, 0.3});
const std::string kFloor = floorPlane("floor", "grey", 3, {0, 0, 0});
const std::string kBall = object("ball", "sphere", "glass", {0, 0.6, 0}, "radius = 0.4");
const std::string kWaves =
    object("waves", "water", "water", {0, 1, 0},
           "size = [3, 3]\ncells = [64, 64]\n"
           "waves = [{amplitude = 0.03, wavelength = 0.6, direction_degrees = 20}]");
const numerics::CameraText kCamera{{0.0, 1.8, 3.0}, {0.0, 0.3, 0.0}, 45.0, 0.01};

TEST_F(TrianglesCover, IsTheSameWhereLightFolds) {
    areTheSame(numerics::makeScene(kCamera, kSun + kFloor + kWaves), {{"emit.photons", "96x96"}});
}

// Most of what a ball reflects is not joined, and wide.
TEST_F(TrianglesCover, IsTheSameOfWideBeams) {
    areTheSame(numerics::makeScene(kCamera, kSun + kFloor + kBall), {{"emit.photons", "24x24"}});
}

TEST_F(TrianglesCover, IsTheSameAtEdgesAndThinThings) {
    const std::string things =
        object("rod", "box", "grey", {0.2, 0.3, 0.2}, "size = [0.01, 0.6, 0.01]") +
        object("box", "box", "grey", {-0.4, 0.15, 0.3}, "size = [0.3, 0.3, 0.3]");
    const scene::Scene scene = numerics::makeScene(kCamera, kSun + kFloor + kBall + things);
    for (const char* coverage : {"middle", "samples"}) {
        areTheSame(scene,
                   {{"emit.photons", "96x96"}, {"reconstruct.triangles.coverage", coverage}});
    }
}

// What lies next to the picture, behind the eye and before the near plane.
TEST_F(TrianglesCover, IsTheSameNextToThePicture) {
    const numerics::CameraText close{{0.3, 0.25, 0.6}, {0.0, 0.0, -0.2}, 40.0, 0.2};
    areTheSame(numerics::makeScene(close, kSun + kFloor + kBall), {{"emit.photons", "64x64"}});
}

TEST_F(TrianglesCover, IsTheSameByOtherDensitiesAndMerged) {
    const scene::Scene scene = numerics::makeScene(kCamera, kSun + kFloor + kWaves);
    for (const char* shading : {"flat", "vertices"}) {
        areTheSame(scene, {{"emit.photons", "64x64"}, {"reconstruct.triangles.shading", shading}});
    }
    areTheSame(scene, {{"emit.photons", "64x64"}, {"reconstruct.triangles.merge", "8"}});
}

// Of a photon list of several lights and batches, traced on the screen.
TEST_F(TrianglesCover, IsTheSameOfBatches) {
    const std::string lamp =
        "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = [0.3, 2.5, 0.2]\n"
        "intensity = 200\n";
    areTheSame(numerics::makeScene(kCamera, kSun + lamp + kFloor + kWaves),
               {{"emit.photons", "64x64"}, {"emit.batch", "2048"}}, "screen_space_photons");
}

// More patches than are made at once.
TEST_F(TrianglesCover, IsTheSameOfMoreThanThereIsRoomFor) {
    areTheSame(numerics::makeScene(kCamera, kSun + kFloor + kWaves), {{"emit.photons", "640x640"}});
}

// By drivers that bring photons in rounds.
TEST_F(TrianglesCover, IsTheSameOfDriversThatComeBack) {
    const scene::Scene scene = numerics::makeScene(kCamera, kSun + kFloor + kBall);
    areTheSame(scene, {{"emit.photons", "32x32"}, {"driver.dense.refine", "3"}});
    areTheSame(scene, {{"driver", "adaptive"},
                       {"emit", "deferred"},
                       {"refine.start", "32"},
                       {"refine.finest", "128"}});
}

// A patch of many pixels, of which one as wide as it is high would be wrong by parts in a thousand
// in a sum of 32 bits.
TEST_F(TrianglesCover, OfAWidePatchIsAllOfItsLight) {
    const std::string pane = object("pane", "plane", "air", {0, 1, 0}, "size = [1, 1]") +
                             "[[material]]\nname = \"air\"\ntype = \"dielectric\"\nior = 1\n";
    const numerics::CameraText above{{0.0, 0.9, 0.001}, {0.0, 0.0, 0.0}, 40.0, 0.01};
    const scene::Scene scene =
        numerics::makeScene(above, numerics::sun({0.0, -1.0, 0.0}) + kFloor + pane);
    for (const char* who : {"device", "processor"}) {
        const Frame frame(scene, 640, 640,
                          {{"emit.photons", "2x2"},
                           {"reconstruct.triangles.maximum", "1024"},
                           {"reconstruct.triangles.cover", who}},
                          {}, false, "exact_rays");
        const EnergyLedger& ledger = frame.renderer().ledger();
        EXPECT_GT(ledger.watts[transport::kAccountDeposited], 0.0) << who;
        EXPECT_LT(std::abs(ledger.balance()), 1e-5) << who;
    }
}

TEST_F(TrianglesCover, IsTheSameToTheBitTwice) {
    const scene::Scene scene = numerics::makeScene(kCamera, kSun + kFloor + kBall + kWaves);
    const auto once = [&] {
        return coveredBy("processor", scene, {{"emit.photons", "64x64"}}, "exact_rays")
            .irradiance.values;
    };
    EXPECT_EQ(once(), once());
}

TEST_F(TrianglesCover, OfAFrameHoldsNothingOfTheOneBefore) {
    const Registry registry = registerAll();
    const scene::Scene scene = numerics::makeScene(kCamera, kSun + kFloor + kWaves);
    Renderer renderer(context(), registry, scene, settings(registry));
    renderer.build(Purpose::measurement);
    const auto next = [&] {
        gl::PassTimer timer(gl::TimerMode::finish);
        EXPECT_TRUE(renderer.renderFrame(timer));
        return renderer.texture(renderer.graph().find("caustic.irradiance")).read();
    };
    const std::vector<float> first = next();
    EXPECT_EQ(next(), first);
}

// What is switched off leaves no light, nor that of the frame before.
TEST_F(TrianglesCover, ThatIsOffLeavesNoLight) {
    const Registry registry = registerAll();
    const scene::Scene scene = numerics::makeScene(kCamera, kSun + kFloor + kWaves);
    RenderSettings wanted = settings(registry);
    Renderer renderer(context(), registry, scene, wanted);
    const auto brightest = [&] {
        renderer.build(Purpose::measurement);
        gl::PassTimer timer(gl::TimerMode::finish);
        EXPECT_TRUE(renderer.renderFrame(timer));
        const std::vector<float> values =
            renderer.texture(renderer.graph().find("caustic.irradiance")).read();
        return *std::max_element(values.begin(), values.end());
    };
    EXPECT_GT(brightest(), 0.0f);
    wanted.disabledPasses = {"reconstruct.triangles"};
    renderer.update(wanted);
    EXPECT_EQ(brightest(), 0.0f);
}

}  // namespace
}  // namespace kaustik::test
