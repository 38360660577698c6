// SPDX-License-Identifier: MIT
// --device-model: what each pass has to move, in the table and in the report.
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;
using DeviceModel = CommandLine;

TEST_F(DeviceModel, GivesEachPassItsBytesAndTheirTime) {
    const Outcome outcome = renderWater({"--device-model", "500GB/s", "--technique", "planar"});
    EXPECT_NE(outcome.out.find("memory of 500 GB/s"), std::string::npos) << outcome.out;
    const json all = report();
    const json& cost = all.at("cost");
    EXPECT_EQ(cost.at("bandwidth_gb_s"), 500.0);
    double sum = 0.0;
    bool hasDisplay = false;
    for (const json& pass : cost.at("passes")) {
        const double bytes =
            pass.at("read_bytes").get<double>() + pass.at("written_bytes").get<double>();
        EXPECT_NEAR(pass.at("bound_ms").get<double>(), 1e3 * bytes / 500e9, 1e-12);
        sum += pass.at("bound_ms").get<double>();
        // Reads the radiance and writes the picture, each pixel once.
        if (pass.at("name") == "compose.display") {
            hasDisplay = true;
            EXPECT_EQ(bytes, 64.0 * 48.0 * (16.0 + 4.0));
            EXPECT_GT(pass.at("times_bound").get<double>(), 1.0);
        }
    }
    EXPECT_TRUE(hasDisplay);
    EXPECT_NEAR(cost.at("bound_ms").get<double>(), sum, 1e-9);
}

TEST_F(DeviceModel, IsExplainedWithoutARun) {
    static_cast<void>(folder.file("wavy.toml", kWavyWater));
    const Outcome outcome = run({"explain", "wavy.toml", "--size", "64x48", "--set",
                                 "photons=32x32", "--device-model", "4.8 TB/s"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("memory of 4800 GB/s"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("\nall passes"), std::string::npos) << outcome.out;
}

TEST_F(DeviceModel, ThatIsNoBandwidthIsRefusedBeforeTheWork) {
    static_cast<void>(folder.file("wavy.toml", kWavyWater));
    for (const char* wrong : {"fast", "1000", "-3GB/s", "0GB/s", "1000 GB", "nanGB/s"}) {
        for (const char* command : {"run", "explain"})
            expectFailure(
                run({command, "wavy.toml", "--device-model", wrong}), 2,
                {"--device-model: '" + std::string(wrong) + "' is no bandwidth", "1000GB/s"});
    }
    EXPECT_EQ(files(), (std::set<std::string>{"wavy.toml"}));
}

}  // namespace
}  // namespace kaustik::test
