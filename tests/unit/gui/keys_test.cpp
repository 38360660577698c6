// SPDX-License-Identifier: MIT
#include "framework/gui/keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

namespace kaustik::gui::test {
namespace {

TEST(KeyOfCharacter, IsTheKeyThatSaysSoOnAUSKeyboard) {
    EXPECT_EQ(keyOfCharacter(GLFW_KEY_Q, "a"), GLFW_KEY_A) << "French";
    EXPECT_EQ(keyOfCharacter(GLFW_KEY_Y, "z"), GLFW_KEY_Z) << "German";
    EXPECT_EQ(keyOfCharacter(GLFW_KEY_SEMICOLON, "m"), GLFW_KEY_M) << "French";
    EXPECT_EQ(keyOfCharacter(GLFW_KEY_SLASH, "-"), GLFW_KEY_MINUS) << "German";
    EXPECT_EQ(keyOfCharacter(GLFW_KEY_W, "Z"), GLFW_KEY_Z);
    EXPECT_EQ(keyOfCharacter(GLFW_KEY_S, "s"), GLFW_KEY_S);
}

TEST(KeyOfCharacter, IsNoLettersKeyWhereThePlaceSaysAnotherSign) {
    EXPECT_EQ(keyOfCharacter(GLFW_KEY_M, ","), GLFW_KEY_COMMA) << "French";
    EXPECT_EQ(keyOfCharacter(GLFW_KEY_M, "!"), GLFW_KEY_UNKNOWN);
}

TEST(KeyOfCharacter, IsThePlaceWhereNoLatinCharacterIsTyped) {
    EXPECT_EQ(keyOfCharacter(GLFW_KEY_S, "ы"), GLFW_KEY_S) << "Russian";
    EXPECT_EQ(keyOfCharacter(GLFW_KEY_F1, ""), GLFW_KEY_F1);
    EXPECT_EQ(keyOfCharacter(GLFW_KEY_LEFT_CONTROL, ""), GLFW_KEY_LEFT_CONTROL);
    // The keypad's keys are others than those with the same signs.
    EXPECT_EQ(keyOfCharacter(GLFW_KEY_KP_ADD, "+"), GLFW_KEY_KP_ADD);
    EXPECT_EQ(keyOfCharacter(GLFW_KEY_KP_0, "0"), GLFW_KEY_KP_0);
}

}  // namespace
}  // namespace kaustik::gui::test
