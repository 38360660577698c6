// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_number.h"
#include "framework/core/json_text.h"
#include "framework/core/names.h"
#include "framework/core/number_text.h"

namespace kaustik {
namespace {
namespace fs = std::filesystem;

TEST(Names, SuggestsWhatWasMeantAndNothingFarFetched) {
    const std::vector<std::string> names = {"trace.epsilon", "trace.lines.width", "emit.photons"};
    EXPECT_EQ(nearestName("trace.epsilom", names), "trace.epsilon");
    EXPECT_EQ(nearestName("epislon", names), "trace.epsilon");
    EXPECT_EQ(nearestName("photon", names), "emit.photons");
    EXPECT_EQ(nearestName("zzzzzz", names), "");
    EXPECT_EQ(didYouMean("zzzzzz", names), "");
    EXPECT_EQ(nearestName("x", {}), "");
}

class Files : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ =
            fs::temp_directory_path() /
            ("kaustik-files-" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
             std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::size_t fileCount() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }
    fs::path folder_;
};

TEST_F(Files, AppearWholeUnderTheirNameAndLeaveNothingElse) {
    writeFileWhole(folder_ / "deep/er/a.txt", "hello");
    EXPECT_EQ(readFile(folder_ / "deep/er/a.txt"), "hello");
    EXPECT_EQ(fileCount(), 1u);
}

TEST_F(Files, AFailedWriteKeepsTheOldFileAndLeavesNoTemporary) {
    writeFileWhole(folder_ / "a.txt", "old");
    const auto failing = [](const fs::path& temporary) {
        std::ofstream(temporary) << "half";
        throw IoError("disk full");
    };
    EXPECT_THROW(writeFileWhole(folder_ / "a.txt", failing), IoError);
    EXPECT_EQ(readFile(folder_ / "a.txt"), "old");
    EXPECT_EQ(fileCount(), 1u);
}

TEST_F(Files, WhatAKilledProcessHasLeftIsRemovedAndNothingElse) {
    // Of its own: a folder is looked through once in a process.
    const fs::path folder = folder_ / "killed";
    std::string left;  // the name of the child's temporary
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        writeFileWhole(folder / "a.txt", [](const fs::path& temporary) {
            std::ofstream(temporary) << "half";
            kill(getpid(), SIGKILL);
        });
    }
    ASSERT_EQ(waitpid(child, nullptr, 0), child);
    for (const auto& entry : fs::directory_iterator(folder))
        left = entry.path().filename().string();
    const std::string number = "." + std::to_string(child) + ".";
    const std::size_t at = left.find(number);
    ASSERT_NE(at, std::string::npos) << left;
    // One of a process that lives, one of another machine's.
    std::string living = left;
    living.replace(at, number.size(), "." + std::to_string(getppid()) + ".");
    std::ofstream(folder / living) << "at work";
    std::ofstream(folder / (".a.elsewhere" + left.substr(at))) << "at work";
    std::ofstream(folder / ".part.txt") << "a user's";
    writeFileWhole(folder / "b.txt", "whole");
    EXPECT_FALSE(fs::exists(folder / left));
    EXPECT_TRUE(fs::exists(folder / living));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 4);
}

// The names of what is in a folder.
std::set<std::string> namesIn(const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.insert(entry.path().filename().string());
    return names;
}

class FilesThatBelongTogether : public Files {
  protected:
    void SetUp() override {
        Files::SetUp();
        writeFileWhole(folder_ / "a.txt", "old");
        writeFileWhole(folder_ / "seal.txt", "old");
    }
};

TEST_F(FilesThatBelongTogether, AppearTogether) {
    {
        FilesTogether together(folder_);
        writeFileWhole(together.workFolder() / "a.txt", "new");
        writeFileWhole(together.workFolder() / "b.txt", "new");
        writeFileWhole(together.workFolder() / "seal.txt", "new");
        EXPECT_EQ(readFile(folder_ / "a.txt"), "old");
        EXPECT_EQ(together.placeOf(together.workFolder() / "b.txt"), folder_ / "b.txt");
        together.publish("seal.txt");
    }
    EXPECT_EQ(namesIn(folder_), (std::set<std::string>{"a.txt", "b.txt", "seal.txt"}));
    for (const char* name : {"a.txt", "b.txt", "seal.txt"})
        EXPECT_EQ(readFile(folder_ / name), "new") << name;
}

TEST_F(FilesThatBelongTogether, LeaveTheOlderOnesAloneUntilAllAreThere) {
    {
        FilesTogether together(folder_);
        writeFileWhole(together.workFolder() / "a.txt", "new");
    }
    EXPECT_EQ(namesIn(folder_), (std::set<std::string>{"a.txt", "seal.txt"}));
    EXPECT_EQ(readFile(folder_ / "a.txt"), "old");
}

TEST_F(FilesThatBelongTogether, DoNotMoveWhereAFolderIsInTheWay) {
    fs::create_directory(folder_ / "b.txt");
    FilesTogether together(folder_);
    for (const char* name : {"a.txt", "b.txt", "seal.txt"})
        writeFileWhole(together.workFolder() / name, "new");
    try {
        together.publish("seal.txt");
        ADD_FAILURE() << "a folder was replaced";
    } catch (const IoError& error) {
        EXPECT_EQ(std::string(error.what()),
                  (folder_ / "b.txt").string() + " cannot be written: it is a folder.");
    }
    EXPECT_EQ(readFile(folder_ / "a.txt"), "old");
    EXPECT_EQ(readFile(folder_ / "seal.txt"), "old");
}

TEST_F(FilesThatBelongTogether, HaveTheirPlacesInMessages) {
    const FilesTogether together(folder_);
    const std::string file = (together.workFolder() / "a.png").string();
    EXPECT_EQ(together.withPlaces(file + " and " + file),
              (folder_ / "a.png").string() + " and " + (folder_ / "a.png").string());
}

TEST_F(FilesThatBelongTogether, LeaveNothingOfAKilledProcess) {
    const fs::path folder = folder_ / "killed together";
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        const FilesTogether together(folder);
        writeFileWhole(together.workFolder() / "a.txt", "half");
        kill(getpid(), SIGKILL);
    }
    ASSERT_EQ(waitpid(child, nullptr, 0), child);
    EXPECT_EQ(namesIn(folder).size(), 1u);
    {
        FilesTogether together(folder);
        writeFileWhole(together.workFolder() / "a.txt", "whole");
        together.publish("a.txt");
    }
    EXPECT_EQ(namesIn(folder), std::set<std::string>{"a.txt"});
}

TEST(JsonText, HoldsWhatIsNoUtf8) {
    const nlohmann::json json = {{"name", "a\xff"}, {"number", 0.5}};
    EXPECT_EQ(jsonText(json), "{\"name\":\"a\xef\xbf\xbd\",\"number\":0.5}");
    EXPECT_EQ(jsonText({{"a", 1}}, 2), "{\n  \"a\": 1\n}");
}

TEST_F(Files, ErrorsNameTheFile) {
    const auto messageOf = [](const auto& action) {
        try {
            action();
        } catch (const IoError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(messageOf([&] { static_cast<void>(readFile(folder_)); }).find("is a directory"),
              std::string::npos);
    EXPECT_NE(messageOf([&] { static_cast<void>(readFile(folder_ / "none")); }).find("none"),
              std::string::npos);
    writeFileWhole(folder_ / "file", "x");
    EXPECT_NE(messageOf([&] { writeFileWhole(folder_ / "file/below.txt", "x"); }).find("file"),
              std::string::npos);
}

TEST(WholeNumber, IsOneThatItsTypeHoldsOrAnError) {
    using nlohmann::json;
    EXPECT_EQ(wholeNumber<int>(json::parse("-3")), -3);
    EXPECT_EQ(wholeNumber<std::uint64_t>(json::parse("18446744073709551615")), ~std::uint64_t{0});
    for (const char* text :
         {"2147483648", "-2147483649", "3.0", "2.6e23", "262100000000000000000044",
          "18446744073709551615", "\"3\"", "null", "true", "[3]"}) {
        EXPECT_THROW(static_cast<void>(wholeNumber<int>(json::parse(text))), json::exception)
            << text;
    }
    EXPECT_THROW(static_cast<void>(wholeNumber<std::uint64_t>(json(-1))), json::exception);
}

TEST(NumberText, HasAllDigitsOfAWholeNumberAndTheFewestOfAnother) {
    EXPECT_EQ(numberText(268435456.0), "268435456");
    EXPECT_EQ(numberText(-1e9), "-1000000000");
    EXPECT_EQ(numberText(0.0), "0");
    EXPECT_EQ(numberText(double{0.01f}), "0.01");
    EXPECT_EQ(numberText(double{1e-6f}), "1e-06");
    EXPECT_EQ(numberText(2.5), "2.5");
    EXPECT_EQ(numberText(1e30), "1e+30");
}

TEST(TomlString, EscapesWhatWouldEndOrBreakIt) {
    EXPECT_EQ(tomlString("pool"), "\"pool\"");
    EXPECT_EQ(tomlString("a \"b\" c\\d"), "\"a \\\"b\\\" c\\\\d\"");
    EXPECT_EQ(tomlString("line\nend\t"), "\"line\\u000aend\\u0009\"");
    EXPECT_EQ(tomlString("Wasser \xc3\xa4"), "\"Wasser \xc3\xa4\"");
}

}  // namespace
}  // namespace kaustik
