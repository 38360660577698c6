// SPDX-License-Identifier: MIT
// Studies and requests that make no sense: refused with a message before anything runs, and nothing
// is left behind. What a study may hold is tested in tests/unit/experiment; here it is that the
// program's own scenes, techniques, parameters and passes are what it is compared with.
#include "tests/cli/experiment_fixture.h"

namespace kaustik::test {
namespace {

struct BadStudy {
    std::string name;  // what is bad about it
    std::string text;  // after the base, whose last line is line 10
    std::vector<std::string> parts;
};

class BadStudies : public ExperimentCommand, public testing::WithParamInterface<BadStudy> {};

TEST_P(BadStudies, AreRefusedBeforeAnythingRuns) {
    writeStudy(GetParam().text);
    const std::set<std::string> before = files();
    expectFailure(run(study()), 2, GetParam().parts);
    EXPECT_EQ(files(), before);
}

std::string nameOf(const testing::TestParamInfo<BadStudy>& info) {
    return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(
    Every, BadStudies,
    testing::Values(
        BadStudy{"UnknownKey", "frmes = 2\n", {"study.toml:11:", "'frmes'", "'frames'"}},
        BadStudy{"UnknownTable", "[permut]\n", {"study.toml:11:", "'permut'", "'permute'"}},
        BadStudy{"UnknownParameter",
                 "[permute]\nepsilom = [0.1]\n",
                 {"study.toml:12:", "'epsilom'", "did you mean 'trace.epsilon'?"}},
        BadStudy{"UnknownNode",
                 "[permute]\ntrace = ['lines', 'linse']\n",
                 {"study.toml:12:", "'linse'", "did you mean 'lines'?"}},
        BadStudy{"UnknownTechnique",
                 "[permute]\ntechnique = ['screen_space_photon']\n",
                 {"study.toml:12:", "no technique", "did you mean 'screen_space_photons'?"}},
        BadStudy{"UnknownScene",
                 "[permute]\nscene = ['ring', 'rign']\n",
                 {"study.toml:12:", "'rign'", "did you mean 'ring'?"}},
        BadStudy{"UnknownPass",
                 "disable = ['triangls']\n",
                 {"study.toml:11:", "'triangls'", "did you mean 'reconstruct.triangles'?"}},
        BadStudy{"RequiredPass",
                 "[permute]\ndisable = [[], ['emit.grid']]\n",
                 {"study.toml:12:", "'emit.grid'", "required"}},
        BadStudy{"EmptyList", "[permute]\nseed = []\n", {"study.toml:12:", "seed", "empty list"}},
        BadStudy{"EmptyRange",
                 "[permute]\nseed = {from = 3, to = 1, step = 1}\n",
                 {"study.toml:12:", "seed", "no values"}},
        BadStudy{"RunThatOccursTwice",
                 "[permute]\nseed = [1, 2, 1]\n",
                 {"study.toml:12:", "two runs would be the same", "seed"}},
        BadStudy{"ValueOutOfRange",
                 "[permute]\n'layers.count' = [1, 65]\n",
                 {"study.toml:12:", "layers.count", "'65'", "from 1 to 64"}}),
    nameOf);

using ExperimentRequest = ExperimentCommand;

TEST_F(ExperimentRequest, ForAStudyThatIsMissingNamesTheFile) {
    expectFailure(run({"experiment", "run", "no.toml"}), 1, {"no.toml", "No such"});
}

TEST_F(ExperimentRequest, ForSomethingElseNamesWhatThereIs) {
    expectFailure(run({"experiment", "rnu", "study.toml"}), 2, {"'rnu'", "did you mean 'run'?"});
}

TEST_F(ExperimentRequest, WithAnUnknownOptionNamesTheNearest) {
    expectFailure(run(study({"--resum"})), 2, {"'--resum'", "did you mean '--resume'?"});
}

TEST_F(ExperimentRequest, WithoutAStudyIsRefused) {
    expectFailure(run({"experiment", "run"}), 2, {"target"});
}

TEST_F(ExperimentRequest, ForAReportOfAFolderWithoutResultsSaysHowToGetThem) {
    expectFailure(run({"experiment", "report", "."}), 2, {"no runs.csv", "experiment run"});
}

TEST_F(ExperimentRequest, IntoAFolderThatCannotBeMadeIsRefused) {
    expectFailure(run(study({}, "/proc/none")), 1, {"--out", "/proc/none", "cannot be made"});
}

}  // namespace
}  // namespace kaustik::test
