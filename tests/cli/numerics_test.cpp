// SPDX-License-Identifier: MIT
// `kaustik experiment run` of a study that names the suite of hard cases. What the cases measure is
// tested in tests/numerics; here it is the study, the table, the exit code and what is left behind.
#include <csignal>

#include "framework/core/files.h"
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

class NumericsStudy : public CommandLine {
  protected:
    [[nodiscard]] std::vector<std::string> study(const std::string& more) const {
        static_cast<void>(
            folder.file("study.toml", "name = \"few\"\nsuite = \"numerics\"\n" + more));
        return {"experiment", "run", "study.toml", "--out", "out"};
    }
};

TEST_F(NumericsStudy, WritesOneTableInThreeFormsAndPrintsIt) {
    const Outcome outcome = run(study("cases = [\"A4\", \"C20\"]\n"));
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("2 cases, 3 rows: all pass"), std::string::npos) << outcome.out;
    EXPECT_EQ(files(), (std::set<std::string>{"study.toml", "out/numerics.csv", "out/numerics.json",
                                              "out/numerics.md"}));
    EXPECT_EQ(contents("out/numerics.csv").substr(0, 67),
              "case,subject,what,expected,measured,tolerance,verdict,reason\nA4,inc");
    const nlohmann::json json = nlohmann::json::parse(contents("out/numerics.json"));
    EXPECT_EQ(json["schema"], "kaustik.numerics/1");
    EXPECT_EQ(json["failures"], 0);
    ASSERT_EQ(json["cases"].size(), 2u);
    EXPECT_EQ(json["cases"][1]["case"], "C20");
    for (const nlohmann::json& row : json["cases"][1]["rows"]) {
        EXPECT_EQ(row["verdict"], "pass");
        EXPECT_FALSE(row["reason"].get<std::string>().empty());
    }
}

TEST_F(NumericsStudy, ThatFailsSaysWhichRowAndKeepsTheTable) {
    // A copy of the shaders in which glass reflects too much.
    namespace fs = std::filesystem;
    const fs::path root = folder / "root";
    fs::create_directories(root / "framework");
    fs::copy(projectRoot() / "shaders", root / "shaders", fs::copy_options::recursive);
    fs::copy(projectRoot() / "framework/transport", root / "framework/transport");
    const fs::path file = root / "shaders/include/surfaces/fresnel.glsl";
    std::string text = readFile(file);
    const std::string line = "result.reflectance = clamp(0.5 *";
    ASSERT_NE(text.find(line), std::string::npos);
    text.replace(text.find(line), line.size(), "result.reflectance = clamp(0.6 *");
    writeFileWhole(file, text);
    Conditions conditions;
    conditions.environment["KAUSTIK_ROOT"] = root.string();
    const Outcome outcome = run(study("cases = [\"C20\"]\n"), conditions);
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_NE(outcome.err.find("2 of 2 rows fail, the first is C20, include/surfaces/fresnel.glsl"),
              std::string::npos)
        << outcome.err;
    EXPECT_NE(contents("out/numerics.csv").find(",FAIL,"), std::string::npos);
}

TEST_F(NumericsStudy, ThatMakesNoSenseIsRefusedWithItsLine) {
    expectFailure(run(study("cases = [\"A4\", \"C99\"]\n")), 2, {"study.toml:3:", "'C99'"});
    expectFailure(run(study("csaes = [\"A4\"]\n")), 2, {"study.toml:3:", "'csaes'", "'cases'"});
    expectFailure(run(study("[base]\nscene = \"ring\"\n")), 2, {"study.toml:3:", "'base'"});
    static_cast<void>(folder.file("study.toml", "name = \"few\"\nsuite = \"numerisc\"\n"));
    expectFailure(run({"experiment", "run", "study.toml"}), 2, {"study.toml:2:", "'numerics'"});
    std::vector<std::string> resumed = study("");
    resumed.emplace_back("--resume");
    expectFailure(run(resumed), 2, {"--resume"});
    EXPECT_EQ(files(), (std::set<std::string>{"study.toml"}));
}

TEST_F(NumericsStudy, InterruptedLeavesNothingBehind) {
    Conditions conditions;
    conditions.folder = folder / ".";
    Program program(study(""), conditions);
    program.waitUntilItHandles(SIGINT);
    program.send(SIGINT);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_NE(outcome.err.find("Interrupted; nothing was written."), std::string::npos)
        << outcome.err;
    EXPECT_EQ(files(), (std::set<std::string>{"study.toml"}));
}

}  // namespace
}  // namespace kaustik::test
