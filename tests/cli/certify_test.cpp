// SPDX-License-Identifier: MIT
// kaustik certify, and run --reference certified.
#include <signal.h>

#include <filesystem>

#include "framework/image/image.h"
#include "tests/cli/fixture.h"
#include "tests/wavy_water.h"

namespace kaustik::test {
namespace {

class Certify : public CommandLine {
  protected:
    Certify() { static_cast<void>(folder.file("wavy.toml", kWavyWater)); }
    [[nodiscard]] Outcome certify(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments = {"certify", "wavy.toml", "--size",
                                              "24x18",   "--band",    "0.05"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    // Of truth.exr, how many values photons have been at; all are held by bounds.exr.
    [[nodiscard]] std::size_t litWithin() const {
        const Image lower = image("bounds.lower.exr");
        const Image upper = image("bounds.upper.exr");
        const Image truth = image("truth.exr");
        const Image error = image("truth.stderr.exr");
        std::size_t lit = 0;
        for (std::size_t i = 0; i < truth.values.size(); ++i) {
            EXPECT_LE(lower.values[i], upper.values[i]);
            if (!(error.values[i] > 0.0f) || !std::isfinite(error.values[i])) continue;
            ++lit;
            // Where few photons have been the error is as much too small as the value.
            const float noise =
                error.values[i] * std::sqrt(std::max(lower.values[i] / truth.values[i], 1.0f));
            // 1,296 values: beyond 6 standard errors none is by chance.
            EXPECT_GE(truth.values[i], lower.values[i] - 6.0f * noise) << i;
            EXPECT_LE(truth.values[i], upper.values[i] + 6.0f * noise) << i;
        }
        return lit;
    }
    [[nodiscard]] Image image(const std::string& name) const { return readImage(folder / name); }
};

TEST_F(Certify, WritesBoundsThatHoldAReference) {
    const Outcome outcome = certify({"--interactions", "2", "--out", "bounds.exr"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("undecided"), std::string::npos) << outcome.out;
    const nlohmann::json found = nlohmann::json::parse(contents("bounds.json"));
    EXPECT_LT(found.at("deposited_width").get<double>(), 5e-4);
    ASSERT_EQ(run({"reference", "wavy.toml", "--size", "24x18", "--interactions", "2", "--photons",
                   "2000000", "--out", "truth.exr"})
                  .exitCode,
              0);
    EXPECT_GT(litWithin(), 150u);
    const nlohmann::json energy = nlohmann::json::parse(contents("truth.json")).at("energy");
    const double deposited = energy.at("deposited_w").get<double>();
    const nlohmann::json& certified = found.at("energy").at("deposited_w");
    EXPECT_NEAR(certified.at(0).get<double>(), deposited, 2e-3 * deposited);
}

TEST_F(Certify, MergesShardsToTheSameBounds) {
    for (const char* shard : {"1/2", "2/2"}) {
        const std::string out = std::string(1, shard[0]) + ".shard";
        ASSERT_EQ(certify({"--shard", shard, "--out", out}).exitCode, 0);
    }
    ASSERT_EQ(certify({"--out", "whole.exr"}).exitCode, 0);
    ASSERT_EQ(run({"certify", "wavy.toml", "--merge", "1.shard", "2.shard", "--out", "merged.exr"})
                  .exitCode,
              0);
    EXPECT_EQ(image("merged.lower.exr").values, image("whole.lower.exr").values);
    EXPECT_EQ(image("merged.upper.exr").values, image("whole.upper.exr").values);
    expectFailure(run({"certify", "wavy.toml", "--merge", "2.shard", "--out", "merged.exr"}), 2,
                  {"these are missing: 1"});
}

// So narrow a band takes longer than anybody waits.
TEST_F(Certify, EndsAtASignalAndGoesOnFromWhatIsDone) {
    Conditions conditions;
    conditions.folder = folder / ".";
    Program program(
        {"certify", "wavy.toml", "--size", "400x300", "--band", "1e-4", "--out", "bounds.exr"},
        conditions);
    program.waitUntilItHandles(SIGINT);
    program.send(SIGINT);
    expectFailure(program.wait(), 1, {"Interrupted after ", "blocks", "goes on"});
    EXPECT_FALSE(std::filesystem::exists(folder / "bounds.json"));
    EXPECT_TRUE(std::filesystem::exists(folder / "bounds.exr.unfinished"));
}

TEST_F(Certify, ProvesWhereATechniqueIsWrong) {
    const Outcome outcome =
        run({"run", "wavy.toml", "--size", "24x18", "--frames", "1", "--warmup", "0", "--set",
             "emit.photons=64x64", "--reference", "certified", "--out", "out"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const nlohmann::json verdict = nlohmann::json::parse(contents("out/certified.json"));
    EXPECT_EQ(verdict.at("pixels").get<int>(), 24 * 18);
    EXPECT_GT(verdict.at("proved_too_dark").get<int>(), 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "out/certified.png"));
    EXPECT_NE(outcome.out.find("are proved too dark"), std::string::npos) << outcome.out;
}

TEST_F(Certify, SaysWhatItCannotDo) {
    expectFailure(certify({"--interactions", "0"}), 2, {"--interactions: 0 is not from 1 to 8"});
    expectFailure(certify({"--band", "0"}), 2, {"--band"});
    expectFailure(certify({"--out", "bounds.png"}), 2, {"must end in .exr or .pfm"});
    expectFailure(run({"certify"}), 2, {"name a scene"});
    static_cast<void>(folder.file(
        "foggy.toml", std::string(kWavyWater) + "[medium]\nscattering_per_meter = 0.1\n"));
    expectFailure(run({"certify", "foggy.toml"}), 2, {"medium", "cannot be certified"});
    static_cast<void>(folder.file("broken.shard", "not a part\n"));
    expectFailure(run({"certify", "wavy.toml", "--merge", "broken.shard"}), 1,
                  {"broken.shard is no part of a certificate"});
}

}  // namespace
}  // namespace kaustik::test
