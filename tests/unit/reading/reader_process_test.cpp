// SPDX-License-Identifier: MIT
// Whatever a file does to the library that reads it, the program gets one clear error, and can read
// the next file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "framework/core/error.h"
#include "framework/reading/reader_process.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::reading {
namespace {

using kaustik::test::messageOf;
using ::testing::AllOf;
using ::testing::HasSubstr;

class ReaderProcessTest : public ::testing::Test {
  protected:
    static Request requestFor(const std::string& behaviour) {
        return {RequestKind::mesh, "folder/thing.ply", "", behaviour};
    }
    std::string ask(const std::string& behaviour) {
        return reader_.ask<std::string>(requestFor(behaviour));
    }
    // The message of the ConfigError, which is what makes the program end with exit code 2.
    std::string refusalOf(const std::string& behaviour) {
        return messageOf<ConfigError>([&] { (void)ask(behaviour); });
    }
    void expectUnharmed() { EXPECT_EQ(ask("well"), "read well"); }

    explicit ReaderProcessTest(const ReadLimits& limits = {.mebibytes = 512})
        : reader_(KAUSTIK_MISBEHAVING_READER, limits) {}

    ReaderProcess reader_;
};

// Whose reader has a second. The others' have a minute, so that no slow machine ends them.
class HurriedReaderProcessTest : public ReaderProcessTest {
  protected:
    HurriedReaderProcessTest() : ReaderProcessTest({.seconds = 1, .mebibytes = 512}) {}
};

TEST_F(ReaderProcessTest, ServesSeveralRequests) {
    EXPECT_EQ(ask("first"), "read first");
    EXPECT_EQ(ask("second"), "read second");
}

TEST_F(ReaderProcessTest, ThatIsBroughtDownIsOneErrorThatNamesTheFile) {
    for (const char* how : {"crash", "abort", "overflow", "exit", "throw", "half"}) {
        SCOPED_TRACE(how);
        EXPECT_THAT(refusalOf(how), AllOf(HasSubstr("folder/thing.ply is damaged"),
                                          HasSubstr("brought down"), HasSubstr("Export it again")));
        expectUnharmed();
    }
}

TEST_F(HurriedReaderProcessTest, ThatComputesForEverIsEndedAndSaysHowToAllowMore) {
    EXPECT_THAT(refusalOf("hang"),
                AllOf(HasSubstr("folder/thing.ply takes more than 1 s to read"),
                      HasSubstr("Export it again"), HasSubstr("set KAUSTIK_READ_SECONDS")));
    expectUnharmed();
}

TEST_F(HurriedReaderProcessTest, ThatWaitsForEverIsEnded) {
    EXPECT_THAT(refusalOf("wait"), AllOf(HasSubstr("folder/thing.ply takes more than 5 s"),
                                         HasSubstr("set KAUSTIK_READ_SECONDS")));
    expectUnharmed();
}

TEST_F(ReaderProcessTest, ThatEatsMemoryIsEndedAndSaysHowToAllowMore) {
    for (const char* how : {"memory", "catch"}) {
        SCOPED_TRACE(how);
#ifdef __SANITIZE_ADDRESS__
        // The sanitizer ends the process with an exit code of its own; that it is ended counts.
        EXPECT_THAT(refusalOf(how), HasSubstr("folder/thing.ply"));
#else
        EXPECT_THAT(refusalOf(how),
                    AllOf(HasSubstr("folder/thing.ply needs more than 512 MiB"),
                          HasSubstr("Export it again"), HasSubstr("set KAUSTIK_READ_MEBIBYTES")));
#endif
        expectUnharmed();
    }
}

TEST_F(ReaderProcessTest, ThatClaimsToSendMoreThanItMayIsEndedAtTheLimit) {
    EXPECT_THAT(refusalOf("lie"), HasSubstr("folder/thing.ply needs more than 512 MiB"));
    expectUnharmed();
}

TEST_F(ReaderProcessTest, HandsOnTheErrorsOfTheReaderAsTheyAre) {
    EXPECT_EQ(refusalOf("refuse"), "folder/thing.ply:3: no such thing.");
    EXPECT_EQ(messageOf<IoError>([&] { (void)ask("damaged"); }), "folder/thing.ply is cut off.");
    expectUnharmed();
}

TEST_F(ReaderProcessTest, ThatHasLeftBetweenTwoRequestsIsStartedAgain) {
    EXPECT_EQ(ask("leave"), "read leave");
    expectUnharmed();
}

#ifndef __SANITIZE_ADDRESS__  // whose reports must be seen
TEST_F(ReaderProcessTest, KeepsWhatLibrariesPrintToItself) {
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    EXPECT_EQ(ask("print"), "read print");
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}
#endif

TEST_F(ReaderProcessTest, TakesLargeRequests) {
    std::string large(std::size_t{50} << 20, 'x');
    large += "end";
    EXPECT_EQ(ask(large), "read " + large);
}

TEST(ReaderProcesses, LeaveNoProcessBehind) {
    for (const char* behaviour : {"well", "crash"}) {
        ReaderProcess reader(KAUSTIK_MISBEHAVING_READER, {});
        try {
            (void)reader.ask<std::string>({RequestKind::mesh, "thing", "", behaviour});
        } catch (const ConfigError&) {
        }
    }
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
    EXPECT_EQ(errno, ECHILD);
}

TEST(ReaderProcesses, WorkInSeveralThreadsAtOnce) {
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
        threads.emplace_back([i] {
            ReaderProcess reader(KAUSTIK_MISBEHAVING_READER, {});
            for (int j = 0; j < 8; ++j) {
                const std::string text = std::to_string(100 * i + j);
                EXPECT_EQ(reader.ask<std::string>({RequestKind::mesh, "thing", "", text}),
                          "read " + text);
            }
        });
    }
    for (std::thread& thread : threads)
        thread.join();
}

TEST(ReaderProcesses, ThatAreNotThereAreAnErrorThatSaysWhatToBuild) {
    const kaustik::test::TemporaryFolder folder;
    ReaderProcess reader(folder / "kaustik_reader", {});
    EXPECT_THAT(messageOf<IoError>([&] {
                    (void)reader.ask<std::string>({RequestKind::mesh, "thing", "", "well"});
                }),
                AllOf(HasSubstr("kaustik_reader"), HasSubstr("Build the target kaustik_reader")));
}

class ReadLimitsTest : public ::testing::Test {
  protected:
    void TearDown() override {
        ::unsetenv(kSecondsVariable);
        ::unsetenv(kMemoryVariable);
    }
};

TEST_F(ReadLimitsTest, ComeFromTheEnvironment) {
    ::setenv(kSecondsVariable, "7", 1);
    ::setenv(kMemoryVariable, "99", 1);
    EXPECT_EQ(readLimits().seconds, 7u);
    EXPECT_EQ(readLimits().mebibytes, 99u);
    ::setenv(kSecondsVariable, "", 1);
    EXPECT_EQ(readLimits().seconds, ReadLimits().seconds);
}

TEST_F(ReadLimitsTest, ThatAreNoWholeNumbersAboveZeroAreRefusedByName) {
    for (const char* bad : {"0", "-1", "1.5", "many", "1e3", "99999999999999999999"}) {
        ::setenv(kMemoryVariable, bad, 1);
        EXPECT_THAT(messageOf<ConfigError>([] { (void)readLimits(); }),
                    AllOf(HasSubstr("KAUSTIK_READ_MEBIBYTES"), HasSubstr(bad)));
    }
}

}  // namespace
}  // namespace kaustik::reading
