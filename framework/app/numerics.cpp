// SPDX-License-Identifier: MIT
// A study that is the suite of hard cases: measures in this process, headless, and writes one
// table.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "framework/app/commands.h"
#include "framework/app/numerics.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_text.h"
#include "framework/numerics/lab.h"
#include "framework/numerics/table.h"
#include "framework/run/output.h"
#include "framework/run/progress.h"

namespace kaustik::app {
namespace {

namespace fs = std::filesystem;

std::vector<numerics::Case> chosenCases(const numerics::Suite& suite,
                                        const experiment::Spec& spec) {
    try {
        return numerics::selectCases(suite, spec.cases);
    } catch (const ConfigError& error) {
        throw ConfigError(fmt::format("{}: {}", spec.casesPlace, error.what()));
    }
}

}  // namespace

void runSuite(const ExperimentOptions& options, const experiment::Spec& spec,
              const Registry& registry, AddHardCases addHardCases) {
    if (options.resume) {
        throw ConfigError("--resume: a suite is measured as a whole; leave the option out.");
    }
    numerics::Suite suite = numerics::commonCases();
    if (addHardCases != nullptr) addHardCases(suite);
    numerics::Table table;
    table.cases = chosenCases(suite, spec);
    const fs::path out = options.out.empty() ? fs::path("results/runs/experiments") / spec.name
                                             : fs::path(options.out);
    run::requireWritable(out, "--out");
    const std::unique_ptr<gl::Context> context = gl::Context::createHeadless();
    table.device = context->info().renderer;
    numerics::Lab lab(*context, registry, suite);
    run::catchInterrupts();
    {
        run::Progress progress("case", static_cast<int>(table.cases.size()));
        int done = 0;
        for (const numerics::Case& hardCase : table.cases) {
            run::throwIfInterrupted();
            for (numerics::Row& row : lab.run(hardCase))
                table.rows.push_back(std::move(row));
            progress.update(++done);
        }
    }
    run::throwIfInterrupted();
    writeFileWhole(out / "numerics.csv", numerics::makeCsv(table));
    writeFileWhole(out / "numerics.json", jsonText(numerics::makeJson(table), 2) + "\n");
    writeFileWhole(out / "numerics.md", numerics::makeMarkdown(table));
    fmt::print("{}", numerics::makeText(table));
    for (const char* name : {"numerics.csv", "numerics.json", "numerics.md"})
        fmt::print("wrote {}\n", (out / name).string());
    if (numerics::countFailures(table) > 0) {
        const numerics::Row& first = *std::find_if(table.rows.begin(), table.rows.end(),
                                                   [](const auto& row) { return !row.passes(); });
        throw Error(fmt::format("{} of {} rows fail, the first is {}, {}: {} should be {} and is "
                                "{:.7g}.",
                                numerics::countFailures(table), table.rows.size(), first.caseId,
                                first.subject, first.what, first.expectedText(), first.measured),
                    kExitFailed);
    }
}

}  // namespace kaustik::app
