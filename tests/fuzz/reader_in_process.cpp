// SPDX-License-Identifier: MIT
// ReaderProcess without the process: linked in place of framework/reading/reader_process.cpp, so
// that the fuzzer sees what a file does to what reads it. Requests and answers still travel through
// a socket, since the program must not believe the other side either.
#include <sys/socket.h>

#include <array>
#include <cstdlib>
#include <thread>

#include "framework/core/error.h"
#include "framework/importers/answer_request.h"
#include "framework/reading/reader_process.h"

namespace kaustik::reading {

ReaderProcess::ReaderProcess(std::filesystem::path program, ReadLimits limits)
    : program_(std::move(program)), limits_(limits) {}

ReaderProcess::~ReaderProcess() = default;

std::filesystem::path ReaderProcess::defaultProgram() {
    return {};
}

void ReaderProcess::exchange(const Request& request,
                             const std::function<void(Channel&)>& takeResult) {
    std::array<int, 2> sockets{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0) std::abort();
    Channel asks(sockets[0]);
    // A thread, because an answer may be longer than what a socket holds.
    const std::jthread reader([socket = sockets[1]] {
        Channel answers(socket);
        Request received;
        take(answers, received);
        scene::answerRequest(received, answers);
        answers.flush();
    });
    put(asks, request);
    asks.flush();
    Answer answer = Answer::done;
    take(asks, answer);
    if (answer == Answer::done) return takeResult(asks);
    std::string message;
    take(asks, message);
    if (answer == Answer::wrongRequest) throw ConfigError(message);
    throw IoError(message);
}

}  // namespace kaustik::reading
