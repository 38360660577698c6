// SPDX-License-Identifier: MIT
// Caustics that are blurred are told from those that the reference's noise differs from.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "framework/judge/judge.h"
#include "framework/judge/pictures.h"
#include "tests/unit/judge/drawn_scene.h"

namespace kaustik::judge {
namespace {

using namespace test;

// Nothing else is said.
void expectOnly(const Verdict& verdict, const std::string& name) {
    ASSERT_EQ(verdict.findings.size(), 1u) << toText(verdict);
    EXPECT_EQ(verdict.findings.front().name, name) << toText(verdict);
}

// Of the caustics alone, as a photon map's kernel makes it.
Image blurredPicture(double sigma) {
    Image theirs = theirPicture({.ring = 0, .spot = 0, .streak = 0}, 1.0, 0.0);
    const Image albedo = drawn({}, [](const DrawnLight& light) { return light.albedo; });
    Image caustics = theirPicture({.direct = 0.0}, 1.0, 0.0);
    for (std::size_t i = 0; i < caustics.values.size(); ++i)
        caustics.values[i] /= albedo.values[i];
    caustics = blurred(caustics, sigma);
    for (std::size_t i = 0; i < caustics.values.size(); ++i)
        theirs.values[i] += albedo.values[i] * caustics.values[i];
    addNoise(theirs, 0.01, 1.0, 9);
    return theirs;
}

TEST(Blur, OfTheCausticsIsSaid) {
    for (const double sigma : {0.65, 1.25, 2.5}) {
        const Verdict verdict = judge(drawnSubject(blurredPicture(sigma)), {});
        expectOnly(verdict, "blur");
        EXPECT_EQ(verdict.blurPixels, sigma) << toText(verdict);
    }
}

// A blur would make it less.
TEST(Blur, IsNotTheNoiseOfAReference) {
    Subject subject = drawnSubject(theirPicture({.ring = 0.0}, 1.0));
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    for (Light& light : subject.classes) {
        for (std::size_t i = 0; i < light.radiance.values.size(); ++i) {
            float& error = light.error.values[i];
            light.radiance.values[i] += 10.0f * error * normal(random);
            error *= 10.05f;  // with what is there already
        }
    }
    expectOnly(judge(subject, {}), "missing:TT");
}

TEST(Blur, IsNotTheNoiseOfAMistakesPictures) {
    Subject subject = drawnSubject(theirPicture({.index = 1.42}, 1.0));
    Cause flipped;
    flipped.kind = CauseKind::whole;
    flipped.name = "normals of 'ball'";
    flipped.sentence = "the normals of 'ball' are flipped";
    const Drawing usual{.direct = 0, .spot = 0, .streak = 0};
    Drawing other = usual;
    other.index = 1.42;
    flipped.radiance = theirPicture(other, 1.0, 0.05, 8);
    const Image usualRing = theirPicture(usual, 1.0, 0.05, 9);
    for (std::size_t i = 0; i < usualRing.values.size(); ++i)
        flipped.radiance.values[i] -= usualRing.values[i];
    subject.causes.push_back(flipped);
    expectOnly(judge(subject, {}), "normals of 'ball'");
}

}  // namespace
}  // namespace kaustik::judge
