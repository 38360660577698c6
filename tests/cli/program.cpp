// SPDX-License-Identifier: MIT
#include "tests/cli/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <string_view>
#include <thread>

namespace kaustik::test {
namespace fs = std::filesystem;
namespace {

std::string contentsOf(const fs::path& file) {
    std::ostringstream bytes;
    bytes << std::ifstream(file, std::ios::binary).rdbuf();
    return std::move(bytes).str();
}

std::vector<std::string> environmentWith(const std::map<std::string, std::string>& added) {
    std::vector<std::string> entries;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string_view text = *entry;
        if (!added.contains(std::string(text.substr(0, text.find('='))))) {
            entries.emplace_back(text);
        }
    }
    for (const auto& [name, value] : added)
        entries.push_back(name + "=" + value);
    return entries;
}

std::vector<char*> pointersTo(std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    for (std::string& text : texts)
        pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
}

bool redirect(int descriptor, const char* file) {
    const int opened = ::open(file, O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    return opened >= 0 && ::dup2(opened, descriptor) == descriptor;
}

}  // namespace

Program::Program(const std::vector<std::string>& arguments, const Conditions& conditions) {
    // All memory is had before the fork: the child may only make system calls.
    std::vector<std::string> words = {conditions.program.empty() ? KAUSTIK_BINARY
                                                                 : conditions.program.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<std::string> environment = environmentWith(conditions.environment);
    const std::vector<char*> wordPointers = pointersTo(words);
    const std::vector<char*> environmentPointers = pointersTo(environment);
    const std::string folder = conditions.folder.string();
    const std::string out =
        (conditions.standardOutput.empty() ? captured_ / "out" : conditions.standardOutput)
            .string();
    const std::string err = (captured_ / "err").string();

    process_ = ::fork();
    if (process_ == 0) {
        bool ready = ::chdir(folder.c_str()) == 0 && redirect(STDOUT_FILENO, out.c_str()) &&
                     redirect(STDERR_FILENO, err.c_str());
        if (conditions.largestFileBytes) {
            const rlimit limit{*conditions.largestFileBytes, *conditions.largestFileBytes};
            ready = ready && ::setrlimit(RLIMIT_FSIZE, &limit) == 0;
        }
        if (ready) ::execve(wordPointers[0], wordPointers.data(), environmentPointers.data());
        ::_exit(127);
    }
    EXPECT_GT(process_, 0) << "the program cannot be started";
}

Program::~Program() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
}

void Program::waitUntilItHandles(int signal) const {
    const fs::path status = fs::path("/proc") / std::to_string(process_) / "status";
    for (;;) {
        if (!isRunning()) return;
        std::ifstream lines(status);
        for (std::string line; std::getline(lines, line);) {
            if (!line.starts_with("SigCgt:")) continue;
            const unsigned long long caught = std::stoull(line.substr(7), nullptr, 16);
            if ((caught >> (signal - 1) & 1u) != 0) return;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

void Program::send(int signal) const {
    ::kill(process_, signal);
}

bool Program::isRunning() const {
    if (process_ <= 0) return false;
    siginfo_t ended{};
    ::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT);
    return ended.si_pid != process_;
}

std::string Program::ending() const {
    siginfo_t ended{};
    if (process_ <= 0) return "";
    ::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT);
    if (ended.si_pid != process_) return "";
    return (ended.si_code == CLD_EXITED ? "exit code " : "signal ") +
           std::to_string(ended.si_status);
}

std::string Program::messages() const {
    return contentsOf(captured_ / "err");
}

Outcome Program::wait() {
    int status = 0;
    EXPECT_EQ(::waitpid(process_, &status, 0), process_);
    process_ = -1;
    const int exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return {exitCode, contentsOf(captured_ / "out"), contentsOf(captured_ / "err")};
}

Outcome runKaustik(const std::vector<std::string>& arguments, const Conditions& conditions) {
    return Program(arguments, conditions).wait();
}

std::vector<std::string> smallRun(const std::string& scene, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "run",      scene, "--size", "64x48",         "--frames", "1",
        "--warmup", "0",   "--set",  "photons=32x32", "--set",    "shadow.map.size=64"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

}  // namespace kaustik::test
