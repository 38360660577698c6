// SPDX-License-Identifier: MIT
// Certificates against what is known in closed form, and against errors that are planted: still
// water under a sun straight above, whose floor has (1 - ((n-1)/(n+1))²) 1000 W/m².
#include "framework/certify/certificate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "framework/certify/verdict.h"
#include "framework/core/error.h"
#include "framework/scene/files/scene_file.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::certify {
namespace {

namespace fs = std::filesystem;

constexpr double kIndex = static_cast<double>(1.333f);
constexpr double kThrough =
    1.0 - (kIndex - 1.0) * (kIndex - 1.0) / ((kIndex + 1.0) * (kIndex + 1.0));

CertificateRequest smallRequest() {
    CertificateRequest request;
    request.width = 32;
    request.height = 24;
    request.beams.bandPixels = 0.02;
    return request;
}

const scene::Scene& stillWater() {
    static const scene::Scene scene = [] {
        scene::Scene loaded = scene::loadScene("flat-water");
        return loaded;
    }();
    return scene;
}

Certificate certify(const scene::Scene& scene, const CertificateRequest& request,
                    const PlantedError& planted = {}) {
    CertifyOptions options;
    options.planted = planted;
    return makeCertificate(scene, {certifyPart(scene, request, options)});
}

const Certificate& stillWaterCertificate() {
    static const Certificate certificate = certify(stillWater(), smallRequest());
    return certificate;
}

// A pixel whose footprint is on the floor.
constexpr std::size_t kMiddle = (12 * 32 + 16) * 3;

TEST(Certificate, HoldsTheIrradianceUnderStillWater) {
    const Certificate& found = stillWaterCertificate();
    const double truth = 1000.0 * kThrough;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto low = static_cast<double>(found.lower.values[kMiddle + c]);
        const auto high = static_cast<double>(found.upper.values[kMiddle + c]);
        EXPECT_LE(low, truth);
        EXPECT_GE(high, truth);
        EXPECT_LT(high - low, 0.05 * truth);
    }
}

TEST(Certificate, HoldsTheWattsOfStillWaterWithinHalfAPerMille) {
    const Certificate& found = stillWaterCertificate();
    // 4 m by 3 m of water are lit between the decks.
    const double emitted = 12.0 * 1000.0;
    EXPECT_LE(found.totals.emitted.lo, emitted * (1.0 + 1e-6));
    EXPECT_GE(found.totals.emitted.hi, emitted * (1.0 - 1e-6));
    EXPECT_LE(found.totals.deposited.lo, emitted * kThrough * (1.0 + 1e-6));
    EXPECT_GE(found.totals.deposited.hi, emitted * kThrough * (1.0 - 1e-6));
    EXPECT_LT(tightnessOf(found).totalWidth, 5e-4);
}

// Fresnel off by 0.1 % shows in the watts, off by 5 % in nearly every lit pixel.
TEST(Certificate, FindsFresnelThatIsOff) {
    const Certificate& truth = stillWaterCertificate();
    const Certificate slightly = certify(stillWater(), smallRequest(), {.fresnelFactor = 1.001});
    EXPECT_GT(slightly.totals.deposited.lo, truth.totals.deposited.hi);
    const Certificate wrong = certify(stillWater(), smallRequest(), {.fresnelFactor = 1.05});
    std::size_t proved = 0;
    std::size_t lit = 0;
    for (std::size_t i = 0; i < truth.lower.values.size(); ++i) {
        if (!(truth.lower.values[i] > 900.0f)) continue;
        ++lit;
        if (wrong.lower.values[i] > truth.upper.values[i]) ++proved;
    }
    EXPECT_GT(lit, 300u);
    EXPECT_GT(static_cast<double>(proved), 0.9 * static_cast<double>(lit));
}

// A triangle of the water that is gone takes its light with it, 12 m² / 3072 cells / 2 of 1000
// W/m².
TEST(Certificate, FindsATriangleThatIsDropped) {
    const Certificate& truth = stillWaterCertificate();
    const Geometry geometry(stillWater());
    std::uint32_t water = 0;
    // One of the middle of the sheet, which no deck hides.
    for (std::uint32_t i = 0; i < geometry.facets().size(); ++i) {
        const Facet& facet = geometry.facets()[i];
        if (!facet.isReceiver() && std::abs(facet.position[0].x) < 0.1 &&
            std::abs(facet.position[0].z) < 0.1)
            water = i;
    }
    ASSERT_FALSE(geometry.facets()[water].isReceiver());
    const Certificate wrong = certify(stillWater(), smallRequest(), {.droppedFacet = water});
    EXPECT_LT(wrong.totals.deposited.hi, truth.totals.deposited.lo);
    EXPECT_LT(wrong.totals.emitted.hi, truth.totals.emitted.lo);
}

// The sun from the side: the still water sends light up to the basin's wall, and what it lets
// through is on the floor and on the same wall.
const scene::Scene& stillWaterUnderALowSun() {
    static const scene::Scene scene = [] {
        scene::Scene loaded = stillWater();
        loaded.lights[0].direction = glm::normalize(glm::dvec3(0.8, -0.6, 0.0));
        return loaded;
    }();
    return scene;
}

// A path that is left out: what water reflects, 6 % of the light that meets it here.
TEST(Certificate, FindsAMissingReflection) {
    const scene::Scene& scene = stillWaterUnderALowSun();
    const Certificate truth = certify(scene, smallRequest());
    const Certificate wrong = certify(scene, smallRequest(), {.withoutReflection = true});
    EXPECT_GT(truth.totals.deposited.lo, wrong.totals.deposited.hi);
    EXPECT_EQ(truth.totals.emitted.lo, wrong.totals.emitted.lo);
    // A picture of what is left is proved too dark where the wall is above the water, and nowhere
    // too bright.
    Image picture = wrong.lower;
    for (std::size_t i = 0; i < picture.values.size(); ++i)
        picture.values[i] = 0.5f * (wrong.lower.values[i] + wrong.upper.values[i]);
    const Verdict verdict = judge(picture, truth);
    EXPECT_GT(verdict.below, 10u);
    EXPECT_LT(verdict.below, verdict.pixels / 4);
    EXPECT_EQ(verdict.above, 0u);
}

// Whether all of the pixel is of the wall at x = 2 m, below the water at y = 0.
bool seesTheWallUnderWater(const scene::Scene& scene, const CertificateRequest& request,
                           std::size_t pixel) {
    const Geometry geometry(scene);
    const EyeView eye(geometry, 1, 1);
    const glm::dvec3 from = eye.position() + geometry.center();
    const double perPixel = 2.0 * eye.tangents().y / request.height;
    for (const std::size_t corner : {0u, 1u, 2u, 3u}) {
        const auto u = static_cast<double>(pixel % 32 + corner % 2);
        const auto v = static_cast<double>(pixel / 32 + corner / 2);
        const glm::dvec3 ray = (u - 0.5 * request.width) * perPixel * eye.right() +
                               (0.5 * request.height - v) * perPixel * eye.up() - eye.backward();
        const glm::dvec3 hit = from + (2.0 - from.x) / ray.x * ray;
        if (!(ray.x > 0.0) || hit.y > -0.01 || hit.y < -1.19 || std::abs(hit.z) > 1.45)
            return false;
    }
    return true;
}

// Light of one direction brings to a wall its irradiance on the water times the tangent of the
// refracted angle: light that grazes the wall, too.
TEST(Certificate, HoldsTheIrradianceOfAWallThatLightGrazes) {
    for (const double sine : {0.8, 0.01}) {
        scene::Scene scene = stillWater();
        const double cosine = std::sqrt(1.0 - sine * sine);
        scene.lights[0].direction = glm::dvec3(sine, -cosine, 0.0);
        CertificateRequest request = smallRequest();
        request.beams.transmissionOnly = true;
        const Certificate found = certify(scene, request);
        const double inside = sine / kIndex;
        const double exit = std::sqrt(1.0 - inside * inside);
        const double s = (cosine - kIndex * exit) / (cosine + kIndex * exit);
        const double p = (kIndex * cosine - exit) / (kIndex * cosine + exit);
        const double wall = 1000.0 * cosine * (1.0 - 0.5 * (s * s + p * p)) * inside / exit;
        std::size_t ofWall = 0;
        for (std::size_t i = 0; 3 * i < found.lower.values.size(); ++i) {
            if (!seesTheWallUnderWater(scene, request, i)) continue;
            ++ofWall;
            const auto low = static_cast<double>(found.lower.values[3 * i]);
            const auto high = static_cast<double>(found.upper.values[3 * i]);
            EXPECT_LE(low, wall);
            EXPECT_GE(high, wall);
            EXPECT_LT(high - low, 0.15 * wall);
        }
        EXPECT_GT(ofWall, 8u) << sine;
    }
}

TEST(Certificate, OfShardsIsTheWholeBitByBit) {
    CertificateRequest request = smallRequest();
    request.width = 16;
    request.height = 12;
    std::vector<CertificatePart> parts;
    for (std::uint64_t i = 1; i <= 3; ++i) {
        CertifyOptions options;
        options.shard = {i, 3};
        options.threads = static_cast<int>(i);
        parts.push_back(certifyPart(stillWater(), request, options));
    }
    const Certificate merged = makeCertificate(stillWater(), {parts[2], parts[0], parts[1]});
    const Certificate whole = certify(stillWater(), request);
    EXPECT_EQ(merged.lower.values, whole.lower.values);
    EXPECT_EQ(merged.upper.values, whole.upper.values);
    EXPECT_EQ(merged.totals.deposited.lo, whole.totals.deposited.lo);
    EXPECT_EQ(merged.totals.deposited.hi, whole.totals.deposited.hi);
    EXPECT_THROW((void)makeCertificate(stillWater(), {parts[0], parts[2]}), ConfigError);
}

TEST(Certificate, GoesOnWhereItWasStopped) {
    CertificateRequest request = smallRequest();
    request.width = 16;
    request.height = 12;
    const test::TemporaryFolder folder;
    const fs::path file = folder / "half.shard";
    CertifyOptions options;
    options.keep = file;
    options.threads = 1;
    options.progress = [](double share, std::uint64_t) { return share < 0.5; };
    const CertificatePart half = certifyPart(stillWater(), request, options);
    EXPECT_FALSE(half.isWhole());
    EXPECT_GT(half.blocksDone, 0u);
    options.progress = {};
    const CertificatePart rest = certifyPart(stillWater(), request, options);
    EXPECT_TRUE(rest.isWhole());
    const Certificate whole = certify(stillWater(), request);
    EXPECT_EQ(makeCertificate(stillWater(), {rest}).lower.values, whole.lower.values);
}

TEST(Certificate, SaysWhatCannotBeCertified) {
    scene::Scene foggy = stillWater();
    foggy.medium.emplace();
    EXPECT_THROW((void)Geometry(foggy), ConfigError);
    scene::Scene spot = stillWater();
    spot.lights[0].kind = scene::LightKind::spot;
    EXPECT_THROW((void)Geometry(spot), ConfigError);
}

}  // namespace
}  // namespace kaustik::certify
