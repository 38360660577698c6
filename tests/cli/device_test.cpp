// SPDX-License-Identifier: MIT
// --device, and what check lists of devices. Without a GPU there is one: Mesa's on the processor.
#include <regex>

#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

class Devices : public CommandLine {
  protected:
    Devices() { static_cast<void>(folder.file("wavy.toml", kWavyWater)); }
};

TEST_F(Devices, AreListedByCheckWithTheOneInUseMarked) {
    const Outcome outcome = run({"check"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    std::smatch device;
    ASSERT_TRUE(std::regex_search(outcome.out, device, std::regex(R"(\n  \* (\d+)  ([^,\n]+))")))
        << outcome.out;
    // What programs need, and what is there of it.
    std::smatch need;
    ASSERT_TRUE(std::regex_search(outcome.out, need,
                                  std::regex(R"(storage blocks in a compute shader +8, of (\d+))")))
        << outcome.out;
    EXPECT_GE(std::stoi(need[1].str()), 8);
    // By its number, and by a part of its name in any case, it is the same.
    for (const std::string& wanted : {device[1].str(), device[2].str().substr(1, 5)}) {
        const Outcome same = run({"check", "--device", wanted});
        EXPECT_EQ(same.exitCode, 0) << same.err;
        EXPECT_NE(same.out.find("EGL platform      device " + device[1].str() + "\n"),
                  std::string::npos)
            << same.out;
    }
}

TEST_F(Devices, AreInTheReportByWhicheverWayTheyWereNamed) {
    std::vector<std::string> arguments = smallRun("wavy.toml", {"--out", "out"});
    Conditions first;
    first.environment["KAUSTIK_DEVICE"] = "0";
    ASSERT_EQ(run(arguments, first).exitCode, 0);
    EXPECT_EQ(report()["device"]["platform"], "device 0");
    // The command line counts before the environment.
    arguments.insert(arguments.end(), {"--device", "99"});
    expectFailure(run(arguments, first), 2, {"there is no device 99; 'kaustik check' lists them"});
}

TEST_F(Devices, OfANameThatNoneHasAreRefusedWithThoseThatThereAre) {
    expectFailure(run({"explain", "wavy.toml", "--device", "Voodoo 2"}), 2,
                  {"--device: no device is called 'Voodoo 2'; say one of them by its number: 0 "});
}

TEST_F(Devices, AreCapturedOnlyWhereRenderDocIsLoaded) {
    expectFailure(run(smallRun("wavy.toml", {"--capture", "--out", "out"})), 2,
                  {"--capture: RenderDoc is not loaded; start this command with it"});
    EXPECT_EQ(files(), (std::set<std::string>{"wavy.toml"}));
}

}  // namespace
}  // namespace kaustik::test
