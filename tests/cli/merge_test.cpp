// SPDX-License-Identifier: MIT
// Files of settings (`--merge`) for run and explain: what counts most, and what they may not say.
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

// As a study's [base]: keys of a run, parameters by short and dotted names and as tables.
constexpr const char* kFast = R"(scene = "wavy.toml"
size = "32x24"
frames = 1
warmup = 0
seed = 7
disable = ["compose.direct"]
photons = "8x8"
trace = "march"
"march.steps" = 12
[layers]
count = 3
)";

class Merge : public CommandLine {
  protected:
    Merge() {
        std::filesystem::create_directory(folder / "settings");
        static_cast<void>(folder.file("settings/wavy.toml", kWavyWater));
        static_cast<void>(folder.file("settings/fast.toml", kFast));
    }
    [[nodiscard]] json reportOf(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "run");
        arguments.insert(arguments.end(), {"--out", "out"});
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return outcome.exitCode == 0 ? report() : json();
    }
    void expectRefused(const std::string& text, const std::vector<std::string>& parts) const {
        SCOPED_TRACE(text);
        static_cast<void>(folder.file("bad.toml", text));
        const std::set<std::string> before = files();
        for (const char* command : {"run", "explain"}) {
            expectFailure(run({command, "--merge", "settings/fast.toml", "--merge", "bad.toml"}), 2,
                          parts);
        }
        EXPECT_EQ(files(), before);
    }
};

TEST_F(Merge, SetsWhatTheFileSays) {
    const json report = reportOf({"--merge", "settings/fast.toml"});
    EXPECT_EQ(report.at("scene").at("name"), "wavy");
    EXPECT_EQ(report.at("size"), (json{32, 24}));
    EXPECT_EQ(report.at("frames"), 1);
    EXPECT_EQ(report.at("seed"), 7);
    EXPECT_EQ(report.at("disabled"), json{"compose.direct"});
    const json& parameters = report.at("parameters");
    EXPECT_EQ(parameters.at("emit.photons"), "8x8");
    EXPECT_EQ(parameters.at("trace"), "march");
    EXPECT_EQ(parameters.at("trace.march.steps"), 12);
    EXPECT_EQ(parameters.at("layers.count"), 3);
}

TEST_F(Merge, LaterFilesCountMoreAndTheCommandLineMost) {
    static_cast<void>(folder.file("more.toml",
                                  "seed = 8\ntechnique = 'lens_splats'\ndisable = []\n"
                                  "layers.count = 2\nphotons = '6x6'\n"));
    const json report =
        reportOf({"--merge", "settings/fast.toml", "--merge", "more.toml", "--technique",
                  "screen_space_photons", "--set", "photons=4x4", "--frames", "2"});
    EXPECT_EQ(report.at("technique"), "screen_space_photons");
    EXPECT_EQ(report.at("seed"), 8);
    EXPECT_EQ(report.at("frames"), 2);
    EXPECT_EQ(report.at("disabled"), json::array());
    EXPECT_EQ(report.at("size"), (json{32, 24}));
    EXPECT_EQ(report.at("parameters").at("emit.photons"), "4x4");
    EXPECT_EQ(report.at("parameters").at("layers.count"), 2);
    EXPECT_EQ(report.at("parameters").at("trace.march.steps"), 12);
}

TEST_F(Merge, TheCommandLineNamesAnotherSceneAndPasses) {
    static_cast<void>(folder.file("other.toml", kWavyWater));
    const json report = reportOf(
        {"other.toml", "--merge", "settings/fast.toml", "--disable", "reconstruct.triangles"});
    EXPECT_EQ(report.at("disabled"), json{"reconstruct.triangles"});
}

TEST_F(Merge, ExplainsWhatTheFileSays) {
    const Outcome outcome = run({"explain", "--merge", "settings/fast.toml"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("scene wavy"), std::string::npos);
    EXPECT_NE(outcome.out.find("trace.march "), std::string::npos);
}

TEST_F(Merge, RefusesWhatMakesNoSenseWithItsPlace) {
    expectRefused("\nfrmes = 2\n", {"bad.toml:2:", "'frmes'", "'frames'"});
    expectRefused("trace.epsilom = 0.1\n", {"bad.toml:1:", "did you mean 'trace.epsilon'?"});
    expectRefused("trace = 'linse'\n", {"bad.toml:1:", "did you mean 'lines'?"});
    expectRefused("technique = 'screen_space_photon'\n",
                  {"bad.toml:1:", "did you mean 'screen_space_photons'?"});
    expectRefused("scene = 'rign'\n", {"bad.toml:1:", "did you mean 'ring'?"});
    expectRefused("disable = ['triangls']\n",
                  {"bad.toml:1:", "did you mean 'reconstruct.triangles'?"});
    expectRefused("disable = ['emit.grid']\n", {"bad.toml:1:", "required"});
    expectRefused("layers.count = 65\n", {"bad.toml:1:", "layers.count", "64"});
    expectRefused("photons = '4x4'\nemit.photons = '4x4'\n", {"bad.toml:2:", "both set"});
    expectRefused("frames = 0\n", {"bad.toml:1:", "frames", "from 1 to 1000000"});
    expectRefused("size = '0x5'\n", {"bad.toml:1:", "size"});
    expectRefused("reference = 'atuo'\n", {"bad.toml:1:", "'atuo'", "'auto'"});
    expectRefused("precise = 1\n", {"bad.toml:1:", "true or false"});
    expectRefused("photons = [4, 4]\n", {"bad.toml:1:", "photons", "list"});
    expectRefused("name = 'x'\n[base]\nseed = 1\n", {"bad.toml:2:", "[base]", "experiment"});
    expectRefused("seed = \n", {"bad.toml:1:"});
}

TEST_F(Merge, RefusesFilesThatAreNotThere) {
    expectFailure(run({"run", "--merge", "gone.toml"}), 1, {"gone.toml"});
    static_cast<void>(folder.file("names.toml", "\nscene = 'gone/scene.toml'\n"));
    expectFailure(run({"run", "--merge", "names.toml"}), 1, {"names.toml:2:", "gone/scene.toml"});
}

}  // namespace
}  // namespace kaustik::test
