// SPDX-License-Identifier: MIT
// How `kaustik tune` goes on from what it has measured: which ways to render are worth another run,
// with how many photons, and which is the best so far. No run happens here.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace kaustik::experiment {

// A technique by default, with some of its settings otherwise.
struct Mixture {
    std::string technique;
    std::vector<std::pair<std::string, std::string>> settings;
};
// "exact_rays, reconstruct=beams".
[[nodiscard]] std::string nameOf(const Mixture& mixture);

// The error wanted in the least time, or the least error in a time. One of them is there.
struct TuneGoal {
    std::optional<double> error;         // relMSE of the caustic, net of the reference's noise
    std::optional<double> milliseconds;  // of the caustic's passes
};

struct TunePoint {
    std::size_t mixture = 0;  // index
    int side = 0;             // photons along each side of a light's grid
    double milliseconds = 0.0;
    double deviation = 0.0;  // of these, standard
    double error = 0.0;      // relMSE, net of the noise; not below 0
    double noise = 0.0;      // relMSE of the reference's noise alone
};

// A run that is worth doing, and what is expected of it.
struct TuneGuess {
    std::size_t mixture = 0;
    int side = 0;
    double milliseconds = 0.0;
    double error = 0.0;
};

// Of what is tried.
inline constexpr int kMinSide = 16;
inline constexpr int kMaxSide = 2048;

// Where the goal is met by one of the mixtures that have points, by its two points that lie
// nearest to it: time is a line of the photons, error a power; with one point by what is usual. The
// best first. Those that are not expected to reach it have the side that comes nearest.
[[nodiscard]] std::vector<TuneGuess> guesses(const std::vector<TunePoint>& points,
                                             const TuneGoal& goal);
[[nodiscard]] bool isMet(const TunePoint& point, const TuneGoal& goal);
// Null where none meets the goal.
[[nodiscard]] const TunePoint* bestOf(const std::vector<TunePoint>& points, const TuneGoal& goal);
// Those that no other is better than in both time and error, by time.
[[nodiscard]] std::vector<TunePoint> frontOf(std::vector<TunePoint> points);

}  // namespace kaustik::experiment
