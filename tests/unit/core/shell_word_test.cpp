// SPDX-License-Identifier: MIT
#include "framework/core/shell_word.h"

#include <gtest/gtest.h>

namespace kaustik {
namespace {

TEST(ShellWords, ArePlainWhereNoSignMeansAnything) {
    EXPECT_EQ(shellWord("results/runs/pool-20261121.toml"), "results/runs/pool-20261121.toml");
    EXPECT_EQ(shellWord("--set=a.b=1,2"), "--set=a.b=1,2");
}

TEST(ShellWords, AreQuotedElse) {
    EXPECT_EQ(shellWord("my shots/a.toml"), "'my shots/a.toml'");
    EXPECT_EQ(shellWord("it's"), R"('it'\''s')");
    EXPECT_EQ(shellWord("$HOME"), "'$HOME'");
    EXPECT_EQ(shellWord("~/a"), "'~/a'") << "the name itself, not the home folder";
    EXPECT_EQ(shellWord("Größe"), "'Größe'");
    EXPECT_EQ(shellWord(""), "''");
}

}  // namespace
}  // namespace kaustik
