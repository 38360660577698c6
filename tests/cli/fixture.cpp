// SPDX-License-Identifier: MIT
#include "tests/cli/fixture.h"

#include <algorithm>
#include <stdexcept>

#include "framework/core/files.h"

namespace kaustik::test {

std::string CommandLine::contents(const std::string& name) const {
    return readFile(folder / name);
}

const nlohmann::json& CommandLine::passNamed(const nlohmann::json& report,
                                             const std::string& name) {
    const nlohmann::json& passes = report.at("passes");
    const auto found = std::find_if(passes.begin(), passes.end(), [&](const nlohmann::json& pass) {
        return pass.at("name") == name;
    });
    if (found == passes.end()) throw std::runtime_error("the report has no pass " + name);
    return *found;
}

void CommandLine::expectFailure(const Outcome& outcome, int exitCode,
                                const std::vector<std::string>& parts) {
    EXPECT_EQ(outcome.exitCode, exitCode);
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(outcome.err.starts_with("kaustik: ")) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const std::string& part : parts) {
        EXPECT_NE(outcome.err.find(part), std::string::npos)
            << "'" << part << "' is missing in: " << outcome.err;
    }
}

}  // namespace kaustik::test
