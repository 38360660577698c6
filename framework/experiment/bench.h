// SPDX-License-Identifier: MIT
// Times of scenes that are kept (`kaustik bench save`), and what two versions of them say of each
// other (`kaustik bench compare`).
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace kaustik::experiment {

// Milliseconds, a median for each round.
struct SceneTimes {
    std::vector<double> frame;
    std::map<std::string, std::vector<double>> passes;  // those that have run in every round
};

// Schema kaustik.bench/1.
struct Bench {
    std::string version;
    std::string date;              // of the first round, UTC
    std::string device;            // the model that the times are of
    std::string settings;          // what all scenes were rendered with, as words of a command line
    double otherProcessors = 0.0;  // that other work kept busy, at most
    std::map<std::string, SceneTimes> scenes;
};

[[nodiscard]] nlohmann::json benchJson(const Bench& bench);
// Throws IoError for a file that cannot be read or is no bench.
[[nodiscard]] Bench readBench(const std::filesystem::path& file);

enum class Verdict { undecided, faster, slower };

// The time of the second over that of the first, as a ratio of geometric means, and the interval
// that holds it with the asked confidence: Welch's of the logarithms. Fewer than two rounds of
// either have no interval.
struct TimeChange {
    double ratio = 1.0;
    double low = 0.0;
    double high = 0.0;  // infinite without an interval
    [[nodiscard]] Verdict verdict() const {
        return low > 1.0 ? Verdict::slower : high < 1.0 ? Verdict::faster : Verdict::undecided;
    }
};
// Times are above 0. `doubt`: how probable it may be that the interval does not hold the ratio.
[[nodiscard]] TimeChange changeOfTime(const std::vector<double>& before,
                                      const std::vector<double>& after, double doubt);

// Student's t that is exceeded, to either side, with probability `doubt`; `degrees` at least 1.
[[nodiscard]] double studentT(double degrees, double doubt);

struct SceneChange {
    std::string scene;
    TimeChange frame;
    std::map<std::string, TimeChange> passes;  // of both
};
// Scenes of both. All frames together are in doubt with 5 %, however many scenes there are; each
// scene's passes among themselves likewise. Throws ConfigError where the two are of different
// devices or settings, or have no scene in common.
[[nodiscard]] std::vector<SceneChange> compareBenches(const Bench& before, const Bench& after);

}  // namespace kaustik::experiment
