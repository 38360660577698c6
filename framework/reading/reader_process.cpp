// SPDX-License-Identifier: MIT
#include "framework/reading/reader_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <thread>
#include <vector>

#include "framework/core/error.h"
#include "framework/core/files.h"

namespace kaustik::reading {
namespace fs = std::filesystem;
namespace {

// Destroys what posix_spawn is told.
struct SpawnPlan {
    SpawnPlan() {
        ::posix_spawn_file_actions_init(&files);
        ::posix_spawnattr_init(&attributes);
    }
    ~SpawnPlan() {
        ::posix_spawn_file_actions_destroy(&files);
        ::posix_spawnattr_destroy(&attributes);
    }
    SpawnPlan(const SpawnPlan&) = delete;
    SpawnPlan& operator=(const SpawnPlan&) = delete;
    posix_spawn_file_actions_t files{};
    posix_spawnattr_t attributes{};
};

// The socket as standard input, nothing else of this process: not its files, not what it has done
// about signals.
void planSpawn(SpawnPlan& plan, int socket) {
    ::posix_spawn_file_actions_adddup2(&plan.files, socket, STDIN_FILENO);
    ::posix_spawn_file_actions_addopen(&plan.files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
#ifndef __SANITIZE_ADDRESS__
    // What libraries print there would be a second message beside the one error.
    ::posix_spawn_file_actions_addopen(&plan.files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
#endif
    ::posix_spawn_file_actions_addclosefrom_np(&plan.files, STDERR_FILENO + 1);
    sigset_t none;
    sigset_t all;
    ::sigemptyset(&none);
    ::sigfillset(&all);
    ::posix_spawnattr_setsigmask(&plan.attributes, &none);
    ::posix_spawnattr_setsigdefault(&plan.attributes, &all);
    ::posix_spawnattr_setflags(&plan.attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
}

// This process's environment. The sanitizer's shadow is larger than any limit on address space, so
// that it has to watch the memory itself.
std::vector<std::string> readerEnvironment([[maybe_unused]] const ReadLimits& limits) {
    std::vector<std::string> variables;
    for (char** variable = environ; *variable != nullptr; ++variable)
        variables.emplace_back(*variable);
#ifdef __SANITIZE_ADDRESS__
    const std::string prefix = "ASAN_OPTIONS=";
    std::string options = fmt::format("{}hard_rss_limit_mb={}", prefix, limits.mebibytes);
    std::erase_if(variables, [&](const std::string& variable) {
        if (!variable.starts_with(prefix)) return false;
        options += ":" + variable.substr(prefix.size());
        return true;
    });
    variables.push_back(options);
#endif
    return variables;
}

std::vector<char*> pointersTo(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (std::string& word : words)
        pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

}  // namespace

ReaderProcess::ReaderProcess(fs::path program, ReadLimits limits)
    : program_(std::move(program)), limits_(limits) {}

ReaderProcess::~ReaderProcess() {
    static_cast<void>(stop(Ending::killed));
}

fs::path ReaderProcess::defaultProgram() {
    return helperFolder() / "kaustik_reader";
}

void ReaderProcess::start() {
    std::array<int, 2> sockets{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0) {
        throw IoError(fmt::format("A file cannot be read: no socket for its reader ({}).",
                                  std::strerror(errno)));
    }
    auto channel = std::make_unique<Channel>(sockets[0]);
    SpawnPlan plan;
    planSpawn(plan, sockets[1]);
    std::vector<std::string> words = {program_.string(), std::to_string(limits_.seconds),
                                      std::to_string(limits_.mebibytes)};
    std::vector<std::string> variables = readerEnvironment(limits_);
    const int problem = ::posix_spawn(&process_, program_.c_str(), &plan.files, &plan.attributes,
                                      pointersTo(words).data(), pointersTo(variables).data());
    ::close(sockets[1]);
    if (problem != 0) {
        throw IoError(
            fmt::format("{} cannot be started ({}); it reads all files, and belongs "
                        "beside the program. Build the target kaustik_reader.",
                        program_.string(), std::strerror(problem)));
    }
    channel_ = std::move(channel);
}

// Ends the process, if there is one, and gives its wait status.
int ReaderProcess::stop(Ending ending) {
    if (channel_ == nullptr) return 0;
    channel_.reset();
    int status = 0;
    // What has closed its socket is about to be gone; a moment, so that it can be told how it went.
    constexpr int kMostLooks = 200;
    for (int look = 0; ending == Ending::byItself && look < kMostLooks; ++look) {
        if (::waitpid(process_, &status, WNOHANG) == process_) return status;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ::kill(process_, SIGKILL);
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

// What has become of the reader, as one error that names the file.
void ReaderProcess::fail(const std::string& name, ChannelEnd end) {
    const int status = stop(end == ChannelEnd::closed ? Ending::byItself : Ending::killed);
    const bool isSignal = end == ChannelEnd::closed && WIFSIGNALED(status);
    const int signal = isSignal ? WTERMSIG(status) : 0;
    if (signal == SIGINT || signal == SIGTERM) {
        throw Error(fmt::format("Interrupted while {} was read.", name), kExitFailed);
    }
    if (end == ChannelEnd::late || signal == SIGXCPU) {
        throw ConfigError(fmt::format(
            "{} takes more than {} s to read, so that it is damaged or far too large. Export it "
            "again. {}",
            name, end == ChannelEnd::late ? limits_.clockSeconds() : limits_.seconds,
            limits_.timeAdvice()));
    }
    const bool isOutOfMemory = end == ChannelEnd::tooMuch || signal == SIGKILL ||
                               (WIFEXITED(status) && WEXITSTATUS(status) == kExitOutOfMemory);
    if (isOutOfMemory) {
        throw ConfigError(fmt::format(
            "{} needs more than {} MiB of memory to be read, so that it is damaged or far too "
            "large. Export it again. {}",
            name, limits_.mebibytes, limits_.memoryAdvice()));
    }
    throw ConfigError(fmt::format(
        "{} is damaged, or made to do harm: what reads it was brought down ({}). Export it again, "
        "or leave it alone.",
        name,
        isSignal ? std::string(::strsignal(signal))
                 : fmt::format("exit code {}", WIFEXITED(status) ? WEXITSTATUS(status) : -1)));
}

void ReaderProcess::exchange(const Request& request,
                             const std::function<void(Channel&)>& takeResult) {
    constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20;
    for (bool isFirstTry = true;; isFirstTry = false) {
        const bool wasRunning = channel_ != nullptr;
        if (!wasRunning) start();
        channel_->limit(Channel::Clock::now() + std::chrono::seconds(limits_.clockSeconds()),
                        limits_.mebibytes * kMebibyte);
        try {
            put(*channel_, request);
            channel_->flush();
            Answer answer = Answer::done;
            take(*channel_, answer);
            if (answer == Answer::done) return takeResult(*channel_);
            std::string message;
            take(*channel_, message);
            if (answer == Answer::wrongRequest) throw ConfigError(message);
            throw IoError(message);
        } catch (const ChannelEnd& end) {
            // One that was asked before may have ended by itself in the meantime: nobody's fault.
            const bool mayHaveLeft =
                wasRunning && isFirstTry && end == ChannelEnd::closed && channel_->received() == 0;
            if (!mayHaveLeft) fail(request.name, end);
            static_cast<void>(stop(Ending::byItself));
        } catch (const Error&) {
            throw;
        } catch (...) {
            static_cast<void>(stop(Ending::killed));  // who knows what is still to come
            throw;
        }
    }
}

}  // namespace kaustik::reading
