// SPDX-License-Identifier: MIT
// The reference's light by wavelength, against Snell's law and Descartes' rainbow.
#include <cmath>
#include <numbers>

#include "framework/reference/light_tracing.h"
#include "framework/scene/dispersion.h"
#include "framework/scene/spectrum.h"
#include "tests/accuracy/path_fixture.h"

namespace kaustik::reference {
namespace {

scene::Material named(const std::string& name) {
    for (const scene::NamedGlass& glass : scene::namedGlasses()) {
        if (glass.name != name) continue;
        const scene::Dispersion dispersion = scene::bySellmeier(glass.sellmeier);
        scene::Material material = reference::glass(dispersion.ior);
        material.dispersion = glm::vec4(dispersion.polynomial);
        return material;
    }
    return {};
}

PhotonState photonOf(double nanometers, const glm::dvec3& origin, const glm::dvec3& direction) {
    PhotonState photon;
    photon.origin = origin;
    photon.direction = glm::normalize(direction);
    photon.fluxWatts = glm::dvec3(1.0);
    photon.wavelength = {scene::dispersionPlace(nanometers), scene::primariesAt(nanometers)};
    return photon;
}

TEST(Dispersion, ABallOfWaterHasItsRainbow) {
    const scene::Scene scene = sceneOf(scene::makeSphere({1.0, 1024}), named("water"));
    const EmbreeScene embree(scene);
    PathFilter filter;
    filter.splitInteractions = 3;
    filter.maximumInteractions = 3;
    const LightTransport transport(embree, filter);
    for (const double nanometers : {400.0, 700.0}) {
        double largest = 0.0;
        for (int i = 0; i < 2000; ++i) {
            const double b = (i + 0.5) / 2000.0;
            SegmentRecorder recorder(embree.center());
            Random random(1, 0, 0);
            transport.follow(
                photonOf(nanometers, glm::dvec3(b, 0.013, 3.0) - embree.center(), {0.0, 0.0, -1.0}),
                {}, random, recorder);
            for (const PathSegment& segment : recorder.segments) {
                // In, reflected once, and out.
                if (segment.interactions != 3) continue;
                largest = std::max(largest, std::acos(std::clamp(segment.direction.z, -1.0, 1.0)));
            }
        }
        const double n = scene::indexAt(scene.materials[0], scene::dispersionPlace(nanometers));
        const double incidence = std::acos(std::sqrt((n * n - 1.0) / 3.0));
        const double bow = 4.0 * std::asin(std::sin(incidence) / n) - 2.0 * incidence;
        EXPECT_NEAR(glm::degrees(largest), glm::degrees(bow), 0.05);
        EXPECT_NEAR(glm::degrees(largest), nanometers < 500.0 ? 40.5 : 42.4, 0.2);
    }
}

// White light on a pane that disperses: what arrives behind it is white but for Fresnel's share.
TEST(Dispersion, PhotonsAreWhiteTogether) {
    scene::Scene scene = sceneOf(scene::makePlane({{1.0, 1.0}, {1, 1}}), named("N-BK7"));
    addObject(scene, scene::makePlane({{2.0, 2.0}, {1, 1}}), scene::Material{}, {0.0, -1.0, 0.0});
    scene::Light sun;
    sun.power = glm::vec3(1000.0f);
    scene.lights.push_back(sun);
    const EmbreeScene embree(scene);
    LightTraceSettings settings;
    settings.width = settings.height = 2;
    settings.photonsPerBatch = 1u << 16;
    PixelSums sums = makeLightTraceSums(embree, settings);
    RunOptions options;
    options.stop.batches = 16;
    lightTrace(embree, settings, options, sums);
    const Image mean = sums.meanImage(0);
    glm::dvec3 sum(0.0);
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 2; ++x)
            sum += glm::dvec3(mean.at(x, y, 0), mean.at(x, y, 1), mean.at(x, y, 2));
    }
    EXPECT_NEAR(sums.energy().watts[transport::kAccountEmitted], 1000.0, 2.0);
    const double all = (sum.r + sum.g + sum.b) / 3.0;
    ASSERT_GT(all, 0.0);
    // A million photons, of which the eye sees some: 0.5 % is three deviations.
    EXPECT_NEAR(sum.r / all, 1.0, 5e-3);
    EXPECT_NEAR(sum.g / all, 1.0, 5e-3);
    EXPECT_NEAR(sum.b / all, 1.0, 5e-3);
}

}  // namespace
}  // namespace kaustik::reference
