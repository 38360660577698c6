// SPDX-License-Identifier: MIT
// The other side of ReaderProcess: what main() of a reader calls.
#pragma once

#include <functional>
#include <string>

#include "framework/core/error.h"
#include "framework/reading/channel.h"
#include "framework/reading/request.h"
#include "framework/reading/wire.h"

namespace kaustik::reading {

// Sends what `read` makes, or the error that it throws.
template <class Read>
void answer(Channel& channel, const Read& read) {
    const auto refuse = [&](Answer kind, const std::string& message) {
        put(channel, kind);
        put(channel, message);
    };
    try {
        const auto result = read();
        put(channel, Answer::done);
        put(channel, result);
    } catch (const Error& error) {
        refuse(error.exitCode() == kExitBadRequest ? Answer::wrongRequest : Answer::damagedFile,
               error.what());
    }
}

// Limits this process to what its command line says, then lets `handle` answer requests until
// there are no more. Gives the exit code.
[[nodiscard]] int serve(int argc, const char* const* argv,
                        const std::function<void(const Request&, Channel&)>& handle);

}  // namespace kaustik::reading
