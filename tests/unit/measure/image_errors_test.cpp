// SPDX-License-Identifier: MIT
#include "framework/measure/image_errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "framework/measure/heat_map.h"
#include "framework/measure/ssim.h"
#include "tests/unit/measure/test_images.h"

namespace kaustik::measure::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr const char* kKeys[] = {"rmse",     "rel_mse",      "smape",
                                 "mae",      "ssim",         "flip_ldr",
                                 "flip_hdr", "energy_ratio", "encircled_energy_radius_ratio"};

TEST(ImageErrors, InJsonAreAllMeasuresEachWithItsFormula) {
    const Image image = randomImage(24, 20, 1, 0.0f, 5.0f);
    const Image reference = randomImage(24, 20, 2, 0.0f, 5.0f);
    const ImagePair pair = pairOf(image, reference);
    const json errors = toJson(measureErrors(pair));
    for (const char* key : kKeys) {
        EXPECT_TRUE(errors.at(key).is_number()) << key;
        EXPECT_TRUE(errors.at("formulas").at(key).at("text").is_string()) << key;
    }
    EXPECT_FALSE(errors.contains("reasons"));
    EXPECT_FALSE(errors.contains("truth_noise"));
    EXPECT_EQ(errors.at("counted_pixels"), 480);
    EXPECT_EQ(errors.at("rmse"), rootMeanSquareError(pair));

    const ReferenceScale scale = referenceScale(pair);
    const json& formulas = errors.at("formulas");
    EXPECT_EQ(formulas.at("rel_mse").at("epsilon"), 0.01 * scale.typical * scale.typical);
    EXPECT_EQ(formulas.at("smape").at("lit_pixels"), 480);
    EXPECT_EQ(errors.at("smape"), symmetricRelativeError(pair, litPixels(pair)));
    EXPECT_EQ(formulas.at("ssim").at("white"), scale.white);
    EXPECT_EQ(formulas.at("flip_ldr").at("pixels_per_degree"), 67.0);
    EXPECT_EQ(formulas.at("flip_hdr").at("exposures").at("count"), defaultExposures(scale).count);
    EXPECT_EQ(errors.at("ssim"), ssim(pair, scale.white).value());
}

TEST(ImageErrors, OfEqualImagesAreNone) {
    const Image image = randomImage(24, 20, 1, 0.0f, 5.0f);
    const json errors = toJson(measureErrors(pairOf(image, image)));
    for (const char* key : {"rmse", "rel_mse", "smape", "mae", "flip_ldr", "flip_hdr"})
        EXPECT_EQ(errors.at(key), 0.0) << key;
    for (const char* key : {"energy_ratio", "encircled_energy_radius_ratio"})
        EXPECT_EQ(errors.at(key), 1.0) << key;
    EXPECT_DOUBLE_EQ(errors.at("ssim"), 1.0);
}

TEST(ImageErrors, AgainstABlackReferenceAreNullWithAReasonWhereTheyHaveNoMeaning) {
    const json errors =
        toJson(measureErrors(pairOf(greyImage(16, 16, 2.0f), greyImage(16, 16, 0.0f))));
    EXPECT_EQ(errors.at("rmse"), 2.0);
    EXPECT_EQ(errors.at("mae"), 2.0);
    for (const char* key : {"rel_mse", "smape", "ssim", "flip_ldr", "flip_hdr", "energy_ratio",
                            "encircled_energy_radius_ratio"}) {
        EXPECT_TRUE(errors.at(key).is_null()) << key;
        EXPECT_NE(errors.at("reasons").at(key), "") << key;
    }
    EXPECT_THAT(errors.at("reasons").at("flip_hdr").get<std::string>(), HasSubstr("black"));
    // Nothing that is not a number has become null on the way out without a reason.
    EXPECT_EQ(errors.at("reasons").size(), 7u);
}

TEST(ImageErrors, OfAnImageTooSmallForSsimSayWhy) {
    const Image image = randomImage(10, 10, 1);
    const json errors = toJson(measureErrors(pairOf(image, image)));
    EXPECT_TRUE(errors.at("ssim").is_null());
    EXPECT_THAT(errors.at("reasons").at("ssim").get<std::string>(), HasSubstr("window"));
    EXPECT_EQ(errors.at("reasons").size(), 1u);
}

TEST(ImageErrors, AreMeasuredWithWhatIsGivenAndSaySo) {
    const Image image = randomImage(24, 20, 1);
    const Image reference = randomImage(24, 20, 2);
    const ImagePair pair = pairOf(image, reference);
    MeasureParams params;
    params.displayWhite = 0.5;
    params.exposures = ExposureRange{-2.0, 1.0, 3};
    params.pixelsPerDegree = 30.0;
    const json errors = toJson(measureErrors(pair, params));
    EXPECT_EQ(errors.at("flip_ldr"), pooledMean(pair, ldrFlipMap(pair, 0.5, 30.0)));
    EXPECT_EQ(errors.at("flip_hdr"), pooledMean(pair, hdrFlipMap(pair, {-2.0, 1.0, 3}, 30.0)));
    const json& formulas = errors.at("formulas");
    EXPECT_EQ(formulas.at("flip_ldr").at("white_rule"), "given");
    EXPECT_EQ(formulas.at("flip_hdr").at("exposures").at("start_stops"), -2.0);
    EXPECT_EQ(formulas.at("flip_hdr").at("exposures").at("rule"), "given");
}

TEST(ImageErrors, HaveTheReferencesNoiseBesideThem) {
    const Image image = greyImage(16, 16, 1.0f);
    const Image sigma = greyImage(16, 16, 0.25f);
    const ImagePair pair({.image = image, .reference = image, .standardError = &sigma});
    const json noise = toJson(measureErrors(pair)).at("truth_noise");
    EXPECT_DOUBLE_EQ(noise.at("rmse"), 0.25);
    EXPECT_DOUBLE_EQ(noise.at("energy_ratio"), 0.25 / 16.0);
    EXPECT_NEAR(noise.at("mae"), 0.25 * 0.7978845608, 1e-9);
    EXPECT_NEAR(noise.at("rel_mse"), 0.0625 / 1.01, 1e-9);
    EXPECT_NEAR(noise.at("smape"), 0.125 * 0.7978845608, 1e-9);
}

TEST(ImageErrors, NoiseAloneLightsNoPixel) {
    const Image image = greyImage(16, 16, 1.0f);
    const Image sigma = greyImage(16, 16, 0.5f);
    const ImagePair pair({.image = image, .reference = image, .standardError = &sigma});
    const json errors = toJson(measureErrors(pair));
    EXPECT_TRUE(errors.at("smape").is_null());
    EXPECT_THAT(errors.at("reasons").at("smape").get<std::string>(), HasSubstr("noise"));
    EXPECT_TRUE(errors.at("truth_noise").at("smape").is_null());
}

TEST(HeatMapScale, DependsOnTheReferenceAloneUnlessThatIsBlack) {
    const Image reference = randomImage(16, 16, 1);
    const auto scaleFor = [&](const Image& image, const Image& groundTruth) {
        const ImagePair pair = pairOf(image, groundTruth);
        return heatMapScale(measureErrors(pair), absoluteErrorPlane(pair));
    };
    EXPECT_EQ(scaleFor(randomImage(16, 16, 2), reference),
              scaleFor(greyImage(16, 16, 90.0f), reference));
    EXPECT_EQ(scaleFor(greyImage(16, 16, 3.0f), greyImage(16, 16, 0.0f)), 3.0);
    EXPECT_EQ(scaleFor(greyImage(16, 16, 0.0f), greyImage(16, 16, 0.0f)), 1.0);
}

}  // namespace
}  // namespace kaustik::measure::test
