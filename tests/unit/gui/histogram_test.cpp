// SPDX-License-Identifier: MIT
#include "framework/gui/histogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "framework/gui/file_watch.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::gui::test {
namespace {

TEST(Histogram, CountsEveryFiniteValueOnce) {
    Image image(100, 1, 1);
    std::iota(image.values.begin(), image.values.end(), 0.0f);
    image.values[7] = std::numeric_limits<float>::quiet_NaN();
    image.values[8] = std::numeric_limits<float>::infinity();
    const Histogram histogram = histogramOf(image);
    EXPECT_EQ(histogram.low, 0.0f);
    EXPECT_EQ(histogram.high, 99.0f);
    EXPECT_NEAR(histogram.bright, 98.0f, 1.0f);
    EXPECT_EQ(std::accumulate(histogram.counts.begin(), histogram.counts.end(), 0u), 98u);
}

TEST(Histogram, OfColoursTogetherIsOfTheirLuminanceOrLength) {
    Image image(1, 2, 3);
    image.values = {3.0f, 0.0f, 4.0f, 1.0f, 1.0f, 1.0f};
    EXPECT_NEAR(histogramOf(image, Together::length).high, 5.0f, 1e-6f);
    EXPECT_NEAR(histogramOf(image, Together::length).low, std::sqrt(3.0f), 1e-6f);
    EXPECT_NEAR(histogramOf(image, Together::luminance).high, 1.0f, 1e-6f);
    EXPECT_NEAR(histogramOf(image, Together::luminance).low, 3 * 0.2126390f + 4 * 0.0721923f,
                1e-5f);
}

TEST(Histogram, LeavesOutAlphaAndAFewBrightPixels) {
    Image image(1000, 1, 4);
    for (int x = 0; x < 1000; ++x) {
        image.at(x, 0, 0) = image.at(x, 0, 1) = image.at(x, 0, 2) = 1.0f;
        image.at(x, 0, 3) = 1e9f;
    }
    image.at(0, 0, 0) = 1e6f;
    const Histogram histogram = histogramOf(image);
    EXPECT_EQ(histogram.high, 1e6f);
    EXPECT_EQ(histogram.bright, 1.0f);
    EXPECT_EQ(histogram.end, 2.0f);
    EXPECT_EQ(histogram.counts.back(), 1u);
}

TEST(Histogram, TakesImagesWithoutARange) {
    EXPECT_EQ(histogramOf(Image(3, 2, 3)).high, 0.0f);
    EXPECT_EQ(histogramOf(Image()).bright, 0.0f);
    Image negative(2, 1, 1);
    negative.values = {-3.0f, -2.0f};
    EXPECT_EQ(histogramOf(negative).low, -3.0f);
    EXPECT_EQ(histogramOf(negative).high, -2.0f);
}

TEST(FileWatch, SeesWhatIsWrittenAddedAndRemovedOnce) {
    const kaustik::test::TemporaryFolder folder;
    const auto write = [&](const char* name, const char* text) {
        std::ofstream(folder / name) << text;
    };
    write("a.glsl", "1");
    const kaustik::test::TemporaryFolder other;
    FileWatch watch({folder / ".", other / "."});
    EXPECT_FALSE(watch.hasChanged());
    static_cast<void>(other.file("c.glsl", "3"));
    EXPECT_TRUE(watch.hasChanged());
    write("b.glsl", "2");
    EXPECT_TRUE(watch.hasChanged());
    EXPECT_FALSE(watch.hasChanged());
    // Times of files may be coarse: another one than before is what counts.
    std::filesystem::last_write_time(
        folder / "a.glsl",
        std::filesystem::last_write_time(folder / "a.glsl") - std::chrono::seconds(5));
    EXPECT_TRUE(watch.hasChanged());
    std::filesystem::remove(folder / "b.glsl");
    EXPECT_TRUE(watch.hasChanged());
    std::filesystem::remove(folder / "a.glsl");
    EXPECT_TRUE(watch.hasChanged());
    EXPECT_FALSE(watch.hasChanged());
}

}  // namespace
}  // namespace kaustik::gui::test
