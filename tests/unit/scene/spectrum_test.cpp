// SPDX-License-Identifier: MIT
#include "framework/scene/spectrum.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "framework/scene/dispersion.h"
#include "framework/scene/shapes/shapes.h"

namespace kaustik::scene {
namespace {

void expectEqual(const glm::dmat3& a, const glm::dmat3& b, double tolerance) {
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r)
            EXPECT_NEAR(a[c][r], b[c][r], tolerance) << "column " << c << ", row " << r;
    }
}

TEST(Spectrum, ChannelsOfFluxAddUpAsThoseOfRec709) {
    const glm::dvec3 ones(1.0);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(glm::dot(ones, fluxFromRec709()[c]), 1.0, 1e-12);
        EXPECT_NEAR(glm::dot(ones, rec709FromFlux()[c]), 1.0, 1e-12);
    }
    expectEqual(fluxFromRec709() * rec709FromFlux(), glm::dmat3(1.0), 1e-12);
}

// ITU-R BT.709: Y = 0.2126 R + 0.7152 G + 0.0722 B.
TEST(Spectrum, LuminanceIsThatOfRec709) {
    const glm::dvec3 luminance(fluxFromRec709()[0].y, fluxFromRec709()[1].y, fluxFromRec709()[2].y);
    const double white = luminance.x + luminance.y + luminance.z;
    EXPECT_NEAR(luminance.x / white, 0.2126, 1e-3);
    EXPECT_NEAR(luminance.y / white, 0.7152, 1e-3);
    EXPECT_NEAR(luminance.z / white, 0.0722, 1e-3);
}

TEST(Spectrum, BandsAddUpToEveryColor) {
    for (const int count : {1, 2, 8, 13, 64}) {
        glm::dmat3 sum(0.0);
        for (const Band& band : spectralBands(count)) {
            sum += glm::dmat3(band.ofLight);
            for (int c = 0; c < 3; ++c)
                EXPECT_GE(glm::dmat3(band.ofLight)[c][c], 0.0);
            EXPECT_NEAR(band.tint.r + band.tint.g + band.tint.b, 1.0, 1e-6);
            // Nothing negative: sums of flux on the device drop that.
            const glm::vec3 white = band.ofLight * glm::vec3(1.0f);
            EXPECT_GE(std::min({white.r, white.g, white.b}), 0.0f);
        }
        expectEqual(sum, fluxFromRec709(), 1e-6);
    }
}

TEST(Spectrum, BandsGoFromVioletToRed) {
    const std::vector<Band> bands = spectralBands(8);
    ASSERT_EQ(bands.size(), 8u);
    for (std::size_t i = 1; i < bands.size(); ++i)
        EXPECT_LT(bands[i].place, bands[i - 1].place);
    EXPECT_GT(bands.front().place, dispersionPlace(460.0));
    EXPECT_LT(bands.back().place, dispersionPlace(610.0));
    EXPECT_GT(bands.front().tint.b, 0.9f);
    EXPECT_GT(bands.back().tint.r, 0.9f);
}

TEST(Spectrum, DrawnWavelengthsHaveTheLightsColorAsTheirMean) {
    constexpr int kCount = 4096;
    glm::dmat3 sum(0.0);
    for (int i = 0; i < kCount; ++i)
        sum += drawWavelength((i + 0.5) / kCount).ofLight;
    expectEqual(sum / static_cast<double>(kCount), glm::dmat3(1.0), 1e-4);
}

TEST(Spectrum, PrimariesAreSharesOfWhite) {
    for (double nm = kShortestNanometers; nm <= kLongestNanometers; nm += 1.0) {
        const glm::dvec3 primaries = primariesAt(nm);
        EXPECT_NEAR(primaries.r + primaries.g + primaries.b, 1.0, 1e-8);
        EXPECT_GE(std::min({primaries.r, primaries.g, primaries.b}), 0.0);
    }
}

TEST(Spectrum, BandsHaveTheirOwnLights) {
    Scene scene;
    scene.meshes.push_back(makePrism({60.0, 1.0, 1.0}));
    Material glass;
    glass.kind = MaterialKind::dielectric;
    scene.materials.push_back(glass);
    scene.objects.push_back({});
    scene.lights.resize(2);
    scene.lights[1].name = "second";
    placeBands(scene, 8, 600, 1.0);
    EXPECT_TRUE(scene.bands.empty());
    EXPECT_EQ(scene.lights.size(), 2u);
    scene.materials[0].dispersion.x = 0.005f;
    placeBands(scene, 8, 600, 1.0);
    ASSERT_EQ(scene.lights.size(), 16u);
    EXPECT_EQ(scene.lights[15].band, 7);
    EXPECT_EQ(scene.lights[15].name, "second");
    placeBands(scene, 1, 600, 1.0);
    EXPECT_EQ(scene.lights.size(), 2u);
    EXPECT_TRUE(scene.bands.empty());
    // However far colors part, no more than leave each 64 x 64 photons, and no fewer than 8.
    scene.materials[0].dispersion.x = 0.1f;
    EXPECT_EQ(bandsOf(scene, 0, 600, 16.0 * 4096.0).bands, 16);
    EXPECT_EQ(bandsOf(scene, 0, 600, 1.0).bands, 8);
    EXPECT_EQ(bandsOf(scene, 0, 600, 1e9).bands, 32);
}

TEST(Dispersion, NamedGlassesAreThoseOfTheirDataSheets) {
    for (const NamedGlass& glass : namedGlasses()) {
        const auto index = [&](double nm) { return sellmeierIndex(glass.sellmeier, nm); };
        EXPECT_NEAR(index(kHeliumNanometers), glass.ior, 6e-5) << glass.name;
        EXPECT_NEAR((index(kHeliumNanometers) - 1.0) / (index(486.1327) - index(656.2725)),
                    glass.abbeNumber, 0.06)
            << glass.name;
    }
}

TEST(Dispersion, PolynomialsAreNearTheirFormula) {
    for (const NamedGlass& glass : namedGlasses()) {
        const Dispersion dispersion = bySellmeier(glass.sellmeier);
        Material material;
        material.ior = static_cast<float>(dispersion.ior);
        material.dispersion = glm::vec4(dispersion.polynomial);
        double worst = 0.0;
        for (double nm = kShortestNanometers; nm <= kLongestNanometers; nm += 1.0) {
            worst = std::max(worst, std::abs(indexAt(material, dispersionPlace(nm)) -
                                             sellmeierIndex(glass.sellmeier, nm)));
        }
        EXPECT_LT(worst, 2e-5) << glass.name;
        EXPECT_TRUE(isPossible(dispersion)) << glass.name;
    }
}

TEST(Dispersion, AnAbbeNumberIsThatOfTheIndex) {
    const Dispersion dispersion = byAbbeNumber(1.6, 30.0);
    Material material;
    material.ior = 1.6f;
    material.dispersion = glm::vec4(dispersion.polynomial);
    const auto index = [&](double nm) { return indexAt(material, dispersionPlace(nm)); };
    EXPECT_NEAR(0.6 / (index(486.1327) - index(656.2725)), 30.0, 1e-4);
    EXPECT_FALSE(isPossible(byAbbeNumber(1.01, 0.1)));
}

TEST(Dispersion, CauchysFormulaIsKept) {
    const glm::dvec3 terms(1.5, 0.004, 0.0001);
    const Dispersion dispersion = byCauchy(terms);
    Material material;
    material.ior = static_cast<float>(dispersion.ior);
    material.dispersion = glm::vec4(dispersion.polynomial);
    for (const double micrometers : {0.4, 0.55, 0.7}) {
        const double square = micrometers * micrometers;
        EXPECT_NEAR(indexAt(material, dispersionPlace(1e3 * micrometers)),
                    terms.x + terms.y / square + terms.z / (square * square), 1e-6);
    }
}

}  // namespace
}  // namespace kaustik::scene
