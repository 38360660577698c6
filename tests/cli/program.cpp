// SPDX-License-Identifier: MIT
#include "tests/cli/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <sstream>
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
    std::vector<std::string> entries = processEnvironment();
    std::erase_if(entries, [&](const std::string& entry) {
        return added.contains(entry.substr(0, entry.find('=')));
    });
    for (const auto& [name, value] : added)
        entries.push_back(name + "=" + value);
    return entries;
}

// A file that is written from its beginning, closed in the end.
class OpenFile {
  public:
    explicit OpenFile(const fs::path& file)
        : descriptor_(::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600)) {}
    ~OpenFile() { ::close(descriptor_); }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    [[nodiscard]] int descriptor() const { return descriptor_; }

  private:
    int descriptor_;
};

}  // namespace

Program::Program(const std::vector<std::string>& arguments, const Conditions& conditions) {
    const fs::path program = conditions.program.empty() ? KAUSTIK_BINARY : conditions.program;
    std::vector<std::string> words = {program.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const OpenFile out(conditions.standardOutput.empty() ? captured_ / "out"
                                                         : conditions.standardOutput);
    const OpenFile err(captured_ / "err");
    const int problem =
        process_.start({.program = program,
                        .words = words,
                        .standard = {kSharedDescriptor, out.descriptor(), err.descriptor()},
                        .environment = environmentWith(conditions.environment),
                        .folder = conditions.folder,
                        .maxFileBytes = conditions.largestFileBytes});
    EXPECT_EQ(problem, 0) << program << " cannot be started: " << std::strerror(problem);
}

void Program::waitUntilItHandles(int signal) const {
    const fs::path status = fs::path("/proc") / std::to_string(process_.id()) / "status";
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
    process_.send(signal);
}

bool Program::isRunning() const {
    return process_.hasStarted() && !process_.endWithin(std::chrono::milliseconds(0));
}

std::string Program::ending() const {
    if (!process_.hasStarted()) return "";
    const std::optional<ProcessEnd> end = process_.endWithin(std::chrono::milliseconds(0));
    if (!end) return "";
    return end->signal != 0 ? "signal " + std::to_string(end->signal)
                            : "exit code " + std::to_string(end->exitCode);
}

std::string Program::messages() const {
    return contentsOf(captured_ / "err");
}

Outcome Program::wait() {
    const ProcessEnd end = process_.hasStarted() ? process_.wait() : ProcessEnd();
    return {end.signal != 0 ? -end.signal : end.exitCode, contentsOf(captured_ / "out"),
            contentsOf(captured_ / "err")};
}

Outcome runKaustik(const std::vector<std::string>& arguments, const Conditions& conditions) {
    return Program(arguments, conditions).wait();
}

std::vector<std::string> smallRun(const std::string& scene, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"run", scene,      "--size", "64x48", "--frames",
                                          "1",   "--warmup", "0",      "--set", "photons=32x32"};
    // The technique that is taken where none is named has no such map.
    if (std::count(more.begin(), more.end(), "--technique") > 0)
        arguments.insert(arguments.end(), {"--set", "shadow.map.size=64"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

}  // namespace kaustik::test
