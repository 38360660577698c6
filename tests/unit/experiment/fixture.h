// SPDX-License-Identifier: MIT
// Experiment files in a folder of their own, parameters that need no technique, and what is made of
// them.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "framework/core/error.h"
#include "framework/experiment/plan.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::experiment {

// What a technique of these tests has: a choice, a number, a whole number and a size.
struct TraceParams {
    float epsilonMeters = 0.01f;
    template <class R>
    void reflect(R& r) {
        r.field(epsilonMeters, "epsilon", "How near is a hit", "m", params::range(1e-6f, 1.0f));
    }
};
struct LinesParams {
    int width = 0;
    template <class R>
    void reflect(R& r) {
        r.field(width, "width", "Texels of a line", "texels", params::range(0, 4096));
        r.renamed("room", "width");
    }
};
struct EmitParams {
    params::Extent photons{256, 256};
    template <class R>
    void reflect(R& r) {
        r.field(photons, "photons", "Photons of the grid", "", params::range(1, 4096));
    }
};

class Experiment : public testing::Test {
  protected:
    Experiment() { static_cast<void>(folder.file("empty.toml", "name = 'empty'\ntime = 0.5\n")); }

    static params::ParamSet makeParams(const std::string& technique, bool /*isAsPublished*/) {
        if (technique != "screen" && technique != "cube") {
            throw ConfigError("There is no technique '" + technique + "'.");
        }
        params::ParamSet set;
        set.declareChoice("trace", "Where do photons land?", {"lines", "march"}, "lines");
        set.declare<TraceParams>("trace");
        set.declare<LinesParams>("trace.lines");
        set.declare<EmitParams>("emit");
        return set;
    }

    // Every experiment here runs the empty scene next to it, unless it says otherwise.
    [[nodiscard]] Plan plan(const std::string& text) const {
        const std::filesystem::path file = folder.file("study.toml", text);
        return makePlan(readSpec(file), {"empty.toml", "screen", "64x48", 8, 1, 1, "none", 1000},
                        makeParams);
    }

    [[nodiscard]] std::string problem(const std::string& text) const {
        return test::messageOf<ConfigError>([&] { static_cast<void>(plan(text)); });
    }

    test::TemporaryFolder folder;
};

}  // namespace kaustik::experiment
