// SPDX-License-Identifier: MIT
// The primaries of their pictures: found where colours tell them, else said that they do not, and
// taken as they are asked for.
#include "framework/judge/primaries.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "framework/core/error.h"
#include "framework/judge/judge.h"
#include "tests/unit/judge/drawn_scene.h"

namespace kaustik::judge {
namespace {

using namespace test;

struct Published {
    Primaries primaries;
    glm::dmat3 toRec709;
    const char* title;
};

glm::dmat3 byRows(const std::array<double, 9>& a) {
    return {{a[0], a[3], a[6]}, {a[1], a[4], a[7]}, {a[2], a[5], a[8]}};
}

// To the digits that they are published with: BT.2020's in Rec. ITU-R BT.2407-0; the others are
// those that programs of the field use, with Bradford's adaptation for the white of ACES.
std::array<Published, 4> published() {
    return {
        {{Primaries::rec2020,
          byRows({1.6605, -0.5876, -0.0728, -0.1246, 1.1329, -0.0083, -0.0182, -0.1006, 1.1187}),
          "Rec. 2020"},
         {Primaries::p3,
          byRows({1.2249, -0.2249, 0.0, -0.0421, 1.0421, 0.0, -0.0196, -0.0786, 1.0983}),
          "P3 (D65)"},
         {Primaries::acescg,
          byRows({1.7051, -0.6218, -0.0833, -0.1303, 1.1408, -0.0105, -0.0240, -0.1290, 1.1530}),
          "ACEScg (AP1)"},
         {Primaries::aces2065,
          byRows({2.5217, -1.1341, -0.3876, -0.2765, 1.3727, -0.0962, -0.0154, -0.1530, 1.1684}),
          "ACES 2065-1 (AP0)"}}};
}

using Palette = std::array<glm::dvec3, 4>;
constexpr Palette kColours = {glm::dvec3(0.9, 0.35, 0.25), glm::dvec3(0.35, 0.8, 0.3),
                              glm::dvec3(0.3, 0.45, 0.9), glm::dvec3(0.85, 0.85, 0.8)};
constexpr Palette kOneColour = {glm::dvec3(0.9, 0.75, 0.65), glm::dvec3(0.9, 0.75, 0.65),
                                glm::dvec3(0.9, 0.75, 0.65), glm::dvec3(0.9, 0.75, 0.65)};

// On receivers with stripes of such colours, nine pixels wide.
void paint(Image& image, const Palette& palette) {
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        const std::size_t column = i / 3 % static_cast<std::size_t>(image.width);
        image.values[i] *= static_cast<float>(
            palette[column / 9 % palette.size()][static_cast<glm::length_t>(i % 3)]);
    }
}

Subject paintedSubject(const Palette& palette, Image theirs) {
    Subject subject = drawnSubject(std::move(theirs));
    paint(subject.direct, palette);
    paint(subject.fill, palette);
    for (Light& light : subject.classes) {
        paint(light.radiance, palette);
        paint(light.error, palette);
    }
    for (Cause& cause : subject.causes)
        paint(cause.radiance, palette);
    return subject;
}

Image painted(const Palette& palette, double exposure = 2.0) {
    Image image = theirPicture({}, exposure);
    paint(image, palette);
    return image;
}

const Finding* find(const Verdict& verdict, const std::string& name) {
    const auto found = std::find_if(verdict.findings.begin(), verdict.findings.end(),
                                    [&](const Finding& finding) { return finding.name == name; });
    return found == verdict.findings.end() ? nullptr : &*found;
}

TEST(Primaries, MakeThePublishedMatrices) {
    for (const Published& of : published()) {
        const glm::dmat3 matrix = toRec709(of.primaries);
        for (glm::length_t column = 0; column < 3; ++column) {
            // Their last digit.
            for (glm::length_t row = 0; row < 3; ++row)
                EXPECT_NEAR(matrix[column][row], of.toRec709[column][row], 1e-4) << of.title;
        }
        const glm::dvec3 white = matrix * glm::dvec3(1.0);
        EXPECT_NEAR(glm::length(white - glm::dvec3(1.0)), 0.0, 1e-9) << of.title;
    }
    EXPECT_EQ(toRec709(Primaries::rec709), glm::dmat3(1.0));
}

TEST(Primaries, OfAColouredPictureAreNamed) {
    for (const Published& of : published()) {
        const Image theirs = transformed(painted(kColours), glm::inverse(of.toRec709));
        const Verdict verdict = judge(paintedSubject(kColours, theirs), {});
        EXPECT_EQ(verdict.primaries, of.primaries) << of.title << "\n" << toText(verdict);
        const Finding* const finding = find(verdict, "primaries");
        ASSERT_NE(finding, nullptr) << of.title << "\n" << toText(verdict);
        EXPECT_EQ(finding->sentence, std::string("the picture is in ") + of.title + " primaries");
        EXPECT_TRUE(finding->also.empty()) << toText(verdict);
        EXPECT_EQ(verdict.findings.size(), 1u) << toText(verdict);
        EXPECT_NEAR(verdict.exposure, 2.0, 0.02) << of.title;
    }
}

TEST(Primaries, OfARightPictureAreRec709) {
    const Verdict verdict = judge(paintedSubject(kColours, painted(kColours)), {});
    EXPECT_EQ(verdict.primaries, Primaries::rec709);
    EXPECT_TRUE(verdict.otherPrimaries.empty()) << toText(verdict);
    EXPECT_TRUE(verdict.findings.empty()) << toText(verdict);
    EXPECT_NE(toText(verdict).find("in Rec. 709 primaries"), std::string::npos) << toText(verdict);
}

TEST(Primaries, AreFoundNextToAnEncodingAndToAMissingPathClass) {
    const glm::dmat3 matrix = glm::inverse(published()[1].toRec709);
    Image theirs = theirPicture({.spot = 0.0}, 0.004);
    paint(theirs, kColours);
    theirs = transformed(theirs, matrix);
    // As pictures for a Display P3 are coded, in floating point.
    for (float& value : theirs.values) {
        const double linear = std::max(static_cast<double>(value), 0.0);
        value = static_cast<float>(
            linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
    }
    const Verdict verdict = judge(paintedSubject(kColours, theirs), {});
    EXPECT_EQ(verdict.encoding, Encoding::srgb) << toText(verdict);
    EXPECT_EQ(verdict.primaries, Primaries::p3) << toText(verdict);
    EXPECT_NE(find(verdict, "missing:TRT"), nullptr) << toText(verdict);
    EXPECT_EQ(verdict.findings.size(), 3u) << toText(verdict);
}

// White is white in all of them.
TEST(Primaries, OfAGreySceneCannotBeTold) {
    Subject subject = drawnSubject(theirPicture({}, 1.0));
    const auto makeGrey = [](Image& image) {
        for (std::size_t i = 0; i < image.values.size(); ++i)
            image.values[i] = image.values[i - i % 3];
    };
    makeGrey(subject.direct);
    makeGrey(subject.fill);
    for (Light& light : subject.classes)
        makeGrey(light.radiance);
    for (Cause& cause : subject.causes)
        makeGrey(cause.radiance);
    // With the channels' own noise, which primaries must not be told by.
    for (std::size_t i = 0; i < subject.theirs.values.size(); ++i)
        subject.theirs.values[i] /= 1.0f - 0.1f * static_cast<float>(i % 3);
    const Verdict verdict = judge(subject, {});
    EXPECT_EQ(verdict.primaries, Primaries::rec709);
    EXPECT_EQ(verdict.otherPrimaries.size(), kAllPrimaries.size() - 1) << toText(verdict);
    EXPECT_NE(toText(verdict).find("cannot be told, since it has too little colour"),
              std::string::npos)
        << toText(verdict);
    EXPECT_TRUE(verdict.findings.empty()) << toText(verdict);
}

// Of one colour other primaries are another white balance; who knows them says so.
TEST(Primaries, AreTakenAsTheyAreAskedForWhereTheyCannotBeTold) {
    const Image theirs =
        transformed(painted(kOneColour), glm::inverse(published().front().toRec709));
    const Verdict found = judge(paintedSubject(kOneColour, theirs), {});
    EXPECT_EQ(found.otherPrimaries.size(), kAllPrimaries.size() - 1) << toText(found);
    EXPECT_NE(find(found, "channels"), nullptr) << toText(found);
    EXPECT_EQ(found.findings.size(), 1u) << toText(found);

    NamedOptions names;
    names.primaries = "rec2020";
    const JudgeOptions options = optionsOf(names, [](const std::string& name) { return name; });
    const Verdict asked = judge(paintedSubject(kOneColour, theirs), options);
    EXPECT_EQ(asked.primaries, Primaries::rec2020);
    EXPECT_TRUE(asked.otherPrimaries.empty());
    EXPECT_TRUE(asked.findings.empty()) << toText(asked);
    EXPECT_NEAR(asked.exposure, 2.0, 0.02);
}

// Of one photon all channels are too bright, as in the reference of a real scene.
TEST(Primaries, AreNotToldByNoiseThatChannelsShare) {
    Subject subject = paintedSubject(
        kOneColour, transformed(painted(kOneColour), glm::inverse(published().front().toRec709)));
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    for (Light& light : subject.classes) {
        for (std::size_t i = 0; i < light.radiance.values.size(); i += 3) {
            const float factor = normal(random);
            for (std::size_t c = i; c < i + 3; ++c) {
                light.error.values[c] = 0.1f * std::abs(light.radiance.values[c]);
                light.radiance.values[c] += factor * light.error.values[c];
            }
        }
    }
    const Verdict verdict = judge(subject, {});
    EXPECT_EQ(verdict.primaries, Primaries::rec709) << toText(verdict);
    EXPECT_EQ(verdict.otherPrimaries.size(), kAllPrimaries.size() - 1) << toText(verdict);
}

TEST(Primaries, AreNoWhiteBalanceOfAColouredPicture) {
    Image theirs = painted(kColours);
    for (std::size_t i = 2; i < theirs.values.size(); i += 3)
        theirs.values[i] *= 0.8f;
    const Verdict verdict = judge(paintedSubject(kColours, theirs), {});
    EXPECT_EQ(verdict.primaries, Primaries::rec709) << toText(verdict);
    EXPECT_NE(find(verdict, "channels"), nullptr) << toText(verdict);
    EXPECT_EQ(verdict.findings.size(), 1u) << toText(verdict);
}

// As that of a body that absorbs, in a renderer that forgets it: direct light speaks against it.
TEST(Primaries, AreNotTheColoursOfTheCausticAlone) {
    Image direct = theirPicture({.ring = 0.0, .spot = 0.0, .streak = 0.0}, 1.0);
    Image caustic = theirPicture({.direct = 0.0, .ring = 3.0, .spot = 3.0, .streak = 3.0}, 1.0);
    paint(direct, kColours);
    paint(caustic, kColours);
    Image theirs = transformed(caustic, glm::inverse(published().front().toRec709));
    for (std::size_t i = 0; i < theirs.values.size(); ++i)
        theirs.values[i] += direct.values[i];
    const Verdict verdict = judge(paintedSubject(kColours, theirs), {});
    EXPECT_EQ(verdict.primaries, Primaries::rec709) << toText(verdict);
    EXPECT_EQ(find(verdict, "primaries"), nullptr) << toText(verdict);
}

TEST(Primaries, AreAskedForByName) {
    const auto asked = [](const std::string& word) {
        NamedOptions names;
        names.primaries = word;
        return optionsOf(names, [](const std::string& name) { return "--" + name; }).primaries;
    };
    EXPECT_EQ(asked("auto"), Primaries::automatic);
    for (const Primaries primaries : kAllPrimaries)
        EXPECT_EQ(asked(nameOf(primaries)), primaries);
    try {
        static_cast<void>(asked("rec2021"));
        FAIL() << "a word that there is not is taken";
    } catch (const ConfigError& error) {
        EXPECT_NE(std::string(error.what()).find("--primaries: 'rec2021' is neither auto"),
                  std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace kaustik::judge
