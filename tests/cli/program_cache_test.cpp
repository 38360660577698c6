// SPDX-License-Identifier: MIT
// Compiled programs are kept on disk: the second start compiles none, and a file that is damaged or
// another driver's is as if it were not there.
#include <fstream>

#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {
namespace fs = std::filesystem;

class ProgramCache : public CommandLine {
  protected:
    // Renders the wavy water with the programs in `cache`.
    void render(const std::string& out, const std::vector<std::string>& more = {}) const {
        static_cast<void>(folder.file("wavy.toml", kWavyWater));
        std::vector<std::string> arguments = smallRun("wavy.toml", {"--out", out});
        arguments.insert(arguments.end(), more.begin(), more.end());
        Conditions conditions;
        conditions.environment = {{"KAUSTIK_CACHE", (folder / "cache").string()},
                                  {"KAUSTIK_PROGRAM_CACHE", ""}};
        const Outcome outcome = run(arguments, conditions);
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    }
    [[nodiscard]] std::vector<fs::path> programs() const {
        std::vector<fs::path> all;
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(folder / "cache/programs", none))
            all.push_back(entry.path());
        return all;
    }
    [[nodiscard]] int countOf(const std::string& out, const char* key) const {
        return report(out).at("programs").at(key).get<int>();
    }
};

TEST_F(ProgramCache, CompilesNothingTwiceAndChangesNoPixel) {
    render("cold");
    const int compiled = countOf("cold", "compiled");
    ASSERT_GT(compiled, 5);
    if (programs().empty()) GTEST_SKIP() << "this driver gives no program binaries";
    render("warm");
    EXPECT_EQ(countOf("warm", "compiled"), 0);
    EXPECT_GE(countOf("warm", "loaded"), compiled);
    EXPECT_EQ(contents("cold/caustic.exr"), contents("warm/caustic.exr"));
}

TEST_F(ProgramCache, TakesNoDamagedFile) {
    render("cold");
    std::vector<fs::path> all = programs();
    if (all.size() < 4) GTEST_SKIP() << "this driver gives no program binaries";
    // Cut short, changed within, empty, and another program's.
    fs::resize_file(all[0], fs::file_size(all[0]) / 2);
    {
        std::fstream file(all[1], std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(-1, std::ios::end);
        file.put('\x7f');
    }
    fs::resize_file(all[2], 0);
    fs::copy_file(all[4 % all.size()], all[3], fs::copy_options::overwrite_existing);
    render("damaged");
    EXPECT_GE(countOf("damaged", "compiled"), 3);
    EXPECT_EQ(contents("cold/caustic.exr"), contents("damaged/caustic.exr"));
    render("mended");
    EXPECT_EQ(countOf("mended", "compiled"), 0);
}

TEST_F(ProgramCache, IsLeftAloneWhereThatIsAskedFor) {
    render("none", {"--no-program-cache"});
    EXPECT_TRUE(programs().empty());
    EXPECT_EQ(countOf("none", "loaded"), 0);
}

TEST_F(ProgramCache, ThatCannotBeWrittenIsNoError) {
    static_cast<void>(folder.file("cache", "a file where the folder would be"));
    render("out");
    EXPECT_GT(countOf("out", "compiled"), 5);
}

}  // namespace
}  // namespace kaustik::test
