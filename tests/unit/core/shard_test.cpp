// SPDX-License-Identifier: MIT
#include "framework/core/shard.h"

#include <gtest/gtest.h>

#include "framework/core/error.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik {
namespace {

TEST(Shard, IsWrittenAsOneOfHowMany) {
    EXPECT_EQ(parseShard("2/8", "--shard"), (Shard{2, 8}));
    EXPECT_EQ(parseShard("1/1", "--shard"), (Shard{1, 1}));
}

TEST(Shard, ThatCannotBeIsRefusedByItsText) {
    const auto refusal = [](const char* text) {
        return test::messageOf<ConfigError>([&] { (void)parseShard(text, "--shard"); });
    };
    for (const char* text : {"", "/", "3", "x/y", "1/2/3", "1/ 2", "-1/2", "1/2 ", "1.5/2",
                             "99999999999999999999/2"}) {
        EXPECT_NE(refusal(text).find("is not K/N"), std::string::npos) << text;
    }
    EXPECT_NE(refusal("5/4").find("no shard 5 of 4"), std::string::npos);
    EXPECT_NE(refusal("0/4").find("no shard 0 of 4"), std::string::npos);
    EXPECT_NE(refusal("1/0").find("0 is not a number of shards"), std::string::npos);
    EXPECT_NE(refusal("1/1000001").find("from 1 to 1000000"), std::string::npos);
}

TEST(Shard, HoldsEveryItemOnceInEqualParts) {
    for (const std::uint64_t items : {0u, 1u, 7u, 64u, 1000u}) {
        for (const std::uint64_t count : {1u, 2u, 3u, 8u, 65u}) {
            std::uint64_t next = 0;
            for (std::uint64_t number = 1; number <= count; ++number) {
                const auto [first, end] = rangeOf({number, count}, items);
                EXPECT_EQ(first, next);
                EXPECT_LE(end - first, items / count + 1);
                EXPECT_GE(end - first, items / count);
                next = end;
            }
            EXPECT_EQ(next, items);
        }
    }
}

TEST(ListOfNumbers, JoinsNeighbours) {
    EXPECT_EQ(listOfNumbers({}), "");
    EXPECT_EQ(listOfNumbers({3}), "3");
    EXPECT_EQ(listOfNumbers({3, 4}), "3 and 4");
    EXPECT_EQ(listOfNumbers({2, 4, 5, 6, 7, 9}), "2, 4 to 7 and 9");
}

}  // namespace
}  // namespace kaustik
