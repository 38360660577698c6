// SPDX-License-Identifier: MIT
#include "framework/certify/verdict.h"

#include <gtest/gtest.h>

#include <limits>

#include "framework/core/error.h"

namespace kaustik::certify {
namespace {

Certificate certificateOf(float low, float high) {
    Certificate certificate;
    certificate.lower = certificate.upper = certificate.undecided = Image(2, 2, 3);
    for (float& value : certificate.lower.values)
        value = low;
    for (float& value : certificate.upper.values)
        value = high;
    return certificate;
}

TEST(Verdict, ProvesOnlyWhatIsOutside) {
    const Certificate certificate = certificateOf(99.0f, 101.0f);
    Image picture(2, 2, 3);
    for (float& value : picture.values)
        value = 100.0f;
    EXPECT_EQ(judge(picture, certificate).below + judge(picture, certificate).above, 0u);
    picture.at(0, 0, 1) = 98.9f;
    picture.at(1, 0, 2) = 101.1f;
    picture.at(1, 1, 0) = std::numeric_limits<float>::quiet_NaN();
    const Verdict verdict = judge(picture, certificate);
    EXPECT_EQ(verdict.below, 1u);
    EXPECT_EQ(verdict.above, 2u);
    EXPECT_EQ(verdict.undecided, 0u);
    EXPECT_THROW((void)judge(Image(3, 2, 3), certificate), ConfigError);
}

// Longer paths only bring more: they excuse what is too bright and never what is too dark.
TEST(Verdict, LeavesRoomForPathsThatAreNotCertified) {
    Certificate certificate = certificateOf(99.0f, 101.0f);
    certificate.totals.limited = Interval(0.0, 1.0);
    Image picture(2, 2, 3);
    for (float& value : picture.values)
        value = 120.0f;
    picture.at(0, 0, 0) = 1.0f;
    const Verdict verdict = judge(picture, certificate);
    EXPECT_EQ(verdict.below, 1u);
    EXPECT_EQ(verdict.above, 0u);
    EXPECT_EQ(verdict.aboveCertifiedPaths, 3u);
}

}  // namespace
}  // namespace kaustik::certify
