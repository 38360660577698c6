// SPDX-License-Identifier: MIT
// Which barriers commands need, by the rules of OpenGL 4.5, section 7.12.2; no device.
#include "framework/gl/barriers.h"

#include <gtest/gtest.h>

namespace kaustik::gl {
namespace {

constexpr GLbitfield kNone = 0;

class BarriersOf : public testing::Test {
  protected:
    // The command that shaders store to `slot` by.
    GLbitfield store(std::size_t slot, Use use = Use::image) {
        return barriers.before({{slot, use, true}});
    }
    GLbitfield use(std::size_t slot, Use use) { return barriers.before({{slot, use}}); }
    Barriers barriers{3};
};

TEST_F(BarriersOf, WhatNoShaderStoredToNeedNone) {
    for (const Use each : {Use::target, Use::fetch, Use::image, Use::storage, Use::vertices,
                           Use::drawCommands, Use::updateTexture, Use::updateBuffer}) {
        EXPECT_EQ(use(0, each), kNone);
    }
    EXPECT_EQ(barriers.before({}), kNone);
}

TEST_F(BarriersOf, EachWayToUseWhatWasStoredNeedsItsOwnAndNoneTwice) {
    for (const Use each : {Use::target, Use::fetch, Use::image, Use::storage, Use::vertices,
                           Use::drawCommands, Use::updateTexture, Use::updateBuffer}) {
        store(0);
        EXPECT_EQ(use(0, each), static_cast<GLbitfield>(each));
        EXPECT_EQ(use(0, each), kNone);
    }
    store(0);
    EXPECT_EQ(use(0, Use::fetch), GL_TEXTURE_FETCH_BARRIER_BIT);
    EXPECT_EQ(use(0, Use::image), GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

TEST_F(BarriersOf, ABarrierIsForAllMemoryAndForNoLaterStore) {
    store(0);
    store(1);
    EXPECT_EQ(use(2, Use::fetch), kNone);
    EXPECT_EQ(use(0, Use::fetch), GL_TEXTURE_FETCH_BARRIER_BIT);
    EXPECT_EQ(use(1, Use::fetch), kNone);
    store(1);
    EXPECT_EQ(use(0, Use::fetch), kNone);
    EXPECT_EQ(use(1, Use::fetch), GL_TEXTURE_FETCH_BARRIER_BIT);
}

TEST_F(BarriersOf, AStoreWaitsForWhateverShadersDidThereBefore) {
    use(0, Use::fetch);
    EXPECT_EQ(store(1), kNone);
    EXPECT_EQ(store(0), GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    EXPECT_EQ(store(0), GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);  // the store before it
    EXPECT_EQ(store(0, Use::storage), GL_SHADER_STORAGE_BARRIER_BIT);
}

TEST_F(BarriersOf, WhatOpenGlOrdersByItselfIsNotWaitedFor) {
    use(0, Use::target);
    use(1, Use::updateTexture);
    EXPECT_EQ(store(0), kNone);
    EXPECT_EQ(store(1), kNone);
}

TEST_F(BarriersOf, ACommandThatNeedsSeveralHasThemInOne) {
    store(0);
    store(1, Use::storage);
    EXPECT_EQ(barriers.before({{0, Use::fetch}, {1, Use::drawCommands}, {2, Use::image, true}}),
              GL_TEXTURE_FETCH_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

}  // namespace
}  // namespace kaustik::gl
