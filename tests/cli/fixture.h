// SPDX-License-Identifier: MIT
// A folder of its own for each test, in which the program is started; a small scene; and what every
// failure has in common.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/cli/program.h"
#include "tests/wavy_water.h"

namespace kaustik::test {

class CommandLine : public testing::Test {
  protected:
    [[nodiscard]] Outcome run(const std::vector<std::string>& arguments,
                              Conditions conditions = {}) const {
        conditions.folder = folder / ".";
        return runKaustik(arguments, conditions);
    }

    // Renders the wavy water into `out`, and expects that it works.
    [[nodiscard]] Outcome renderWater(const std::vector<std::string>& more = {},
                                      const std::string& out = "out") const {
        static_cast<void>(folder.file("wavy.toml", kWavyWater));
        std::vector<std::string> arguments = smallRun("wavy.toml", {"--out", out});
        arguments.insert(arguments.end(), more.begin(), more.end());
        Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return outcome;
    }

    // What is in the test's folder, by name, all folders included.
    [[nodiscard]] std::set<std::string> files() const {
        std::set<std::string> names;
        const std::filesystem::path root = folder / ".";
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
            if (!entry.is_directory()) names.insert(entry.path().lexically_relative(root).string());
        }
        return names;
    }

    [[nodiscard]] std::string contents(const std::string& name) const;
    [[nodiscard]] nlohmann::json report(const std::string& out = "out") const {
        return nlohmann::json::parse(contents(out + "/report.json"));
    }

    // Throws std::runtime_error where there is none.
    [[nodiscard]] static const nlohmann::json& passNamed(const nlohmann::json& report,
                                                         const std::string& name);

    // Nothing on standard output, and on standard error one message that says all of `parts`.
    static void expectFailure(const Outcome& outcome, int exitCode,
                              const std::vector<std::string>& parts);

    TemporaryFolder folder;
};

}  // namespace kaustik::test
