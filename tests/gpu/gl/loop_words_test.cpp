// SPDX-License-Identifier: MIT
// Words of loops are read some frames later, and tell frames that were left before a loop's end.
#include "framework/gl/loop_words.h"

#include <gtest/gtest.h>

#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

// Words 0, 0, 7 and 0.
gl::Buffer someWords() {
    return {std::vector<std::uint32_t>{0, 0, 7, 0}, "some words"};
}

TEST(LoopWords, TellTheFramesWithALoopThatHasNotEnded) {
    static_cast<void>(context());
    const gl::Buffer words = someWords();
    gl::LoopWords looked;
    // More a frame than there is room for at first, and more frames than the ring has.
    constexpr int kFrames = 11;
    int wrong = 0;
    for (int frame = 0; frame < kFrames; ++frame) {
        const bool isCutShort = frame % 3 == 1;
        wrong += isCutShort ? 1 : 0;
        for (int i = 0; i < 200; ++i)
            looked.copy(words, i == 150 && isCutShort ? 2 : 3);
        looked.endFrame();
    }
    EXPECT_EQ(looked.takeCutShort(true), static_cast<std::size_t>(wrong));
    EXPECT_EQ(looked.takeCutShort(true), 0u);
}

TEST(LoopWords, AreNoneInAFrameWithoutLoops) {
    static_cast<void>(context());
    gl::LoopWords looked;
    for (int frame = 0; frame < 6; ++frame)
        looked.endFrame();
    EXPECT_EQ(looked.takeCutShort(true), 0u);
    looked.copy(someWords(), 2);
    looked.endFrame();
    EXPECT_EQ(looked.takeCutShort(true), 1u);
}

}  // namespace
}  // namespace kaustik::test
