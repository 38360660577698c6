// SPDX-License-Identifier: MIT
// Where recordings go.
#include "framework/gui/recording_name.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace kaustik::gui {
namespace {

class RecordFolder : public testing::Test {
  protected:
    RecordFolder() { ::setenv("HOME", "/home/somebody", 1); }
    ~RecordFolder() override { ::setenv("HOME", before_.c_str(), 1); }
    [[nodiscard]] static std::string of(const std::string& typed) {
        PanelState panels;
        panels.recordFolder = typed;
        return recordFolder(panels).string();
    }

  private:
    std::string before_ = std::getenv("HOME") != nullptr ? std::getenv("HOME") : "";
};

TEST_F(RecordFolder, IsWhatWasTyped) {
    EXPECT_EQ(of("shots/today"), "shots/today");
    EXPECT_EQ(of("/shots"), "/shots");
    EXPECT_EQ(of("shots/~"), "shots/~");
    EXPECT_EQ(of("~somebody"), "~somebody") << "whose home that is only a shell knows";
}

TEST_F(RecordFolder, IsInTheHomeFolderAfterATilde) {
    EXPECT_EQ(of("~"), "/home/somebody");
    EXPECT_EQ(of("~/shots"), "/home/somebody/shots");
}

TEST_F(RecordFolder, IsWhereTheProgramWasStartedWithoutAName) {
    EXPECT_EQ(of(""), ".");
}

}  // namespace
}  // namespace kaustik::gui
