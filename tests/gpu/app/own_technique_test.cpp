// SPDX-License-Identifier: MIT
// The example technique of CONTRIBUTING.md, compiled and run as it stands there: from outside
// framework/ and techniques/, with shaders of its own. It is listed, takes --set, runs and is timed
// like the others, and what it deposits is right.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "example/techniques/points.cpp"
#include "example/techniques/reconstruct/points.cpp"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/numerics/frame.h"
#include "framework/scene/files/scene_file.h"
#include "techniques/register_all.h"
#include "tests/gpu/app/command_line.h"
#include "tests/gpu/fixture.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::test {
namespace {

Registry registryWithPoints() {
    Registry registry = registerAll();
#define NODE(name) register##name(registry);
#define TECHNIQUE(name) register##name(registry);
#include "example/techniques/registered.inc"
#undef NODE
#undef TECHNIQUE
    return registry;
}

class OwnTechnique : public testing::Test {
  protected:
    OwnTechnique() { ::setenv("KAUSTIK_SHADERS", KAUSTIK_EXAMPLE "/shaders", 1); }
    ~OwnTechnique() override { ::unsetenv("KAUSTIK_SHADERS"); }
    [[nodiscard]] CommandResult command(const std::vector<const char*>& arguments) const {
        return runCommandLine(registry, arguments);
    }
    Registry registry = registryWithPoints();
};

TEST_F(OwnTechnique, IsListedWithItsNodeAndParameters) {
    const CommandResult techniques = command({"list", "techniques"});
    EXPECT_EQ(techniques.exitCode, 0);
    EXPECT_NE(techniques.out.find("points"), std::string::npos);
    EXPECT_NE(command({"list", "nodes"}).out.find("reconstruct.points"), std::string::npos);
    const std::string params = command({"list", "params", "--technique", "points"}).out;
    EXPECT_NE(params.find("reconstruct.points.gain = 1"), std::string::npos);
    EXPECT_EQ(params.find("reconstruct.sprites"), std::string::npos);
}

TEST_F(OwnTechnique, TakesSettingsAndIsTimed) {
    const TemporaryFolder folder;
    const std::string out = (folder / "out").string();
    const auto run = [&](const char* gain, int exitCode) {
        const CommandResult result =
            command({"run", "flat-water", "--technique", "points", "--size", "64x48", "--set",
                     "photons=32x32", "--set", gain, "--frames", "2", "--out", out.c_str()});
        EXPECT_EQ(result.exitCode, exitCode) << result.err;
        return nlohmann::json::parse(readFile(folder / "out/report.json"));
    };
    // Half of the light is in no account, which no light can do; the report is there all the same.
    const nlohmann::json report = run("points.gain=0.5", kExitImpossible);
    EXPECT_EQ(report.at("technique"), "points");
    EXPECT_EQ(report.at("parameters").at("reconstruct.points.gain"), 0.5);
    bool isTimed = false;
    for (const nlohmann::json& pass : report.at("passes")) {
        if (pass.at("name") != "reconstruct.points") continue;
        isTimed = pass.at("ran").get<bool>() && pass.at("stage") == "reconstruct" &&
                  pass.at("gpu_ms").at("median").get<double>() > 0.0;
    }
    EXPECT_TRUE(isTimed);
    ASSERT_EQ(report.at("violations").size(), 1u);
    const std::string violation = report.at("violations")[0];
    EXPECT_NE(violation.find("not conserved"), std::string::npos) << violation;
    EXPECT_NE(violation.find("reconstruct=points"), std::string::npos) << violation;
    // What it deposits follows its parameter, and the ledger sees it.
    const double half = report.at("energy").at("deposited_w").get<double>();
    const double whole =
        run("points.gain=1", kExitDone).at("energy").at("deposited_w").get<double>();
    EXPECT_GT(half, 0.0);
    EXPECT_NEAR(whole / half, 2.0, 1e-4);
}

TEST_F(OwnTechnique, RefusesWhatItsParameterDoesNotAllow) {
    const CommandResult result =
        command({"run", "flat-water", "--technique", "points", "--set", "gain=11"});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_NE(result.err.find("reconstruct.points.gain"), std::string::npos);
}

TEST_F(OwnTechnique, AddsPhotonsOfOnePixelUpInMemoryThatItHasCleared) {
    // Dozens of photons for each pixel. Memory starts as NaN.
    const scene::Scene scene = scene::loadScene("flat-water");
    numerics::FrameRequest request{16, 12, {{"emit.photons", "64x64"}}, {}, false, true};
    const numerics::Frame frame(context(), registry, scene, registry.findTechnique("points"),
                                request);
    EXPECT_EQ(frame.countNotFinite("caustic.irradiance"), 0u);
    const EnergyLedger ledger = frame.renderer().ledger();
    const double arrived = ledger.watts[transport::kAccountArrived];
    EXPECT_GT(arrived, 0.0);
    // A pixel is a sum of at most 64² floats, each rounded to half a unit in the last place.
    EXPECT_NEAR(ledger.watts[transport::kAccountDeposited], arrived, 4096.0 * 0x1p-24 * arrived);
}

}  // namespace
}  // namespace kaustik::test
