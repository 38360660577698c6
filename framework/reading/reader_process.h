// SPDX-License-Identifier: MIT
// Lets a process of its own read a file that came from somewhere else. The libraries that read
// files crash, hang or eat memory for some of them, and here that costs the reader, not the
// program: whatever happens is one error that names the file.
//
// The reader is a program of its own, kaustik_reader, next to the running one. To read in a fork
// without another program would be cheaper, but is not safe in a process that has threads and an
// OpenGL context; and the program itself, started once more, would have to be every program that
// links this library: tests and techniques of others, too. It also keeps those libraries out of the
// program's own start.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "framework/core/process.h"
#include "framework/reading/channel.h"
#include "framework/reading/limits.h"
#include "framework/reading/request.h"
#include "framework/reading/wire.h"

namespace kaustik::reading {

class ReaderProcess {
  public:
    explicit ReaderProcess(std::filesystem::path program = defaultProgram(),
                           ReadLimits limits = readLimits());
    ~ReaderProcess();
    ReaderProcess(const ReaderProcess&) = delete;
    ReaderProcess& operator=(const ReaderProcess&) = delete;

    // Has it read one file. Throws what the reader throws (ConfigError, IoError), and ConfigError
    // when the file brings it down, takes it too long or takes too much memory. The process is
    // started by the first request and serves further ones, each with the whole of the time.
    template <class Result>
    [[nodiscard]] Result ask(const Request& request) {
        Result result{};
        exchange(request, [&](Channel& channel) { take(channel, result); });
        return result;
    }

    // kaustik_reader next to the running executable.
    [[nodiscard]] static std::filesystem::path defaultProgram();

  private:
    void exchange(const Request& request, const std::function<void(Channel&)>& takeResult);
    void start();
    enum class Ending { byItself, killed };
    ProcessEnd stop(Ending ending);
    [[noreturn]] void fail(const std::string& name, ChannelEnd end);

    std::filesystem::path program_;
    ReadLimits limits_;
    std::unique_ptr<Channel> channel_;  // null: no process
    Process process_;
};

}  // namespace kaustik::reading
