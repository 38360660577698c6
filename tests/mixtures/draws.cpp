// SPDX-License-Identifier: MIT
#include "tests/mixtures/draws.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/error.h"
#include "tests/mixtures/finds.h"
#include "tests/mixtures/refusal.h"

namespace kaustik::mixtures {
namespace {

struct Count {
    int made = 0;
    int idle = 0;  // there was nothing to check
    int found = 0;
    int known = 0;
};

class Tally {
  public:
    Tally(Bench& bench, const Draws& draws) : bench_(bench), draws_(draws) {}

    void note(int number, const Mixture& mixture, const std::string& check,
              const Verdict& verdict) {
        const std::string kind = check.substr(0, check.find(' '));
        Count& count = counts_[kind];
        (verdict.isMade ? count.made : count.idle) += 1;
        if (verdict.problem.empty()) return;
        if (knownFindOf(mixture, check) != nullptr) {
            ++count.known;
            return;
        }
        ++count.found;
        std::cout << fmt::format("{} [{}]: {}\n", number, check, verdict.problem);
        Mixture small = mixture;
        if (draws_.minimises && ++minimised_[kind] <= draws_.minimisedAtMost) {
            bench_.forgetRenderers();
            if (problemOf(bench_, mixture, check).empty()) {
                std::cout << "  a renderer that has rendered nothing else does not show it\n";
            } else {
                small = minimised(bench_, mixture, check);
                std::cout << "  " << problemOf(bench_, small, check) << '\n';
            }
        }
        std::cout << "  " << lineOf(small) << std::endl;
    }

    void print() const {
        std::cout << fmt::format("{:10} {:>6} {:>6} {:>6} {:>6}\n", "check", "made", "idle",
                                 "found", "known");
        for (const auto& [name, count] : counts_) {
            std::cout << fmt::format("{:10} {:6} {:6} {:6} {:6}\n", name, count.made, count.idle,
                                     count.found, count.known);
        }
    }

    [[nodiscard]] int found() const {
        int sum = 0;
        for (const auto& [name, count] : counts_)
            sum += count.found;
        return sum;
    }

  private:
    Bench& bench_;
    const Draws& draws_;
    std::map<std::string, Count> counts_;
    std::map<std::string, int> minimised_;
};

void runOne(Bench& bench, const Draws& draws, int number, Tally& tally) {
    Random random(draws.seed, static_cast<std::uint64_t>(number));
    const Mixture mixture = drawMixture(random);
    Refusal refusal;
    const std::optional<Rendered> rendered = renderForChecks(bench, mixture, refusal);
    if (!rendered) {
        const bool isRefused = refusal.isOfRequest || refusal.isOfMemory;
        tally.note(number, mixture, isRefused ? "refusal" : "throws",
                   {true, isRefused ? faultOf(bench, mixture, refusal) : refusal.message});
        return;
    }
    tally.note(number, mixture, "throws", {});
    std::vector<Check> checks = checksOfAFrame();
    std::vector<Check> further = drawnChecks(random, *rendered);
    for (int i = 0; i < draws.checks && !further.empty(); ++i) {
        const std::size_t chosen = random.below(further.size());
        checks.push_back(further[chosen]);
        further.erase(further.begin() + static_cast<std::ptrdiff_t>(chosen));
    }
    for (const Check& check : checks) {
        try {
            tally.note(number, mixture, check.name, check.run(bench, *rendered));
        } catch (const std::exception& error) {
            // A frame of it has been rendered; its variations must be, too.
            if (!refusalOf(error).isOfMemory)
                tally.note(number, mixture, check.name, {true, error.what()});
        }
    }
}

}  // namespace

int runEnds(Bench& bench, int first, int count) {
    int found = 0;
    const std::vector<Mixture> ends = mixturesAtCostlyEnds();
    const auto past = std::min(static_cast<std::size_t>(first - 1 + count), ends.size());
    for (auto i = static_cast<std::size_t>(first - 1); i < past; ++i) {
        const Mixture& mixture = ends[i];
        std::cout << fmt::format("{} of {}: {}", i + 1, ends.size(), lineOf(mixture)) << std::endl;
        std::vector<std::string> problems;
        Refusal refusal;
        const std::optional<Rendered> rendered = renderForChecks(bench, mixture, refusal);
        if (!rendered) problems.push_back(faultOf(bench, mixture, refusal));
        for (const Check& check : checksOfAFrame()) {
            if (rendered && check.name != "energy")
                problems.push_back(check.run(bench, *rendered).problem);
        }
        std::erase(problems, "");
        found += problems.empty() ? 0 : 1;
        std::cout << "  "
                  << (problems.empty() ? rendered ? "holds" : "refused"
                                       : fmt::format("{}", fmt::join(problems, "; ")))
                  << std::endl;
    }
    return found;
}

int runDraws(Bench& bench, const Draws& draws) {
    Tally tally(bench, draws);
    const auto begin = std::chrono::steady_clock::now();
    for (int number = draws.first; number < draws.first + draws.count; ++number) {
        runOne(bench, draws, number, tally);
        if ((number + 1) % 50 != 0) continue;
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        std::cout << fmt::format("{} mixtures, {} frames, {:.0f} s", number + 1 - draws.first,
                                 bench.renders(), seconds)
                  << std::endl;
    }
    tally.print();
    return tally.found();
}

}  // namespace kaustik::mixtures
