// SPDX-License-Identifier: MIT
// A command line, run in this process with a registry of the test's own.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "framework/app/commands.h"

namespace kaustik::test {

struct CommandResult {
    int exitCode;
    std::string out;  // standard output
    std::string err;  // standard error
};

inline CommandResult runCommandLine(const Registry& registry, std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "kaustik");
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int code =
        app::runCommandLine(static_cast<int>(arguments.size()), arguments.data(), registry);
    std::string out = testing::internal::GetCapturedStdout();
    return {code, std::move(out), testing::internal::GetCapturedStderr()};
}

}  // namespace kaustik::test
