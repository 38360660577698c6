// SPDX-License-Identifier: MIT
// temporal.reproject: a camera that moves takes the mean along without carrying it over outlines.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "framework/scene/files/scene_file.h"
#include "tests/gpu/techniques/temporal/film.h"

namespace kaustik::test {
namespace {

// What frames come to without looking anything up: what the tests below must be able to find.
void addGhosts(std::vector<float>& ghosts, const std::vector<float>& now) {
    if (ghosts.empty()) ghosts = now;
    for (std::size_t i = 0; i < now.size(); ++i)
        ghosts[i] += 0.2f * (now[i] - ghosts[i]);
}

// Calls visit(index, neighbour's index) for all pixels so near as `reach`, itself among them; the
// screen's border leaves none out.
template <class Visit>
void forNeighbours(int width, int height, int reach, const Visit& visit) {
    const auto index = [&](int x, int y) { return static_cast<std::size_t>(y * width + x); };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int v = std::max(y - reach, 0); v <= std::min(y + reach, height - 1); ++v) {
                for (int u = std::max(x - reach, 0); u <= std::min(x + reach, width - 1); ++u)
                    visit(index(x, y), index(u, v));
            }
        }
    }
}

// A moving camera takes the mean along. Each material's irradiance is its own number, which a mean
// over the same surface keeps and one over two surfaces does not: at outlines, at edges and where
// something comes out from behind something else.
void expectNoGhosts(const glm::dvec3& offset) {
    constexpr int kWidth = 320;
    constexpr int kHeight = 240;
    Film film(movedBy(offset), kWidth, kHeight, pattern("0.2"), offset);
    std::vector<float> ghosts;
    for (int frame = 0; frame < 12; ++frame) {
        moveCamera(film.scene(), frame);
        film.nextOfSeed(static_cast<std::uint64_t>(300 + frame),
                        {kUnfiltered, "eye.receiver_surface"});
        addGhosts(ghosts, film.saved(kUnfiltered));
    }
    const std::vector<float> now = film.saved(kUnfiltered);
    const std::vector<float> found = film.irradiance();
    EXPECT_EQ(countNotFinite(found), 0u);

    // Pixels that see one face of one thing as far as its history may come from, and the rest.
    const std::vector<float> surface = film.saved("eye.receiver_surface");
    std::vector<int> alike(now.size() / 4, 0);
    constexpr int kReach = 4;
    forNeighbours(kWidth, kHeight, kReach, [&](std::size_t pixel, std::size_t other) {
        const float* one = surface.data() + 4 * pixel;
        const float* two = surface.data() + 4 * other;
        const float cosine = one[0] * two[0] + one[1] * two[1] + one[2] * two[2];
        if (one[3] > 0.0f && one[3] == two[3] && cosine > 0.99f) ++alike[pixel];
    });
    const int all = (2 * kReach + 1) * (2 * kReach + 1);
    EXPECT_GT(std::count(alike.begin(), alike.end(), all), kWidth * kHeight / 4);
    const auto largestOf = [&](const std::vector<float>& image, std::size_t channel,
                               bool isInside) {
        double largest = 0.0;
        for (std::size_t pixel = 0; pixel < alike.size(); ++pixel) {
            if ((alike[pixel] == all) != isInside) continue;
            const std::size_t i = 4 * pixel + channel;
            largest = std::max(
                largest, std::abs(static_cast<double>(image[i]) - static_cast<double>(now[i])));
        }
        return largest;
    };
    for (const bool isInside : {true, false})
        EXPECT_LT(largestOf(found, 0, isInside), 1e-3) << isInside;
    EXPECT_GT(largestOf(ghosts, 0, false), 50.0);
    // A pixel sees up to 3 cm of the floor, where linear interpolation errs by (3/m 0.03 m)²/8 of
    // 1000 W/m² along either axis at most, 2 W/m²; four times that is left of all frames before,
    // (1 - w)/w of what each adds.
    EXPECT_LT(largestOf(found, 1, true), 8.0);
    EXPECT_GT(largestOf(ghosts, 1, true), 80.0);
    // At outlines the texels that are left lie next to the place: by less than a pixel, over which
    // the waves rise by 3/m 0.03 m of 1000 W/m².
    EXPECT_LT(largestOf(found, 1, false), 90.0);
    // And it is a mean: variance falls as if the camera stood, and more where texels are mixed. A
    // part of the pixels is new.
    EXPECT_LT(deviation(found, 2, 500.0), 0.4 * deviation(now, 2, 500.0));
    EXPECT_GT(deviation(found, 2, 500.0), 0.0);
}

TEST(Temporal, OfAMovingCameraCarriesNothingOverOutlines) {
    expectNoGhosts(glm::dvec3(0.0));
}

TEST(Temporal, OfAMovingCameraIsTheSameFarFromTheOrigin) {
    expectNoGhosts(glm::dvec3(1e5, 0.0, -3e4));
}

// Real light with a real silhouette: a rod in the light that a ball has focused, and the camera
// going round. The caustic stands still, so that all that the filter may add is blur: nothing is
// brighter or darker than what each frame has two pixels around.
TEST(Temporal, OfAMovingCameraOverACausticStaysNearEachFrame) {
    constexpr int kWidth = 320;
    constexpr int kHeight = 240;
    Film film(scene::loadScene("blocker"), kWidth, kHeight,
              reprojected({{"emit.photons", "192x192"}}));
    std::vector<float> ghosts;
    for (int frame = 0; frame < 6; ++frame) {
        moveCamera(film.scene(), frame);
        film.next({kUnfiltered});
        addGhosts(ghosts, film.saved(kUnfiltered));
    }
    const std::vector<float> now = film.saved(kUnfiltered);
    const std::vector<float> found = film.irradiance();
    EXPECT_EQ(countNotFinite(found), 0u);
    EXPECT_GT(*std::max_element(now.begin(), now.end()), 2000.0f);
    std::vector<float> lowest(now.size() / 4, std::numeric_limits<float>::max());
    std::vector<float> highest(now.size() / 4, 0.0f);
    forNeighbours(kWidth, kHeight, 2, [&](std::size_t pixel, std::size_t other) {
        lowest[pixel] = std::min(lowest[pixel], now[4 * other]);
        highest[pixel] = std::max(highest[pixel], now[4 * other]);
    });
    const auto farthestOutside = [&](const std::vector<float>& image) {
        float farthest = 0.0f;
        for (std::size_t pixel = 0; pixel < lowest.size(); ++pixel) {
            farthest = std::max(
                {farthest, lowest[pixel] - image[4 * pixel], image[4 * pixel] - highest[pixel]});
        }
        return farthest;
    };
    // W/m²: frames differ a little by where their pixels lie.
    EXPECT_LT(farthestOutside(found), 20.0f);
    EXPECT_GT(farthestOutside(ghosts), 500.0f);
    EXPECT_LT(rootMeanSquareDifference(found, now), 0.5 * rootMeanSquareDifference(ghosts, now));
}

}  // namespace
}  // namespace kaustik::test
