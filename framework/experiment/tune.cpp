// SPDX-License-Identifier: MIT
#include "framework/experiment/tune.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace kaustik::experiment {
namespace {

// What most techniques have on most scenes: how error goes with the number of photons, and which
// part of the time of 128² is theirs.
constexpr double kUsualErrorSlope = -0.6;
constexpr double kUsualShareOfPhotons = 0.6;
constexpr double kFarthest = 16.0;
// An error that falls more slowly comes to nothing.
constexpr double kLeastErrorSlope = -0.05;

double photonsOf(int side) {
    return static_cast<double>(side) * static_cast<double>(side);
}

// Sixteen photons are what some devices take at once, and fewer steps are not felt.
constexpr int kSideStep = 16;

int sideOf(double photons) {
    const double side = std::sqrt(std::clamp(photons, 1.0, 1e12));
    const int rounded = kSideStep * static_cast<int>(std::lround(side / kSideStep));
    return std::clamp(rounded, kMinSide, kMaxSide);
}

// The nearest side from this one on, towards the goal, that is not measured yet or meets it: what
// has missed an error by a part in a thousand is one step from it.
int sideTowards(const std::vector<TunePoint>& of, const TuneGoal& goal, int side) {
    const auto hasMissedIt = [&] {
        return std::any_of(of.begin(), of.end(), [&](const TunePoint& point) {
            return point.side == side && !isMet(point, goal);
        });
    };
    const int step = goal.error ? kSideStep : -kSideStep;
    while (hasMissedIt() && side + step >= kMinSide && side + step <= kMaxSide)
        side += step;
    return side;
}

// The error of so many photons: error(at) (photons / at)^slope.
struct ErrorLaw {
    double at = 1.0;
    double error = 0.0;
    double slope = kUsualErrorSlope;
    ErrorLaw(const TunePoint& other, const TunePoint& near)
        : at(photonsOf(near.side)), error(std::max(near.error, 1e-300)) {
        if (near.side == other.side || !(near.error > 0.0) || !(other.error > 0.0)) return;
        slope = std::log(near.error / other.error) /
                std::log(photonsOf(near.side) / photonsOf(other.side));
    }
    [[nodiscard]] double of(double photons) const { return error * std::pow(photons / at, slope); }
    [[nodiscard]] double photonsFor(double wanted) const {
        return at * std::pow(wanted / error, 1.0 / slope);
    }
};

// Their time: what comes with each of them, and what comes with none.
struct TimeLaw {
    double none = 0.0;
    double each = 0.0;
    TimeLaw(const TunePoint& other, const TunePoint& near) {
        const double photons = photonsOf(near.side);
        each = near.side == other.side
                   ? kUsualShareOfPhotons * near.milliseconds / photons
                   : (near.milliseconds - other.milliseconds) / (photons - photonsOf(other.side));
        each = std::clamp(each, 1e-12, near.milliseconds / photons);
        none = near.milliseconds - each * photons;
    }
    [[nodiscard]] double of(double photons) const { return none + each * photons; }
    [[nodiscard]] double photonsFor(double wanted) const {
        return std::max(wanted - none, 0.0) / each;
    }
};

TuneGuess guess(const std::vector<TunePoint>& of, const TuneGoal& goal) {
    // How far from the goal, in the logarithm of what is asked for.
    const auto distance = [&](const TunePoint& point) {
        return goal.error ? std::abs(std::log(std::max(point.error, 1e-300) / *goal.error))
                          : std::abs(std::log(point.milliseconds / *goal.milliseconds));
    };
    std::vector<TunePoint> nearest = of;
    std::sort(nearest.begin(), nearest.end(),
              [&](const TunePoint& a, const TunePoint& b) { return distance(a) < distance(b); });
    const TunePoint& near = nearest.front();
    const TunePoint& other = nearest.size() > 1 ? nearest[1] : near;
    const TimeLaw time(other, near);
    const ErrorLaw error(other, near);
    double photons = photonsOf(kMaxSide);
    if (goal.error) {
        // Below the reference's noise: fewer photons may do.
        if (near.error <= 0.0) photons = 0.25 * photonsOf(near.side);
        if (near.error > 0.0 && error.slope < kLeastErrorSlope)
            photons = error.photonsFor(*goal.error);
        if (near.error > 0.0 && error.slope >= kLeastErrorSlope)
            photons = near.error <= *goal.error ? photonsOf(near.side) : photonsOf(kMaxSide);
    } else {
        photons = time.photonsFor(*goal.milliseconds);
    }
    // Farther than this a line and a power say nothing.
    const double measured = photonsOf(near.side);
    const int side = sideTowards(
        of, goal, sideOf(std::clamp(photons, measured / kFarthest, measured * kFarthest)));
    return {near.mixture, side, time.of(photonsOf(side)), error.of(photonsOf(side))};
}

}  // namespace

std::string nameOf(const Mixture& mixture) {
    std::string name = mixture.technique;
    for (const auto& [key, value] : mixture.settings)
        name.append(", ").append(key).append("=").append(value);
    return name;
}

std::vector<TuneGuess> guesses(const std::vector<TunePoint>& points, const TuneGoal& goal) {
    std::map<std::size_t, std::vector<TunePoint>> byMixture;
    for (const TunePoint& point : points)
        byMixture[point.mixture].push_back(point);
    std::vector<TuneGuess> found;
    for (const auto& [mixture, of] : byMixture)
        found.push_back(guess(of, goal));
    // What is not expected to reach an error, or to keep to a time, comes after all that is.
    const auto rank = [&](const TuneGuess& a) {
        constexpr double kNearly = 1.1;
        const bool reaches = goal.error ? a.error <= kNearly * *goal.error
                                        : a.milliseconds <= kNearly * *goal.milliseconds;
        const bool byError = goal.error.has_value() != reaches;
        return std::pair(!reaches, byError ? a.error : a.milliseconds);
    };
    std::sort(found.begin(), found.end(),
              [&](const TuneGuess& a, const TuneGuess& b) { return rank(a) < rank(b); });
    return found;
}

bool isMet(const TunePoint& point, const TuneGoal& goal) {
    return goal.error ? point.error <= *goal.error : point.milliseconds <= *goal.milliseconds;
}

const TunePoint* bestOf(const std::vector<TunePoint>& points, const TuneGoal& goal) {
    const TunePoint* best = nullptr;
    for (const TunePoint& point : points) {
        if (!isMet(point, goal)) continue;
        const auto rank = [&](const TunePoint& of) {
            return goal.error ? std::pair(of.milliseconds, of.error)
                              : std::pair(of.error, of.milliseconds);
        };
        if (best == nullptr || rank(point) < rank(*best)) best = &point;
    }
    return best;
}

std::vector<TunePoint> frontOf(std::vector<TunePoint> points) {
    std::sort(points.begin(), points.end(), [](const TunePoint& a, const TunePoint& b) {
        return std::pair(a.milliseconds, a.error) < std::pair(b.milliseconds, b.error);
    });
    std::vector<TunePoint> front;
    for (const TunePoint& point : points) {
        if (front.empty() || point.error < front.back().error) front.push_back(point);
    }
    return front;
}

}  // namespace kaustik::experiment
