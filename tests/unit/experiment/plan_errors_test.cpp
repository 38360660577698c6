// SPDX-License-Identifier: MIT
// Experiment files that make no sense: found before anything runs, with file, line and the nearest
// name.
#include <ostream>

#include "tests/unit/experiment/fixture.h"

namespace kaustik::experiment {
namespace {

struct BadSpec {
    std::string name;  // what is bad about it
    std::string text;
    std::vector<std::string> parts;  // what the message says
};

class BadSpecs : public Experiment, public testing::WithParamInterface<BadSpec> {};

TEST_P(BadSpecs, AreRefusedWithFileLineAndAWayOut) {
    const std::string message = problem(GetParam().text);
    for (const std::string& part : GetParam().parts) {
        EXPECT_NE(message.find(part), std::string::npos)
            << "'" << part << "' is missing in: " << message;
    }
}

std::string nameOf(const testing::TestParamInfo<BadSpec>& info) {
    return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadSpecs,
    testing::Values(
        BadSpec{"NotToml", "name = 'x'\n\n[base\n", {"study.toml:3:", "not valid TOML"}},
        BadSpec{"NoName", "repeats = 2\n", {"study.toml:1:", "'name' is missing"}},
        BadSpec{"NameThatIsAPath", "name = '../x'\n", {"study.toml:1:", "letters", "'../x'"}},
        BadSpec{"EmptyName", "name = ''\n", {"study.toml:1:", "letters"}},
        BadSpec{"UnknownTable",
                "name = 'x'\n[permutation]\n",
                {"study.toml:2:", "'permutation'", "did you mean 'permute'?"}},
        BadSpec{"UnknownKeyOutsideTables",
                "name = 'x'\nrepeat = 2\n",
                {"study.toml:2:", "'repeat'", "did you mean 'repeats'?"}},
        BadSpec{"NoRepeats", "name = 'x'\nrepeats = 0\n", {"study.toml:2:", "from 1 to 1000"}},
        BadSpec{"BaseThatIsNoTable", "name = 'x'\nbase = 1\n", {"study.toml:2:", "[base]"}},
        BadSpec{"ChoiceAndTableOfOneName",
                "name = 'x'\n[base]\ntrace = 'lines'\ntrace.epsilon = 0.1\n",
                {"study.toml:4:", "quotes"}}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Keys, BadSpecs,
    testing::Values(BadSpec{"UnknownKey",
                            "name = 'x'\n[base]\nfrmes = 3\n",
                            {"study.toml:3:", "'frmes'", "did you mean 'frames'?"}},
                    BadSpec{"UnknownParameter",
                            "name = 'x'\n[base]\n'trace.epsilom' = 1\n",
                            {"study.toml:3:", "'trace.epsilom'", "did you mean 'trace.epsilon'?"}},
                    BadSpec{"FormerNameOfAParameter",
                            "name = 'x'\n[base]\nframes = 3\nroom = 7\n",
                            {"study.toml:4:", "'room'", "it is called 'trace.lines.width' now"}},
                    BadSpec{"UnknownParameterOfPermute",
                            "name = 'x'\n[permute]\nepsilon = [0.1]\nwidht = [3]\n",
                            {"study.toml:4:", "'widht'", "width"}},
                    BadSpec{"ParameterUnderTwoNames",
                            "name = 'x'\n[base]\nwidth = 1\n'trace.lines.width' = 2\n",
                            {"study.toml:4:", "study.toml:3", "both set trace.lines.width"}},
                    BadSpec{"ParameterPermutedUnderTwoNames",
                            "name = 'x'\n[permute]\nwidth = [1, 2]\nlines.width = [1, 2]\n",
                            {"study.toml:4:", "study.toml:3", "both set trace.lines.width"}}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Values, BadSpecs,
    testing::Values(
        BadSpec{"UnknownTechnique",
                "name = 'x'\n[base]\ntechnique = 'sphere'\n",
                {"study.toml:3:", "no technique 'sphere'"}},
        BadSpec{"UnknownScene",
                "name = 'x'\n[base]\nscene = 'rign'\n",
                {"study.toml:3:", "no scene 'rign'", "did you mean 'ring'?"}},
        BadSpec{"ValueOutOfRange",
                "name = 'x'\n[permute]\nepsilon = [\n  0.1,\n  5.0]\n",
                {"study.toml:5:", "trace.epsilon", "'5.0'"}},
        BadSpec{"ChoiceThatIsNone",
                "name = 'x'\n[base]\ntrace = 'linse'\n",
                {"study.toml:3:", "'linse'", "did you mean 'lines'?"}},
        BadSpec{"FractionOfAFrame",
                "name = 'x'\n[base]\nframes = 2.5\n",
                {"study.toml:3:", "frames", "whole number", "2.5"}},
        BadSpec{"NoFrames", "name = 'x'\n[base]\nframes = 0\n", {"study.toml:3:", "from 1"}},
        BadSpec{"SizeThatIsNone", "name = 'x'\n[base]\nsize = 'big'\n", {"study.toml:3:", "'big'"}},
        BadSpec{"PreciseThatIsText",
                "name = 'x'\n[base]\nprecise = 'yes'\n",
                {"study.toml:3:", "true or false"}},
        BadSpec{
            "TimeThatIsText", "name = 'x'\n[base]\ntime = 'noon'\n", {"study.toml:3:", "seconds"}},
        BadSpec{
            "TimeThatIsInfinite", "name = 'x'\n[base]\ntime = inf\n", {"study.toml:3:", "seconds"}},
        BadSpec{"ReferenceThatIsNotThere",
                "name = 'x'\n[base]\nreference = 'reference.exr'\n",
                {"study.toml:3:", "no file 'reference.exr'"}},
        BadSpec{"ListForAParameter",
                "name = 'x'\n[base]\nepsilon = [0.1]\n",
                {"study.toml:3:", "epsilon", "list"}},
        BadSpec{"TableForAValue",
                "name = 'x'\n[permute]\nepsilon = 0.1\n",
                {"study.toml:3:", "epsilon", "list of values or a range"}}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Lists, BadSpecs,
    testing::Values(
        BadSpec{"EmptyList",
                "name = 'x'\n[permute]\nepsilon = []\n",
                {"study.toml:3:", "epsilon", "empty list"}},
        BadSpec{"RangeThatNeverArrives",
                "name = 'x'\n[permute]\nwidth = {from = 8, to = 1, factor = 2}\n",
                {"study.toml:3:", "no values"}},
        BadSpec{"RangeThatStands",
                "name = 'x'\n[permute]\nwidth = {from = 1, to = 8, factor = 1}\n",
                {"study.toml:3:", "no values"}},
        BadSpec{"RangeAgainstItsStep",
                "name = 'x'\n[permute]\nwidth = {from = 1, to = 8, step = -1}\n",
                {"study.toml:3:", "no values"}},
        BadSpec{"RangeThatMultipliesZero",
                "name = 'x'\n[permute]\nwidth = {from = 0, to = 8, factor = 2}\n",
                {"study.toml:3:", "more than 0"}},
        BadSpec{"RangeOfOneStep",
                "name = 'x'\n[permute]\nwidth = {from = 1, to = 8, steps = 1}\n",
                {"study.toml:3:", "steps", "from 2"}},
        BadSpec{"RangeWithoutAnEnd",
                "name = 'x'\n[permute]\nwidth = {from = 1, factor = 2}\n",
                {"study.toml:3:", "'to' is missing"}},
        BadSpec{"RangeWithAnUnknownKey",
                "name = 'x'\n[permute]\nwidth = {form = 1, to = 8, factor = 2}\n",
                {"study.toml:3:", "'form'", "did you mean 'from'?"}},
        BadSpec{"RangeWithTwoWays",
                "name = 'x'\n[permute]\nwidth = {from = 1, to = 8, factor = 2, steps = 3}\n",
                {"study.toml:3:", "one of factor, step and steps"}},
        BadSpec{"RangeWithTooManyValues",
                "name = 'x'\n[permute]\nepsilon = {from = 0, to = 1, step = 1e-8}\n",
                {"study.toml:3:", "more than 10000"}},
        BadSpec{"TooManyRuns",
                "name = 'x'\n[permute]\nwidth = {from = 1, to = 1000, step = 1}\n"
                "epsilon = {from = 0.1, to = 0.9, steps = 1000}\n",
                {"study.toml:", "1000000 runs", "100000"}},
        BadSpec{"TheSameValueTwice",
                "name = 'x'\n[permute]\nepsilon = [0.1, 0.2,\n 0.10]\n",
                {"study.toml:4:", "would be the same", "study.toml:3"}},
        BadSpec{"TheSameValueWrittenInTwoWays",
                "name = 'x'\n[permute]\ntrace = ['lines']\nphotons = ['8x8', '08x8']\n",
                {"study.toml:4:", "would be the same", "\"08x8\""}}),
    nameOf);

TEST_F(Experiment, ThatIsMissingIsAnIoErrorThatNamesIt) {
    EXPECT_NE(test::messageOf<IoError>([&] {
                  static_cast<void>(readSpec(folder / "no.toml"));
              }).find("no.toml"),
              std::string::npos);
}

}  // namespace
}  // namespace kaustik::experiment
