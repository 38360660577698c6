// SPDX-License-Identifier: MIT
#include "framework/core/process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "framework/core/files.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik {
namespace {

using test::TemporaryFolder;

// What the shell prints of `script`.
std::string printed(const std::string& script, ProcessPlan plan = {}) {
    const TemporaryFolder folder;
    const int file = ::open((folder / "out").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    plan.program = "/bin/sh";
    plan.words = {"sh", "-c", script};
    plan.standard[1] = file;
    Process process;
    EXPECT_EQ(process.start(plan), 0);
    static_cast<void>(process.wait());
    ::close(file);
    return readFile(folder / "out");
}

TEST(AProcess, TellsHowItHasEnded) {
    Process process;
    ASSERT_EQ(process.start({.program = "/bin/sh", .words = {"sh", "-c", "exit 3"}}), 0);
    const ProcessEnd end = process.wait();
    EXPECT_EQ(end.exitCode, 3);
    EXPECT_EQ(end.signal, 0);
    EXPECT_FALSE(process.hasStarted());
}

TEST(AProcess, TellsWhichSignalHasEndedItBeforeItIsWaitedFor) {
    Process process;
    ASSERT_EQ(process.start({.program = "sleep", .words = {"sleep", "1000"}}), 0);
    EXPECT_FALSE(process.endWithin(std::chrono::milliseconds(0)));
    process.send(SIGTERM);
    const auto end = process.endWithin(std::chrono::minutes(10));
    ASSERT_TRUE(end);
    EXPECT_EQ(end->signal, SIGTERM);
    EXPECT_EQ(process.wait().signal, SIGTERM);
}

TEST(AProcess, ThatCannotBeStartedSaysWhy) {
    Process process;
    EXPECT_EQ(process.start({.program = "/nonexistent/program", .words = {"program"}}), ENOENT);
    EXPECT_EQ(process.start({.program = "/", .words = {"folder"}, .closesOthers = true}), EACCES);
    EXPECT_FALSE(process.hasStarted());
}

TEST(AProcess, HasTheEnvironmentAndTheFolderThatItIsGiven) {
    EXPECT_EQ(printed("echo $A; pwd", {.environment = {{"A=b"}}, .folder = "/"}), "b\n/\n");
}

TEST(AProcess, GetsNoDescriptorsThatAreToBeClosed) {
    const int open = ::dup(STDERR_FILENO);  // which exec would hand on
    const std::string script = "test -e /proc/self/fd/" + std::to_string(open) + "; echo $?";
    EXPECT_EQ(printed(script), "0\n");
    EXPECT_EQ(printed(script, {.closesOthers = true}), "1\n");
    ::close(open);
}

TEST(AProcess, MayHandleSignalsAsIfNobodyHadIgnoredThem) {
    // A shell cannot take back that a signal is ignored when it is started.
    const auto before = ::signal(SIGUSR1, SIG_IGN);
    const std::string script = "kill -USR1 $$; echo survived";
    EXPECT_EQ(printed(script), "survived\n");
    EXPECT_EQ(printed(script, {.hasDefaultSignals = true}), "");
    ::signal(SIGUSR1, before);
}

}  // namespace
}  // namespace kaustik
