// SPDX-License-Identifier: MIT
// The tests of mixtures, or, with --count or --line, mixtures that are drawn at random, or one:
//     mixtures --count 1000 --seed 7 --minimise
//     mixtures --ends
//     mixtures --line "ball --set trace=background" --check "scale 100"
// Ends with 1 where something is found that is not known.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "framework/core/error.h"
#include "framework/gl/context.h"
#include "tests/mixtures/draws.h"
#include "tests/mixtures/finds.h"

namespace {

using namespace kaustik;
using namespace kaustik::mixtures;

int checkLine(Bench& bench, const std::string& line, std::vector<std::string> checks,
              bool minimises) {
    const Mixture mixture = mixtureOf(line);
    if (checks.empty()) {
        checks = {"throws", "refusal"};
        for (const Check& check : checksOfAFrame())
            checks.push_back(check.name);
    }
    int found = 0;
    for (const std::string& check : checks) {
        const std::string problem = problemOf(bench, mixture, check);
        std::cout << check << ": " << (problem.empty() ? "holds" : problem) << std::endl;
        found += problem.empty() ? 0 : 1;
        if (!problem.empty() && minimises)
            std::cout << "  " << lineOf(minimised(bench, mixture, check)) << std::endl;
    }
    return found;
}

}  // namespace

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    if (argc == 1) return RUN_ALL_TESTS();
    CLI::App app("Mixtures of nodes and settings, drawn at random");
    Draws draws;
    std::string line;
    std::vector<std::string> checks;
    app.add_option("--count", draws.count, "How many mixtures are drawn");
    app.add_option("--seed", draws.seed, "Of all of them");
    app.add_option("--first", draws.first, "The number of the first one, of ends from 1");
    app.add_option("--checks", draws.checks, "Checks of each that take further frames");
    app.add_flag("--minimise", draws.minimises, "Drops what a find does not need");
    bool ends = false;
    app.add_flag("--ends", ends, "Costly ends of ranges instead");
    app.add_option("--line", line, "Checks this mixture instead");
    app.add_option("--check", checks, "Of the line; without, those that take no further frame");
    CLI11_PARSE(app, argc, argv);
    try {
        const std::unique_ptr<gl::Context> context = gl::Context::createHeadless(true);
        Bench bench(*context);
        const int found = ends           ? runEnds(bench, std::max(draws.first, 1), draws.count)
                          : line.empty() ? runDraws(bench, draws)
                                         : checkLine(bench, line, checks, draws.minimises);
        return found > 0 ? 1 : 0;
    } catch (const Error& error) {
        std::cerr << error.what() << '\n';
        return error.exitCode();
    }
}
