// SPDX-License-Identifier: MIT
#include "framework/judge/judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "framework/core/error.h"
#include "tests/unit/judge/drawn_scene.h"

namespace kaustik::judge {
namespace {

using namespace test;

Verdict judged(const Drawing& drawing, double exposure = 1.0) {
    return judge(drawnSubject(theirPicture(drawing, exposure)), {});
}

const Finding* find(const Verdict& verdict, const std::string& name) {
    for (const Finding& finding : verdict.findings) {
        if (finding.name == name) return &finding;
    }
    return nullptr;
}

std::string allOf(const Verdict& verdict) {
    return toText(verdict);
}

// Nothing else is said.
void expectOnly(const Verdict& verdict, const std::string& name) {
    EXPECT_NE(find(verdict, name), nullptr) << allOf(verdict);
    EXPECT_EQ(verdict.findings.size(), 1u) << allOf(verdict);
}

std::string refusal(Image theirs, const JudgeOptions& options = {}) {
    try {
        static_cast<void>(judge(drawnSubject(std::move(theirs)), options));
    } catch (const ConfigError& error) {
        return error.what();
    }
    return "";
}

TEST(Judge, FindsNoFaultInThePictureInAnyExposure) {
    for (const double exposure : {1e-3, 1.0, 370.0}) {
        const Verdict verdict = judged({}, exposure);
        EXPECT_TRUE(verdict.findings.empty()) << allOf(verdict);
        EXPECT_NEAR(verdict.exposure / exposure, 1.0, 0.005);
        EXPECT_TRUE(verdict.hasDirect);
        for (const ClassVerdict& of : verdict.classes)
            EXPECT_EQ(of.verdict, "there") << of.name;
        // The chance of a false alarm is 1 % for the whole picture; its seed is fixed.
        EXPECT_EQ(verdict.significantPixels, 0u) << allOf(verdict);
    }
}

TEST(Judge, ReportsEachMissingPathClass) {
    const auto expectMissing = [](const Drawing& drawing, const std::string& name,
                                  const std::string& words) {
        const Verdict verdict = judged(drawing, 2.5);
        expectOnly(verdict, "missing:" + name);
        const Finding* const finding = find(verdict, "missing:" + name);
        ASSERT_NE(finding, nullptr);
        EXPECT_NE(finding->sentence.find(words), std::string::npos) << finding->sentence;
        EXPECT_NEAR(finding->value, 0.0, 0.05);
    };
    Drawing drawing;
    drawing.ring = 0.0;
    expectMissing(drawing, "TT", "refracted twice (TT");
    drawing = {};
    drawing.spot = 0.0;
    expectMissing(drawing, "TRT", "reflected once inside (TRT");
    drawing = {};
    drawing.streak = 0.0;
    expectMissing(drawing, "R", "light that is reflected (R");
}

TEST(Judge, TellsAFactorOfOneOverTheSquareOfTheIndex) {
    Drawing drawing;
    drawing.ring = 1.0 / 2.25;
    const Verdict verdict = judged(drawing);
    expectOnly(verdict, "dark:TT");
    EXPECT_NE(allOf(verdict).find("1/n² of 'glass'"), std::string::npos) << allOf(verdict);
    // All classes alike are one mistake.
    drawing.ring = drawing.spot = drawing.streak = 1.0 / std::acos(-1.0);
    const Verdict all = judged(drawing);
    expectOnly(all, "dark:all");
    EXPECT_NE(allOf(all).find("1/π"), std::string::npos) << allOf(all);
}

TEST(Judge, NamesAnotherIndexAndFindsTheClassesAllTheSame) {
    for (const double error : {0.02, -0.02}) {
        Drawing drawing;
        drawing.index += error;
        const Verdict verdict = judged(drawing, 3.0);
        const Finding* const finding = find(verdict, "the index of refraction of 'glass'");
        ASSERT_NE(finding, nullptr) << allOf(verdict);
        // Between pictures of 0.01 and 0.03, which lie apart by most of the ring's width.
        EXPECT_NEAR(finding->value, error, 0.005) << allOf(verdict);
        EXPECT_EQ(find(verdict, "shift"), nullptr) << allOf(verdict);
        EXPECT_EQ(find(verdict, "missing:TT"), nullptr) << allOf(verdict);
    }
}

TEST(Judge, NamesAPictureThatIsMovedByHalfAPixel) {
    Drawing drawing;
    drawing.shift = {0.5, 0.5};
    const Verdict verdict = judged(drawing);
    const Finding* const finding = find(verdict, "shift");
    ASSERT_NE(finding, nullptr) << allOf(verdict);
    EXPECT_EQ(verdict.registration.shift, glm::dvec2(0.5, 0.5)) << allOf(verdict);
    EXPECT_NE(finding->sentence.find("half a pixel"), std::string::npos);
    EXPECT_EQ(find(verdict, "the index of refraction of 'glass'"), nullptr) << allOf(verdict);
    for (const ClassVerdict& of : verdict.classes)
        EXPECT_EQ(of.verdict, "there") << allOf(verdict);
}

TEST(Judge, FindsWhichWayUpThePictureIs) {
    Drawing drawing;
    drawing.isFlippedX = true;
    expectOnly(judged(drawing), "flipped-x");
    drawing.isFlippedY = true;
    expectOnly(judged(drawing), "turned");
    drawing.isFlippedX = false;
    expectOnly(judged(drawing), "flipped-y");
}

TEST(Judge, SaysHowWrongTheFieldOfViewIs) {
    Drawing drawing;
    drawing.zoom = 1.08;  // all looks larger: the angle is smaller
    const Verdict verdict = judged(drawing);
    const Finding* const finding = find(verdict, "field-of-view");
    ASSERT_NE(finding, nullptr) << allOf(verdict);
    const double degree = std::acos(-1.0) / 180.0;
    const double truth = 2.0 * std::atan(std::tan(20.0 * degree) / 1.08) / degree;
    EXPECT_NEAR(finding->value, truth, 0.15);
    for (const ClassVerdict& of : verdict.classes)
        EXPECT_EQ(of.verdict, "there") << allOf(verdict);
    // Horizontal for vertical: larger by the picture's sides.
    drawing.zoom = 4.0 / 3.0;
    EXPECT_NE(allOf(judged(drawing)).find("was taken for"), std::string::npos)
        << allOf(judged(drawing));
}

TEST(Judge, TakesACropAndAnotherSizeForWhatTheyAre) {
    Drawing crop;
    crop.width = 70;
    crop.height = 60;
    crop.corner = {14.0, 6.0};
    const Verdict cropped = judged(crop);
    expectOnly(cropped, "crop");
    EXPECT_NE(allOf(cropped).find("(14.0, 6.0)"), std::string::npos) << allOf(cropped);
    Drawing large;
    large.width = 192;
    large.height = 144;
    large.pixelsPerPixel = 0.5;
    expectOnly(judged(large), "size");
}

TEST(Judge, FindsHowValuesAreCoded) {
    const auto coded = [](double exponent) {
        Image image = theirPicture({}, 0.004);
        for (float& value : image.values) {
            const double linear = std::max(static_cast<double>(value), 0.0);
            value = static_cast<float>(exponent > 0.0 ? std::pow(linear, 1.0 / exponent)
                                       : linear <= 0.0031308
                                           ? 12.92 * linear
                                           : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
        }
        return image;
    };
    const Verdict srgb = judge(drawnSubject(coded(0.0)), {});
    EXPECT_EQ(srgb.encoding, Encoding::srgb) << allOf(srgb);
    expectOnly(srgb, "encoding");
    const Verdict power = judge(drawnSubject(coded(2.2)), {});
    EXPECT_EQ(power.encoding, Encoding::gamma22) << allOf(power);
    expectOnly(power, "encoding");
}

TEST(Judge, NamesAWholeMistakeAndNotTheClassesThatItChanges) {
    Subject subject = drawnSubject(Image());
    Cause flipped;
    flipped.kind = CauseKind::whole;
    flipped.name = "normals of 'ball'";
    flipped.sentence = "the normals of 'ball' are flipped";
    // With them the ring is elsewhere altogether.
    Drawing other;
    other.index = 1.42;
    const Image usualRing = theirPicture({.direct = 0, .spot = 0, .streak = 0}, 1.0, 0.0);
    other.direct = other.spot = other.streak = 0.0;
    flipped.radiance = theirPicture(other, 1.0, 0.0, 8);
    for (std::size_t i = 0; i < usualRing.values.size(); ++i)
        flipped.radiance.values[i] -= usualRing.values[i];
    subject.causes.push_back(flipped);
    Drawing theirs;
    theirs.index = 1.42;
    subject.theirs = theirPicture(theirs, 2.0);
    const Verdict verdict = judge(subject, {});
    const Finding* const finding = find(verdict, "normals of 'ball'");
    ASSERT_NE(finding, nullptr) << allOf(verdict);
    EXPECT_NEAR(finding->value, 1.0, 0.05);
    expectOnly(verdict, "normals of 'ball'");
}

TEST(Judge, SaysBothOfTwoCausesThatLookTheSame) {
    Drawing drawing;
    drawing.index += 0.015;
    Subject subject = drawnSubject(theirPicture(drawing, 1.0));
    for (std::size_t i = 0, count = subject.causes.size(); i < count; ++i) {
        Cause light = subject.causes[i];
        light.name = "the place of light 'lamp'";
        light.unit = "m";
        light.least = 0.001;
        light.amount *= 3.0;
        subject.causes.push_back(light);
    }
    const Verdict verdict = judge(subject, {});
    std::size_t named = 0;
    for (const Finding& finding : verdict.findings) {
        if (finding.also.empty()) continue;
        const std::string both = finding.sentence + finding.also.front();
        named +=
            both.find("'lamp'") != std::string::npos && both.find("'glass'") != std::string::npos
                ? 1u
                : 0u;
    }
    EXPECT_EQ(named, 1u) << allOf(verdict);
}

TEST(Judge, ReportsAmbientLightMissingFromTheScene) {
    Drawing drawing;
    drawing.fill = 12.0;
    const Verdict verdict = judged(drawing);
    expectOnly(verdict, "fill");
    EXPECT_NEAR(find(verdict, "fill")->value, 12.0, 0.5);
}

TEST(Judge, NamesChannelsOfOtherExposures) {
    Image theirs = theirPicture({}, 2.0);
    for (std::size_t i = 2; i < theirs.values.size(); i += 3)
        theirs.values[i] *= 0.9f;
    const Verdict verdict = judge(drawnSubject(theirs), {});
    expectOnly(verdict, "channels");
    EXPECT_NEAR(find(verdict, "channels")->value, 0.1, 0.02) << allOf(verdict);
}

TEST(Judge, TakesCausticsAloneForWhatTheyAre) {
    Drawing drawing;
    drawing.direct = 0.0;
    const Verdict verdict = judged(drawing, 5.0);
    EXPECT_FALSE(verdict.hasDirect);
    EXPECT_EQ(verdict.exposureBy, "TT");
    EXPECT_NEAR(verdict.exposure, 5.0, 0.05);
    EXPECT_TRUE(verdict.findings.empty()) << allOf(verdict);
    drawing.spot = 0.0;
    expectOnly(judged(drawing), "missing:TRT");
}

TEST(Judge, GivesIntervalsThatHoldTheTruthAsOftenAsTheyShould) {
    int held = 0;
    int all = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        Drawing drawing;
        drawing.spot = 0.8;
        const Verdict verdict = judge(drawnSubject(theirPicture(drawing, 1.0, 0.03, seed)), {});
        for (const ClassVerdict& of : verdict.classes) {
            const double truth = of.name == "TRT" ? 0.8 : 1.0;
            held += std::abs(of.coefficient - truth) <= 2.0 * of.error ? 1 : 0;
            ++all;
        }
    }
    // 95 % in the mean of 18; fewer than 12 would be by chance once in 10^4.
    EXPECT_GE(held, 12) << held << " of " << all;
}

TEST(Judge, RefusesWhatCannotBeJudgedInOneSentence) {
    Image holes = theirPicture({}, 1.0);
    holes.at(3, 3, 0) = NAN;
    EXPECT_NE(refusal(holes).find("no numbers"), std::string::npos);

    Image display = theirPicture({}, 0.05);
    for (float& value : display.values)
        value = std::min(value, 1.0f);
    EXPECT_NE(refusal(display).find("cut off at 1"), std::string::npos) << refusal(display);

    for (const bool isCurved : {false, true}) {
        Image levels = theirPicture({}, 0.004);
        for (float& value : levels.values) {
            const double level =
                std::round(255.0 * std::clamp(static_cast<double>(value), 0.0, 1.0));
            const double stored = level / 255.0;
            value =
                static_cast<float>(!isCurved           ? stored
                                   : stored <= 0.04045 ? stored / 12.92
                                                       : std::pow((stored + 0.055) / 1.055, 2.4));
        }
        EXPECT_NE(refusal(levels).find("256 levels"), std::string::npos) << refusal(levels);
    }

    Image other(96, 72, 3);
    for (int y = 0; y < 72; ++y) {
        for (int x = 0; x < 96; ++x) {
            for (int c = 0; c < 3; ++c)
                other.at(x, y, c) = static_cast<float>(1.0 + std::sin(0.5 * x) * std::cos(0.7 * y));
        }
    }
    EXPECT_NE(refusal(other).find("does not show drawn"), std::string::npos) << refusal(other);

    EXPECT_NE(refusal(Image(96, 72, 3)).find("black"), std::string::npos);

    Subject dark = drawnSubject(theirPicture({}, 1.0));
    for (Light& light : dark.classes)
        std::fill(light.radiance.values.begin(), light.radiance.values.end(), 0.0f);
    EXPECT_THROW(static_cast<void>(judge(dark, {})), ConfigError);
}

TEST(Judge, RefusesThePictureOfAnotherCamera) {
    // Near ones are found, far ones explain too little.
    Drawing drawing;
    for (const double degrees : {2.0, -6.0, 25.0}) {
        drawing.roll = degrees;
        const std::string said = refusal(theirPicture(drawing, 2.0));
        EXPECT_NE(said.find("does not show drawn by its camera"), std::string::npos)
            << degrees << ": " << said;
        if (std::abs(degrees) > 10.0) continue;
        EXPECT_NE(said.find("about the line of sight"), std::string::npos) << said;
        char words[40];
        std::snprintf(words, sizeof words, "about %.1f degrees", std::abs(degrees));
        EXPECT_NE(said.find(words), std::string::npos) << said;
    }
    drawing.roll = 0.0;
    for (const glm::dvec2& keystone : {glm::dvec2(0.06, 0.0), {0.0, -0.08}, {0.3, 0.3}}) {
        drawing.keystone = keystone;
        EXPECT_NE(refusal(theirPicture(drawing, 2.0)).find("does not show drawn by its camera"),
                  std::string::npos)
            << keystone.x << " " << keystone.y;
    }
}

TEST(Judge, TakesNoMistakeInTheLightForAnotherCamera) {
    Drawing drawing;
    drawing.index += 0.025;
    drawing.spot = 0.0;
    drawing.fill = 5.0;
    drawing.shift = {3.0, -2.0};
    const Verdict verdict = judged(drawing);
    ASSERT_TRUE(verdict.explainedShare);
    EXPECT_GT(*verdict.explainedShare, 0.97) << allOf(verdict);
    EXPECT_NE(find(verdict, "missing:TRT"), nullptr) << allOf(verdict);
}

// A mistake that is little but another strength of a class: the class alone could make up for it.
TEST(Judge, NamesAWholeMistakeThatClassesCouldMakeUpFor) {
    Subject subject = drawnSubject(Image());
    const auto lossless = [](const DrawnLight& light) {
        return light.ring * (0.15 + 0.002 * light.albedo * light.ring);
    };
    Cause fresnel;
    fresnel.kind = CauseKind::whole;
    fresnel.name = "fresnel:lossless";
    fresnel.sentence = "refracted light has not Fresnel's factor";
    const double pi = std::acos(-1.0);
    fresnel.radiance =
        drawn({}, [&](const DrawnLight& light) { return light.albedo / pi * lossless(light); });
    Image change = fresnel.radiance;
    subject.causes.push_back(std::move(fresnel));
    subject.theirs = theirPicture({}, 1.0);
    for (std::size_t i = 0; i < change.values.size(); ++i)
        subject.theirs.values[i] += change.values[i];
    const Verdict verdict = judge(subject, {});
    ASSERT_NE(find(verdict, "fresnel:lossless"), nullptr) << allOf(verdict);
    for (const ClassVerdict& of : verdict.classes)
        EXPECT_EQ(of.verdict, "there") << allOf(verdict);
}

TEST(Judge, TellsPathsInWords) {
    EXPECT_EQ(titleOf("TT"), "light that is refracted twice");
    EXPECT_EQ(titleOf("TRT"), "light that is reflected once inside");
    EXPECT_EQ(titleOf("TRRT"), "light that is reflected twice inside");
    EXPECT_EQ(titleOf("R"), "light that is reflected");
    EXPECT_EQ(titleOf("TT@ball"), "light that is refracted twice, first at ball");
    EXPECT_EQ(titleOf("other"), "all other light");
    EXPECT_EQ(titleOf("RTT"), "light by the path RTT");
}

}  // namespace
}  // namespace kaustik::judge
