// SPDX-License-Identifier: MIT
// Another program, started and waited for.
#pragma once

#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace kaustik::experiment {

struct ProcessOutcome {
    int exitCode = -1;         // -1 where a signal ended it
    std::string messages;      // what it wrote to standard error
    bool interrupted = false;  // it was ended because `isInterrupted` said so
    std::string signal;        // the name of the signal that ended it, or ""

    // What went wrong, in one sentence or two; "" for exit code 0.
    [[nodiscard]] std::string problem() const;
};

enum class StandardOutput { dropped, shared };

// Runs `program words[1] …` to its end; words[0] is what the program sees as its name. It ends when
// the thread that calls does, however that ends. A key pressed at the terminal reaches only this
// program, which then decides. `endingSignal` is what it gets once `isInterrupted` says so: one
// that it may answer, such as SIGINT, gives it time to end in order, which is waited for. Throws
// IoError when it cannot be started.
[[nodiscard]] ProcessOutcome runProcess(const std::filesystem::path& program,
                                        const std::vector<std::string>& words,
                                        StandardOutput output,
                                        const std::function<bool()>& isInterrupted,
                                        int endingSignal = SIGKILL);

}  // namespace kaustik::experiment
