// SPDX-License-Identifier: MIT
// Every key of an experiment file, said once, as framework/scene/files/scene_keys.h has those of
// scenes: what reads the file and `kaustik schema experiment` use these functions. run_keys.h has
// the keys of [base] and [permute] that are no parameters.
#pragma once

#include "framework/experiment/spec.h"
#include "framework/experiment/value_range.h"
#include "framework/scene/files/table_reader.h"

namespace kaustik::experiment {

struct StudyKeys {
    std::string name;
    std::string description;
    int repeats = 1;
};
template <class R>
void reflect(R& r, StudyKeys& study) {
    r.folderName(study.name, {"name", "Names the folder of results"});
    r.text(study.description, {"description", "For the report"}, scene::kHasDefault);
    r.count(study.repeats, {"repeats", "Times that each run is made"}, 1, kMaxRepeats,
            scene::kHasDefault);
    r.foreignTable({"base", "What all runs share"}, "base", R::Tables::one);
    r.foreignTable({"permute",
                    "Every combination of one value from each key; several tables are a "
                    "product each"},
                   "permute", R::Tables::oneOrSeveral);
}

// A suite says itself what it renders.
struct SuiteKeys {
    std::string name;
    std::string description;
    std::string suite;
    std::vector<std::string> cases;
};
template <class R>
void reflect(R& r, SuiteKeys& suite) {
    r.folderName(suite.name, {"name", "Names the folder of results"});
    r.text(suite.description, {"description", "For the report"}, scene::kHasDefault);
    r.choice(suite.suite, {"suite", "The hard cases, in place of runs"},
             {{"numerics", "numerics"}});
    r.texts(suite.cases, {"cases", "Only these, such as \"A*\" and \"B13\""});
}

// All values from one number to another.
struct RangeKeys {
    double from = 0.0;
    double to = 0.0;
    std::optional<double> factor;
    std::optional<double> step;
    std::optional<unsigned> steps;
};
template <class R>
void reflect(R& r, RangeKeys& range) {
    r.number(range.from, {"from", "The first value"}, scene::kAnyNumber);
    r.number(range.to, {"to", "The last value"}, scene::kAnyNumber);
    r.number(range.factor, {"factor", "From each value to the next"}, scene::kPositive);
    r.number(range.step, {"step", "From each value to the next"}, scene::kAnyNumber);
    r.count(range.steps, {"steps", "How many values at equal distances"}, 2, kMaxValues);
    r.rule({{"factor", "step", "steps"},
            true,
            "from",
            "a range takes one of factor, step and steps beside from and to"});
}

}  // namespace kaustik::experiment
