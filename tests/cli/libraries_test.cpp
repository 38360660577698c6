// SPDX-License-Identifier: MIT
// What the program needs to start: neither GLFW nor X11, which the workbench loads.
#include <array>
#include <cstdio>

#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

using Libraries = CommandLine;

TEST_F(Libraries, OfTheProgramAreNoneOfWindows) {
    std::string list;
    FILE* const pipe = ::popen("ldd '" KAUSTIK_BINARY "'", "r");
    ASSERT_NE(pipe, nullptr);
    std::array<char, 4096> line{};
    while (std::fgets(line.data(), static_cast<int>(line.size()), pipe) != nullptr)
        list += line.data();
    ASSERT_EQ(::pclose(pipe), 0);
    ASSERT_NE(list.find("libepoxy"), std::string::npos) << list;
    for (const char* window : {"libglfw", "libX11", "libxcb", "libwayland"})
        EXPECT_EQ(list.find(window), std::string::npos) << list;
}

TEST_F(Libraries, OfWindowsAreAskedForWhereTheWorkbenchLacksThem) {
    static_cast<void>(folder.file("libglfw.so.3", ""));  // found first, and no library
    Conditions noLibrary;
    noLibrary.environment = {{"LD_LIBRARY_PATH", (folder / ".").string()},
                             {"XDG_CONFIG_HOME", (folder / "config").string()}};
    const Outcome outcome = run({"gui", "pool"}, noLibrary);
    if (outcome.err.find("without the workbench") != std::string::npos) GTEST_SKIP();
    expectFailure(outcome, 1, {"GLFW", "libglfw.so.3", "Install", "libglfw3", "kaustik run"});
}

}  // namespace
}  // namespace kaustik::test
