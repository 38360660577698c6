// SPDX-License-Identifier: MIT
// Fates of photons, judged by hand: an eye of 90 degrees and 100x100 pixels, so that a pixel at a
// depth of 10 m covers 0.2 m.
#include "framework/audit/photon_fate.h"

#include <gtest/gtest.h>

#include "framework/audit/hit_audit.h"

namespace kaustik::audit {
namespace {

constexpr int kSide = 100;
constexpr double kFootprint = 0.2;

render::RasterView squareEye() {
    render::RasterView view;
    view.halfExtent = {1.0, 1.0};
    view.nearMeters = 0.5;
    view.width = kSide;
    view.height = kSide;
    return view;
}

// Two layers everywhere: at 10 m, and at `second` unless that is 0.
Layers layersAt(double second) {
    std::vector<float> texels;
    for (const double depth : {10.0, second}) {
        for (int i = 0; i < kSide * kSide; ++i) {
            texels.push_back(static_cast<float>(depth));
            texels.push_back(0.05f);
        }
    }
    return {kSide, kSide, 2, texels};
}

reference::FirstHit hitAt(const glm::dvec3& position, const glm::dvec3& origin) {
    reference::FirstHit hit;
    hit.position = position;
    hit.distanceMeters = glm::distance(position, origin);
    hit.geometricNormal = {0.0, 0.0, 1.0};
    hit.material = 1;
    return hit;
}

const glm::dvec3 kOrigin{0.0, 0.0, -2.0};

PhotonFate judge(const std::optional<glm::dvec3>& found, const glm::dvec3& exact,
                 double secondLayer = 0.0) {
    return judgeFate(squareEye(), layersAt(secondLayer), kOrigin, found, hitAt(exact, kOrigin));
}

TEST(PhotonFate, IsRightWithinAPixelAndAFootprint) {
    const glm::dvec3 exact{0.0, 0.0, -10.0};
    EXPECT_EQ(judge(glm::dvec3{0.9 * kFootprint, 0.0, -10.0}, exact).verdict, Verdict::right);
    EXPECT_EQ(judge(glm::dvec3{1.1 * kFootprint, 0.0, -10.0}, exact).verdict, Verdict::displaced);
    // On the same pixel, but further away than a footprint.
    EXPECT_EQ(judge(glm::dvec3{0.0, 0.0, -10.0 - 1.1 * kFootprint}, exact).verdict,
              Verdict::displaced);
    EXPECT_EQ(judge(glm::dvec3{0.0, 0.0, -12.0}, exact).verdict, Verdict::tooFar);
    EXPECT_EQ(judge(glm::dvec3{0.0, 0.0, -6.0}, exact).verdict, Verdict::tooNear);
    EXPECT_EQ(judge(std::nullopt, exact).verdict, Verdict::missed);
}

TEST(PhotonFate, AllowsMoreMetersOnASurfaceThatIsSeenAtASlant) {
    reference::FirstHit exact = hitAt({0.0, 0.0, -10.0}, kOrigin);
    const glm::dvec3 found{0.0, 0.0, -10.0 - 1.5 * kFootprint};
    const auto verdict = [&] {
        return judgeFate(squareEye(), layersAt(0.0), kOrigin, found, exact).verdict;
    };
    EXPECT_EQ(verdict(), Verdict::displaced);
    exact.geometricNormal = glm::normalize(glm::dvec3(0.0, std::sqrt(3.0), 1.0));  // cos = 1/2
    EXPECT_EQ(verdict(), Verdict::right);
}

TEST(PhotonFate, WithoutAnySurfaceIsRightOnlyWithoutAHit) {
    const reference::FirstHit none;
    const PhotonFate missed = judgeFate(squareEye(), layersAt(0.0), kOrigin, std::nullopt, none);
    EXPECT_EQ(missed.verdict, Verdict::right);
    EXPECT_EQ(missed.sight, Sight::none);
    EXPECT_FALSE(missed.isVisible());
    EXPECT_EQ(judgeFate(squareEye(), layersAt(0.0), kOrigin, glm::dvec3(0, 0, -10), none).verdict,
              Verdict::noSurface);
}

TEST(PhotonFate, KnowsWhatTheScreenCannotShow) {
    EXPECT_EQ(judge(std::nullopt, {0.0, 0.0, -10.0}).sight, Sight::shown);
    EXPECT_EQ(judge(std::nullopt, {11.0, 0.0, -10.0}).sight, Sight::offScreen);
    EXPECT_EQ(judge(std::nullopt, {0.0, 0.0, 3.0}).sight, Sight::behindEye);
    EXPECT_EQ(judge(std::nullopt, {0.0, 0.0, -0.4}).sight, Sight::behindEye);  // nearer than near
    // A free layer, but no fragment at that depth.
    EXPECT_EQ(judge(std::nullopt, {0.0, 0.0, -14.0}).sight, Sight::edgeOn);
    // Both layers are full before it; between them one would still have been kept.
    EXPECT_EQ(judge(std::nullopt, {0.0, 0.0, -14.0}, 12.0).sight, Sight::beyondLayers);
    EXPECT_EQ(judge(std::nullopt, {0.0, 0.0, -11.2}, 12.0).sight, Sight::edgeOn);
    EXPECT_TRUE(judge(std::nullopt, {0.0, 0.0, -14.0}).isVisible());
    EXPECT_FALSE(judge(std::nullopt, {0.0, 0.0, -14.0}, 12.0).isVisible());
}

TEST(PhotonFate, BehindTheEyeHasMetersButNoPixels) {
    const PhotonFate fate = judge(glm::dvec3{0.0, 0.0, -10.0}, {0.0, 0.0, 3.0});
    ASSERT_TRUE(fate.distanceMeters);
    EXPECT_NEAR(*fate.distanceMeters, 13.0, 1e-12);
    EXPECT_FALSE(fate.distancePixels);
    EXPECT_NE(fate.verdict, Verdict::right);
}

TEST(Quantiles, AreNearestRanks) {
    std::vector<double> samples;
    for (int i = 100; i >= 1; --i)
        samples.push_back(i);
    const Quantiles quantiles = quantilesOf(samples).value();
    EXPECT_EQ(quantiles.median, 50.0);
    EXPECT_EQ(quantiles.percentile95, 95.0);
    EXPECT_EQ(quantiles.percentile99, 99.0);
    EXPECT_EQ(quantiles.maximum, 100.0);
    EXPECT_EQ(quantilesOf({3.0}).value().median, 3.0);
    EXPECT_FALSE(quantilesOf({}));
}

}  // namespace
}  // namespace kaustik::audit
