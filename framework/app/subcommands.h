// SPDX-License-Identifier: MIT
// The subcommands as the command line declares them: each function adds one with its options and
// help. The registry has to outlive what it gives.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "framework/app/commands.h"
#include "framework/pipeline/registry.h"

namespace kaustik::app {

struct Subcommand {
    CLI::App* parser = nullptr;
    std::function<void()> execute;  // once the command line is parsed; throws Error
};

// subcommands.cpp
[[nodiscard]] Subcommand addRun(CLI::App& app, const Registry& registry);
[[nodiscard]] Subcommand addTiles(CLI::App& app);
[[nodiscard]] Subcommand addBench(CLI::App& app, const Registry& registry);
[[nodiscard]] Subcommand addTune(CLI::App& app, const Registry& registry);
[[nodiscard]] Subcommand addList(CLI::App& app, const Registry& registry);
[[nodiscard]] Subcommand addDoc(CLI::App& app, const Registry& registry);
[[nodiscard]] Subcommand addExplain(CLI::App& app, const Registry& registry);
[[nodiscard]] Subcommand addExperiment(CLI::App& app, const Registry& registry,
                                       AddHardCases addHardCases);
[[nodiscard]] Subcommand addGui(CLI::App& app, const Registry& registry, GuiCommand gui);
[[nodiscard]] Subcommand addCheck(CLI::App& app, const Registry& registry);
[[nodiscard]] Subcommand addSchema(CLI::App& app, const Registry& registry);

// truth_subcommands.cpp
[[nodiscard]] Subcommand addReference(CLI::App& app);
[[nodiscard]] Subcommand addCensus(CLI::App& app, const Registry& registry);
[[nodiscard]] Subcommand addCertify(CLI::App& app);
[[nodiscard]] Subcommand addCompare(CLI::App& app);
[[nodiscard]] Subcommand addImport(CLI::App& app);
[[nodiscard]] Subcommand addExport(CLI::App& app);
[[nodiscard]] Subcommand addJudge(CLI::App& app);

}  // namespace kaustik::app
