// SPDX-License-Identifier: MIT
// What `kaustik tune` makes of what it has measured, of techniques whose time and error are known.
#include "framework/experiment/tune.h"

#include <gtest/gtest.h>

#include <cmath>

namespace kaustik::experiment {
namespace {

// A technique that takes begin + perPhoton n ms and has an error of scale n^-slope.
struct Known {
    double begin, perPhoton, scale, slope;
    [[nodiscard]] TunePoint at(std::size_t mixture, int side) const {
        const double n = static_cast<double>(side) * side;
        return {mixture, side, begin + perPhoton * n, 0.0, scale * std::pow(n, -slope), 0.0};
    }
};
constexpr Known kSlow{50.0, 5e-3, 40.0, 1.0};  // right, soon
constexpr Known kCheap{5.0, 2e-4, 2.0, 0.5};   // cheap, but its error falls slowly
constexpr Known kBiased{1.0, 1e-5, 0.2, 0.0};  // never right

TEST(TuneGuesses, AreTheSideThatAPowerLawSays) {
    const std::vector<TunePoint> points = {kCheap.at(0, 128), kCheap.at(0, 256)};
    const TuneGuess guess = guesses(points, {.error = 0.004}).front();
    // 2 / n^0.5 = 0.004 at n = 500².
    EXPECT_NEAR(guess.side, 500, 8);
    EXPECT_NEAR(guess.error, 0.004, 1e-4);
}

TEST(TuneGuesses, PutFirstWhoIsExpectedToBeThereFirst) {
    const std::vector<TunePoint> points = {kSlow.at(0, 128),   kSlow.at(0, 256),
                                           kCheap.at(1, 128),  kCheap.at(1, 256),
                                           kBiased.at(2, 128), kBiased.at(2, 256)};
    // Of an error of 0.01 the cheap one takes 40,000 photons, 13 ms; the other one 4,000, 70 ms.
    EXPECT_EQ(guesses(points, {.error = 0.01}).front().mixture, 1u);
    // Of 1e-4 it would take 400 million.
    EXPECT_EQ(guesses(points, {.error = 1e-4}).front().mixture, 0u);
    // What never comes there is the last one.
    EXPECT_EQ(guesses(points, {.error = 0.01}).back().mixture, 2u);
}

TEST(TuneGuesses, KeepToATime) {
    const std::vector<TunePoint> points = {kSlow.at(0, 128), kSlow.at(0, 256), kCheap.at(1, 128),
                                           kCheap.at(1, 256)};
    const std::vector<TuneGuess> found = guesses(points, {.milliseconds = 20.0});
    EXPECT_EQ(found.front().mixture, 1u);
    EXPECT_NEAR(found.front().milliseconds, 20.0, 1.5);
    // The slow one takes 50 ms with no photon at all.
    EXPECT_GT(found.back().milliseconds, 20.0);
}

// Rounded to the steps that are tried, the guess is what has just missed the goal.
TEST(TuneGuesses, GoOnFromWhatHasJustMissedTheGoal) {
    const TunePoint missed = kCheap.at(0, 176);
    EXPECT_EQ(guesses({kCheap.at(0, 128), missed}, {.error = 0.999 * missed.error}).front().side,
              192);
    EXPECT_EQ(guesses({kCheap.at(0, 128), missed}, {.milliseconds = 0.999 * missed.milliseconds})
                  .front()
                  .side,
              160);
}

TEST(TuneGuesses, AreSidesThatThereAre) {
    for (const double error : {1e-12, 1e6}) {
        for (const int side : {kMinSide, 128, kMaxSide}) {
            const TuneGuess guess = guesses({kCheap.at(0, side)}, {.error = error}).front();
            EXPECT_GE(guess.side, kMinSide);
            EXPECT_LE(guess.side, kMaxSide);
            EXPECT_EQ(guess.side % 16, 0);
            // No farther from what is measured than 16 times the photons.
            EXPECT_LE(guess.side, 4 * side);
        }
    }
    TunePoint exact = kCheap.at(0, 128);
    exact.error = 0.0;  // below the reference's noise
    // Fewer photons may be as right.
    EXPECT_EQ(guesses({exact}, {.error = 1e-3}).front().side, 64);
}

TEST(TuneBest, IsTheSoonestOrTheMostExactThatMeetsTheGoal) {
    const std::vector<TunePoint> points = {kSlow.at(0, 128), kCheap.at(1, 128), kBiased.at(2, 128)};
    EXPECT_EQ(bestOf(points, {.error = 0.01})->mixture, 0u);
    EXPECT_EQ(bestOf(points, {.error = 0.02})->mixture, 1u);
    EXPECT_EQ(bestOf(points, {.milliseconds = 20.0})->mixture, 1u);
    EXPECT_EQ(bestOf(points, {.error = 1e-6}), nullptr);
}

TEST(TuneFront, HasWhomNoOtherBeats) {
    std::vector<TunePoint> points = {kSlow.at(0, 128), kCheap.at(1, 128), kBiased.at(2, 128)};
    TunePoint beaten = points[1];
    beaten.error *= 2.0;
    beaten.milliseconds *= 2.0;
    points.push_back(beaten);
    const std::vector<TunePoint> front = frontOf(points);
    ASSERT_EQ(front.size(), 3u);
    EXPECT_EQ(front[0].mixture, 2u);
    EXPECT_EQ(front[1].mixture, 1u);
    EXPECT_EQ(front[2].mixture, 0u);
}

}  // namespace
}  // namespace kaustik::experiment
