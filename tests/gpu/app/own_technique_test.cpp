// SPDX-License-Identifier: MIT
// A technique from outside framework/ and techniques/: one node with parameters and a shader of its
// own, one registration line each. It is listed, takes --set, runs and is timed like the others.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "framework/app/commands.h"
#include "framework/core/files.h"
#include "framework/pipeline/frame_builder.h"
#include "techniques/register_all.h"

namespace kaustik::test {
namespace {

struct PointsParams {
    float gain = 1.0f;
    template <class R>
    void reflect(R& r) {
        r.field(gain, "gain", "Factor on the flux", "", params::range(0.0f, 10.0f));
    }
};

IrradianceMap splatPoints(FrameBuilder& frame, const PointsParams& params, Hits hits,
                          EyeBuffer eye) {
    struct Data {
        IrradianceMap map;
        Hits hits;
        EyeBuffer eye;
    };
    return frame
        .pass<Data>(
            "reconstruct.points", "a test",
            [&](graph::PassSetup& setup, Data& data) {
                data.hits = hits;
                data.eye = eye;
                setup.read(hits.position);
                setup.read(hits.flux);
                setup.read(eye.receiver);
                data.map.irradiance = setup.create<IrradianceTexel>("caustic.irradiance",
                                                                    frame.width(), frame.height());
                data.map.ledger = setup.read(hits.incoming.ledger);
            },
            [&inputs = frame.inputs(), params](const Data& data, gl::PassContext& context) {
                context.texture(data.map.irradiance).clear({0, 0, 0, 0});
                gl::Command command = context.compute("tests/gpu/shaders/flat_splat.comp");
                inputs.bindView(command);
                inputs.bindLedger(command, data.map.ledger)
                    .params("reconstruct.points", params)
                    .texture("receiver", data.eye.receiver)
                    .texture("hitPosition", data.hits.position)
                    .texture("hitFlux", data.hits.flux)
                    .image("irradiance", data.map.irradiance)
                    .dispatchOver(data.hits.incoming.count(), 64);
            })
        .map;
}

Registry registryWithPoints() {
    Registry registry = registerAll();
    registry.node<ReconstructStage>("points", {"One pixel a photon.", "a test"}, &splatPoints);
    registry.technique({"points", "Photons as points.", "a test", {{"reconstruct", "points"}}, {}});
    return registry;
}

// Runs a command line in this process; gives the exit code and standard output.
std::pair<int, std::string> commandLine(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "kaustik");
    testing::internal::CaptureStdout();
    const Registry registry = registryWithPoints();
    const int code =
        app::runCommandLine(static_cast<int>(arguments.size()), arguments.data(), registry);
    return {code, testing::internal::GetCapturedStdout()};
}

TEST(OwnTechnique, IsListedWithItsNodeAndParameters) {
    const auto [code, techniques] = commandLine({"list", "techniques"});
    EXPECT_EQ(code, 0);
    EXPECT_NE(techniques.find("points"), std::string::npos);
    EXPECT_NE(commandLine({"list", "nodes"}).second.find("reconstruct.points"), std::string::npos);
    const std::string params = commandLine({"list", "params", "--technique", "points"}).second;
    EXPECT_NE(params.find("reconstruct.points.gain = 1"), std::string::npos);
    EXPECT_EQ(params.find("reconstruct.sprites"), std::string::npos);
}

TEST(OwnTechnique, TakesSettingsAndIsTimed) {
    const std::filesystem::path out =
        std::filesystem::temp_directory_path() / "kaustik-own-technique";
    const std::string folder = out.string();
    const auto run = [&](const char* gain) {
        EXPECT_EQ(
            commandLine({"run", "flat-water", "--technique", "points", "--size", "64x48", "--set",
                         "photons=32x32", "--set", gain, "--frames", "2", "--out", folder.c_str()})
                .first,
            0);
        return nlohmann::json::parse(readFile(out / "report.json"));
    };
    const nlohmann::json report = run("points.gain=0.5");
    EXPECT_EQ(report.at("technique"), "points");
    EXPECT_EQ(report.at("parameters").at("reconstruct.points.gain"), 0.5);
    bool isTimed = false;
    for (const nlohmann::json& pass : report.at("passes")) {
        if (pass.at("name") != "reconstruct.points") continue;
        isTimed = pass.at("ran").get<bool>() && pass.at("stage") == "reconstruct" &&
                  pass.at("gpu_ms").at("median").get<double>() > 0.0;
    }
    EXPECT_TRUE(isTimed);
    // What it deposits follows its parameter, and the ledger sees it.
    const double half = report.at("energy").at("deposited_w").get<double>();
    const double whole = run("points.gain=1").at("energy").at("deposited_w").get<double>();
    EXPECT_GT(half, 0.0);
    EXPECT_NEAR(whole / half, 2.0, 1e-4);
    std::filesystem::remove_all(out);
}

TEST(OwnTechnique, RefusesWhatItsParameterDoesNotAllow) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(commandLine({"run", "flat-water", "--technique", "points", "--set", "gain=11"}).first,
              2);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("reconstruct.points.gain"),
              std::string::npos);
}

}  // namespace
}  // namespace kaustik::test
