// SPDX-License-Identifier: MIT
// Files that need no OpenImageIO, errors that name the file, and disks that are full.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <string>

#include "framework/core/error.h"
#include "framework/image/image.h"
#include "framework/image/module_loader.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik {
namespace {

using test::messageOf;
using test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;

Image ramp(int width, int height, int channels) {
    Image image(width, height, channels);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        image.values[i] = static_cast<float>(i) / static_cast<float>(image.values.size());
    }
    return image;
}

TEST(ImageFile, APfmComesBackBitForBit) {
    const TemporaryFolder folder;
    for (const int channels : {1, 3}) {
        const Image image = ramp(7, 5, channels);
        writeImage(folder / "ramp.pfm", image);
        const Image back = readImage(folder / "ramp.pfm");
        EXPECT_EQ(back.width, 7);
        EXPECT_EQ(back.height, 5);
        EXPECT_EQ(back.channels, channels);
        EXPECT_EQ(back.values, image.values);
    }
}

TEST(ImageFile, TheExtensionMayBeInCapitals) {
    const TemporaryFolder folder;
    writeImage(folder / "ramp.PFM", ramp(2, 2, 1));
    EXPECT_EQ(readImage(folder / "ramp.PFM").values, ramp(2, 2, 1).values);
}

TEST(ImageFile, AMissingFileADirectoryAndAnUnknownKindAreErrorsThatNameThem) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "folder.png");
    const auto read = [](const std::filesystem::path& path) {
        return messageOf<IoError>([&] { (void)readImage(path); });
    };
    EXPECT_THAT(read(folder / "none.pfm"), HasSubstr("none.pfm"));
    EXPECT_THAT(read(folder / "none.exr"),
                AllOf(HasSubstr("none.exr"), HasSubstr("No such file or directory")));
    EXPECT_THAT(read(folder / "folder.png"),
                AllOf(HasSubstr("folder.png"), HasSubstr("is a directory")));
    EXPECT_THAT(messageOf<IoError>([&] { writeImage(folder / "a.jpeg2", ramp(1, 1, 3)); }),
                AllOf(HasSubstr("a.jpeg2"), HasSubstr(".exr")));
    EXPECT_EQ(folder.fileCount(), 1);
}

TEST(ImageFile, AnImageThatTheFormatCannotHoldIsNotWritten) {
    const TemporaryFolder folder;
    EXPECT_THAT(messageOf<IoError>([&] { writeImage(folder / "a.pfm", ramp(1, 1, 4)); }),
                AllOf(HasSubstr("a.pfm"), HasSubstr("1 or 3 channels, not 4")));
    EXPECT_THAT(messageOf<IoError>([&] { writeImage(folder / "b.exr", Image()); }),
                AllOf(HasSubstr("b.exr"), HasSubstr("no pixels")));
    EXPECT_EQ(folder.fileCount(), 0);
}

TEST(ImageFile, AFolderThatCannotBeMadeIsAnError) {
    const TemporaryFolder folder;
    const auto file = folder.file("file", "not a folder");
    EXPECT_THROW(writeImage(file / "a.pfm", ramp(1, 1, 3)), IoError);
}

// While it lives, no file may grow beyond `bytes`: what a full disk looks like to a writer.
class FullDisk {
  public:
    explicit FullDisk(rlim_t bytes) {
        // Otherwise the signal would end the process where a full disk returns an error.
        previousHandler_ = std::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &previous_);
        const rlimit limited = {bytes, previous_.rlim_max};
        active_ = ::setrlimit(RLIMIT_FSIZE, &limited) == 0;
    }
    ~FullDisk() {
        ::setrlimit(RLIMIT_FSIZE, &previous_);
        (void)std::signal(SIGXFSZ, previousHandler_);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;
    [[nodiscard]] bool active() const { return active_; }

  private:
    rlimit previous_{};
    void (*previousHandler_)(int) = SIG_DFL;
    bool active_ = false;
};

TEST(ImageFile, OnAFullDiskTheOldFileStaysAndNothingHalfWrittenIsLeft) {
    const TemporaryFolder folder;
    std::vector<std::string> names{"a.pfm", "a.ppm"};
    if (hasImageModule()) names.insert(names.end(), {"a.exr", "a.png"});
    for (const std::string& name : names) {
        writeImage(folder / name, ramp(1, 1, 3));
        const auto before = folder.fileCount();
        std::string message;
        {
            const FullDisk disk(40);
            ASSERT_TRUE(disk.active());
            message = messageOf<IoError>([&] { writeImage(folder / name, ramp(64, 64, 3)); });
        }
        EXPECT_THAT(message, HasSubstr((folder / name).string()));
        EXPECT_EQ(folder.fileCount(), before) << name;
        EXPECT_EQ(readImage(folder / name).width, 1) << name;
    }
}

TEST(ImageModule, AMissingModuleSaysThatThisBuildHasNoneAndWhatToUse) {
    const TemporaryFolder folder;
    const ImageModule module = loadImageModule(folder / "kaustik_openimageio.so");
    EXPECT_EQ(module.functions, nullptr);
    EXPECT_THAT(module.problem, AllOf(HasSubstr("no OpenImageIO"), HasSubstr("use .pfm")));
}

TEST(ImageModule, AFileThatIsNoModuleIsRefusedWithTheReason) {
    const TemporaryFolder folder;
    const auto file = folder.file("kaustik_openimageio.so", "not a library");
    const ImageModule module = loadImageModule(file);
    EXPECT_EQ(module.functions, nullptr);
    EXPECT_THAT(module.problem, AllOf(HasSubstr("cannot be loaded"), HasSubstr("use .pfm")));
}

TEST(ImageModule, DecidesWhichExtensionsAreUsed) {
    EXPECT_EQ(floatImageExtension(), hasImageModule() ? ".exr" : ".pfm");
    EXPECT_EQ(displayImageExtension(), hasImageModule() ? ".png" : ".ppm");
}

}  // namespace
}  // namespace kaustik
