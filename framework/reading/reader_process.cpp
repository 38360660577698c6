// SPDX-License-Identifier: MIT
#include "framework/reading/reader_process.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <vector>

#include "framework/core/error.h"

namespace kaustik::reading {
namespace fs = std::filesystem;
namespace {

// This process's environment. The sanitizer's shadow is larger than any limit on address space, so
// that it has to watch the memory itself.
std::vector<std::string> readerEnvironment([[maybe_unused]] const ReadLimits& limits) {
    std::vector<std::string> variables = processEnvironment();
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

}  // namespace

ReaderProcess::ReaderProcess(fs::path program, ReadLimits limits)
    : program_(std::move(program)), limits_(limits) {}

ReaderProcess::~ReaderProcess() {
    static_cast<void>(stop(Ending::killed));
}

void ReaderProcess::start() {
    std::array<int, 2> sockets{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0) {
        throw IoError(fmt::format("A file cannot be read: no socket for its reader ({}).",
                                  std::strerror(errno)));
    }
    auto channel = std::make_unique<Channel>(sockets[0]);
    // The socket as standard input, nothing else of this process: not its files, not what it has
    // done about signals.
    ProcessPlan plan{.program = program_,
                     .words = {program_.string(), std::to_string(limits_.seconds),
                               std::to_string(limits_.mebibytes)},
                     .standard = {sockets[1], kNoDescriptor, kNoDescriptor},
                     .closesOthers = true,
                     .environment = readerEnvironment(limits_),
                     .hasDefaultSignals = true};
#ifdef __SANITIZE_ADDRESS__
    // Else what libraries print there would be a second message next to the one error.
    plan.standard[2] = kSharedDescriptor;
#endif
    const int problem = process_.start(plan);
    ::close(sockets[1]);
    if (problem != 0) {
        throw IoError(
            fmt::format("{} cannot be started ({}); it reads all files, and belongs "
                        "beside the program. Build the target kaustik_reader.",
                        program_.string(), std::strerror(problem)));
    }
    channel_ = std::move(channel);
}

// Ends the process, if there is one, and says how it has ended.
ProcessEnd ReaderProcess::stop(Ending ending) {
    if (channel_ == nullptr) return {0, 0};
    channel_.reset();
    // What has closed its socket is about to be gone; a moment, so that it can be told how it went.
    constexpr std::chrono::milliseconds kMoment{1000};
    if (ending == Ending::killed || !process_.endWithin(kMoment)) process_.send(SIGKILL);
    return process_.wait();
}

// What has become of the reader, as one error that names the file.
void ReaderProcess::fail(const std::string& name, ChannelEnd end) {
    const ProcessEnd ended = stop(end == ChannelEnd::closed ? Ending::byItself : Ending::killed);
    const int signal = end == ChannelEnd::closed ? ended.signal : 0;
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
    const bool isOutOfMemory =
        end == ChannelEnd::tooMuch || signal == SIGKILL || ended.exitCode == kExitOutOfMemory;
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
        signal != 0 ? std::string(::strsignal(signal))
                    : fmt::format("exit code {}", ended.exitCode)));
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
            // One that was asked before may have ended by itself in the meantime, which is no
            // fault.
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
