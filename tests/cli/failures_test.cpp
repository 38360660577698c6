// SPDX-License-Identifier: MIT
// Sensible requests that the machine cannot meet: no device, a full disk, an impatient user. Each
// ends with exit code 1 and one message, and no file is left half written.
#include <signal.h>
#include <sys/mount.h>

#include <algorithm>
#include <map>

#include "framework/image/image.h"
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

using Device = CommandLine;
using Output = CommandLine;
using Interrupt = CommandLine;

// What is left is complete: a file under its final name that can be read.
void expectWhole(const std::filesystem::path& file) {
    EXPECT_FALSE(file.filename().string().starts_with('.')) << file << " is a temporary file";
    if (file.extension() == ".png" || file.extension() == ".exr") {
        EXPECT_EQ(readImage(file).width, 64) << file;
    }
}

TEST_F(Device, ThatIsMissingIsAMessageThatSaysWhatToInstall) {
    Conditions noDriver;
    noDriver.environment = {{"__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent"}};
    expectFailure(run(smallRun("ring"), noDriver), 1,
                  {"OpenGL 4.5", "EGL", "Install", "libegl-mesa0"});
    EXPECT_TRUE(files().empty());
}

TEST_F(Device, WithoutADriverForItIsAMessageThatSaysWhatToInstall) {
    Conditions noDriver;
    noDriver.environment = {
        {"LIBGL_DRIVERS_PATH", "/nonexistent"},
        {"GALLIUM_DRIVER", "nonexistent"},  // Mesa 25 looks in no folder
        {"__EGL_VENDOR_LIBRARY_FILENAMES", "/usr/share/glvnd/egl_vendor.d/50_mesa.json"}};
    expectFailure(run(smallRun("ring"), noDriver), 1,
                  {"OpenGL 4.5", "EGL", "Install", "libgl1-mesa-dri"});
    EXPECT_TRUE(files().empty());
}

TEST_F(Device, OfAnOlderOpenGlIsNamedWithWhatItHas) {
    Conditions older;
    older.environment = {{"MESA_GL_VERSION_OVERRIDE", "3.3"}};
    const Outcome outcome = run(smallRun("ring"), older);
    if (outcome.exitCode == 0) GTEST_SKIP() << "no driver of Mesa's";
    expectFailure(outcome, 1, {"has OpenGL 3.3", "4.5 is needed", "newer driver"});
    EXPECT_TRUE(files().empty());
}

TEST_F(Device, WithoutTheEglLibraryIsAMessageThatSaysWhatToInstall) {
    static_cast<void>(folder.file("libEGL.so.1", ""));  // found first, and no library
    Conditions noLibrary;
    noLibrary.environment = {{"LD_LIBRARY_PATH", (folder / ".").string()}};
    expectFailure(run(smallRun("ring"), noLibrary), 1, {"EGL", "Install", "libegl1"});
}

TEST_F(Device, IsNotNeededForLists) {
    Conditions noDriver;
    noDriver.environment = {{"__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent"}};
    EXPECT_EQ(run({"list", "params"}, noDriver).exitCode, 0);
}

// A folder whose disk is full after a few kilobytes: a file system of its own where one can be
// mounted, else a limit on each file.
class SmallDisk {
  public:
    explicit SmallDisk(const std::filesystem::path& folder) : folder_(folder) {
        std::filesystem::create_directory(folder_);
        isMounted_ = ::mount("none", folder_.c_str(), "tmpfs", 0, "size=8k") == 0;
    }
    ~SmallDisk() {
        if (isMounted_) ::umount(folder_.c_str());
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;
    [[nodiscard]] Conditions conditions() const {
        Conditions conditions;
        if (!isMounted_) conditions.largestFileBytes = 1024;
        return conditions;
    }

  private:
    std::filesystem::path folder_;
    bool isMounted_ = false;
};

TEST_F(Output, OnAFullDiskIsAMessageAndNoHalfFile) {
    const SmallDisk disk(folder / "disk");
    const Outcome outcome = run(smallRun("ring", {"--out", "disk"}), disk.conditions());
    expectFailure(outcome, 1, {"disk/", "cannot be written"});
    for (const std::string& file : files())
        expectWhole(folder / file);
    EXPECT_FALSE(files().contains("disk/report.json"));
}

TEST_F(Output, PastTheLimitOnFilesIsAMessageAndNoHalfFile) {
    Conditions limited;
    limited.largestFileBytes = 1024;  // less than any of the pictures
    const Outcome outcome = run(smallRun("ring", {"--out", "out"}), limited);
    expectFailure(outcome, 1, {"out/", "cannot be written"});
    EXPECT_TRUE(files().empty());
}

TEST_F(Output, ThatCannotBeWrittenWholeLeavesTheOlderRunAsItWas) {
    ASSERT_EQ(run(smallRun("ring", {"--out", "out"})).exitCode, 0);
    std::map<std::string, std::string> before;
    for (const std::string& file : files())
        before[file] = contents(file);
    // The first picture fits, the next does not.
    Conditions limited;
    limited.largestFileBytes = before.at("out/beauty.png").size() + 2000;
    ASSERT_LT(*limited.largestFileBytes, before.at("out/beauty.exr").size());
    const Outcome outcome =
        run(smallRun("ring", {"--out", "out", "--set", "exposure=0.1"}), limited);
    expectFailure(outcome, 1, {"out/beauty.exr", "cannot be written"});
    std::map<std::string, std::string> after;
    for (const std::string& file : files())
        after[file] = contents(file);
    EXPECT_EQ(before.size(), after.size());
    EXPECT_TRUE(before == after) << "a picture of the new run is beside the old report";
    // And where it can, it takes its place.
    ASSERT_EQ(run(smallRun("ring", {"--out", "out", "--set", "exposure=0.1"})).exitCode, 0);
    EXPECT_NE(contents("out/beauty.png"), before.at("out/beauty.png"));
    EXPECT_NE(contents("out/report.json"), before.at("out/report.json"));
    EXPECT_EQ(files().size(), before.size());
}

TEST_F(Output, WhoseFolderIsAFileIsRefusedAndTheFileKept) {
    static_cast<void>(folder.file("taken", "mine"));
    expectFailure(run(smallRun("ring", {"--out", "taken"})), 1, {"--out", "taken"});
    expectFailure(run(smallRun("ring", {"--out", "taken/out"})), 1, {"--out", "taken/out"});
    EXPECT_EQ(files(), std::set<std::string>{"taken"});
    EXPECT_EQ(contents("taken"), "mine");
}

TEST_F(Output, ThatIsAFolderAlreadyUnderAFilesNameIsAMessage) {
    std::filesystem::create_directories(folder / "out/report.json");
    expectFailure(run(smallRun("ring", {"--out", "out"})), 1,
                  {"out/report.json", "cannot be written"});
    for (const std::string& file : files())
        expectWhole(folder / file);
}

TEST_F(Output, OfAListThatCannotBePrintedIsAnError) {
    Conditions full;
    full.standardOutput = "/dev/full";
    expectFailure(run({"list", "params", "--json"}, full), 1, {"output", "No space left"});
}

class InterruptBy : public CommandLine, public testing::WithParamInterface<int> {};

TEST_P(InterruptBy, ASignalEndsALongRunAndNothingIsWritten) {
    Conditions here;
    here.folder = folder / ".";
    std::vector<std::string> endless = smallRun("ring", {"--out", "out"});
    *(std::find(endless.begin(), endless.end(), "--frames") + 1) = "1000000";
    Program program(endless, here);
    program.waitUntilItHandles(GetParam());
    program.send(GetParam());
    expectFailure(program.wait(), 1, {"Interrupted", "nothing was written"});
    EXPECT_TRUE(files().empty());
}

std::string signalName(const testing::TestParamInfo<int>& signal) {
    return signal.param == SIGINT ? "Interrupt" : "Terminate";
}

INSTANTIATE_TEST_SUITE_P(Every, InterruptBy, testing::Values(SIGINT, SIGTERM), signalName);

TEST_F(Interrupt, KeepsTheFilesOfAnEarlierRun) {
    ASSERT_EQ(run(smallRun("ring", {"--out", "out"})).exitCode, 0);
    const std::set<std::string> filesBefore = files();
    const std::string reportBefore = contents("out/report.json");
    Conditions here;
    here.folder = folder / ".";
    std::vector<std::string> endless = smallRun("ring", {"--out", "out"});
    *(std::find(endless.begin(), endless.end(), "--frames") + 1) = "1000000";
    Program program(endless, here);
    program.waitUntilItHandles(SIGINT);
    program.send(SIGINT);
    EXPECT_EQ(program.wait().exitCode, 1);
    EXPECT_EQ(files(), filesBefore);
    EXPECT_EQ(contents("out/report.json"), reportBefore);
}

}  // namespace
}  // namespace kaustik::test
