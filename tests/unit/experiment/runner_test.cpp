// SPDX-License-Identifier: MIT
// A study whose runs lose their device: a program that does as 'kaustik run' does then.
#include "framework/experiment/runner.h"

#include <nlohmann/json.hpp>

#include "framework/core/files.h"
#include "framework/experiment/results.h"
#include "tests/unit/experiment/fixture.h"

namespace kaustik::experiment {
namespace {
namespace fs = std::filesystem;

class ARunner : public Experiment {};

TEST_F(ARunner, GoesOnAfterARunThatHasLostItsDeviceAndKeepsWhatThatHadDone) {
    const fs::path program = folder.file("program.sh",
                                         "#!/bin/sh\n"
                                         "for word; do out=${word#--out=}; done\n"
                                         "case \"$*\" in *--seed=1*) exit 3;; esac\n"
                                         "mkdir -p \"$out/unfinished\"\n"
                                         "echo '{}' > \"$out/unfinished/report.json\"\n"
                                         "echo \"kaustik: The device was lost; what was done is in "
                                         "$out/unfinished.\" >&2\n"
                                         "exit 3\n");
    fs::permissions(program, fs::perms::owner_all);
    const Plan study = plan("name = 'x'\n[permute]\nseed = [1, 2, 3]\n");
    const fs::path out = program.parent_path() / "out";
    const RunnerSummary summary = runPlan(study, {.out = out, .program = program, .shard = {}},
                                          {[] { return false; }, [](int, int) {}});
    EXPECT_EQ(summary.done, 3);
    EXPECT_EQ(summary.failed, 3);
    for (std::size_t i = 0; i < study.runs.size(); ++i) {
        const fs::path failure = failureFile(out, study.runs[i], 1);
        const auto message =
            nlohmann::json::parse(readFile(failure)).at("message").get<std::string>();
        fs::path kept = failure;
        kept.replace_extension(".unfinished");
        EXPECT_EQ(fs::exists(kept / "report.json"), i > 0) << message;
        EXPECT_EQ(message, i > 0 ? "The device was lost; what was done is in " + kept.string() + "."
                                 : "It ended with exit code 3.");
        EXPECT_FALSE(fs::exists(runFolder(out, study.runs[i], 1)));
    }
    EXPECT_TRUE(fs::exists(out / "runs.csv"));
}

}  // namespace
}  // namespace kaustik::experiment
