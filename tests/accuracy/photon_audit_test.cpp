// SPDX-License-Identifier: MIT
// The exact first hits that the photon audit compares with: the side rule of side_rule.glsl.
#include "framework/reference/photon_audit.h"

#include <cmath>

#include "framework/render/view.h"
#include "framework/scene/dielectrics.h"
#include "framework/transport/media_stack.h"
#include "tests/accuracy/path_fixture.h"

namespace kaustik::reference {
namespace {

// A floor at y = -1 (material 0), glass at the origin (1) and a mirror that faces +y at y = 2 (2).
scene::Scene floorGlassAndMirror() {
    scene::Scene scene;
    addObject(scene, scene::makePlane({{10.0, 10.0}, {1, 1}}), scene::Material{}, {0, -1, 0});
    addObject(scene, scene::makeBox({.size = {1.0, 1.0, 1.0}}), glass(1.5));
    addObject(scene, scene::makePlane({{10.0, 10.0}, {1, 1}}), mirror(), {0, 2, 0});
    return scene;
}

TEST(PhotonAudit, PhotonInsideADielectricHitsItOnlyFromWithin) {
    const scene::Scene scene = floorGlassAndMirror();
    const EmbreeScene embree(scene);
    const std::uint32_t inGlass = packMedia(numberDielectrics(scene), {2});
    const std::vector<AuditPhoton> photons = {
        {{0.1, 0.5, 0.1}, {0, -1, 0}, inGlass},  // just refracted into the top face
        {{0.1, 0.5, 0.1}, {0, -1, 0}, 0},        // the same place, not inside
        {{0.1, -0.5, 0.1}, {0, -1, 0}, 0},       // just refracted out of the bottom face
        {{0.1, 0.5, 0.1}, {0, 1, 0}, 0},         // up: an open mirror has no wrong side
        {{0.1, 3.0, 0.1}, {0, -2, 0}, 0},        // down on the mirror's front; any length
        {{0.1, -2.0, 0.1}, {0, 1, 0}, 0},        // receivers end it from either side
    };
    const std::vector<FirstHit> hits = exactFirstHits(embree, photons);
    ASSERT_EQ(hits.size(), photons.size());
    EXPECT_EQ(hits[0].material, 2u);
    EXPECT_NEAR(hits[0].distanceMeters, 1.0, 1e-12);
    EXPECT_EQ(hits[1].material, 2u);
    EXPECT_NEAR(hits[1].distanceMeters, 0.0, 1e-12);
    EXPECT_EQ(hits[2].material, 1u);
    EXPECT_NEAR(hits[2].distanceMeters, 0.5, 1e-12);
    EXPECT_EQ(hits[3].material, 3u);
    EXPECT_NEAR(hits[3].distanceMeters, 1.5, 1e-12);
    EXPECT_EQ(hits[4].material, 3u);
    EXPECT_NEAR(hits[4].distanceMeters, 1.0, 1e-12);
    EXPECT_EQ(hits[5].material, 1u);
}

TEST(PhotonAudit, PhotonDoesNotHitTheOpenMirrorThatItHasLeftOnThatSide) {
    const scene::Scene scene = floorGlassAndMirror();
    const EmbreeScene embree(scene);
    const auto leaves = [](std::uint32_t side) { return transport::withLeftSide(0, side); };
    // A tracer puts them next to the surface, at times on its far side.
    const std::vector<AuditPhoton> photons = {
        {{0.1, 1.999, 0.1}, {0, 1, 0}, leaves(transport::kLeftOutside), 0.01},
        {{0.1, 2.001, 0.1}, {0, -1, 0}, leaves(transport::kLeftInside), 0.01},
        {{0.1, 1.9, 0.1}, {0, 1, 0}, leaves(transport::kLeftOutside), 0.01},
        {{0.1, 2.001, 0.1}, {0, -1, 0}, leaves(transport::kLeftOutside), 0.01},
    };
    const std::vector<FirstHit> hits = exactFirstHits(embree, photons);
    EXPECT_FALSE(hits[0].exists());
    EXPECT_EQ(hits[1].material, 2u);  // past the mirror, down on the glass
    EXPECT_EQ(hits[2].material, 3u);  // farther than what a tracer is off
    EXPECT_EQ(hits[3].material, 3u);  // back on the side that it left
}

TEST(PhotonAudit, PhotonsThatAreNoNumbersHitNothing) {
    const scene::Scene scene = floorGlassAndMirror();
    const EmbreeScene embree(scene);
    const double nan = std::nan("");
    const std::vector<AuditPhoton> photons = {
        {{nan, 0, 0}, {0, -1, 0}, 0}, {{0, 0, 0}, {0, nan, 0}, 0}, {{0, 0, 0}, {0, 0, 0}, 0}};
    for (const FirstHit& hit : exactFirstHits(embree, photons))
        EXPECT_FALSE(hit.exists());
}

TEST(PhotonAudit, ViewSpaceGivesTheSameHitsAtAnyNumberOfThreads) {
    const scene::Scene scene = floorGlassAndMirror();
    const EmbreeScene embree(scene);
    const render::RasterView view = render::makeEyeView(scene.camera, 64, 48);
    std::vector<AuditPhoton> world;
    std::vector<AuditPhoton> seen;
    Random random(3, 0, 0);
    const auto signedUniform = [&] { return 2.0 * random.uniform() - 1.0; };
    for (int i = 0; i < 5000; ++i) {
        const glm::dvec3 position(signedUniform(), signedUniform(), signedUniform());
        const glm::dvec3 direction(signedUniform(), signedUniform(), signedUniform());
        world.push_back({position, direction, 0});
        seen.push_back({glm::dvec3(view.worldToView * glm::dvec4(position, 1.0)),
                        glm::dmat3(view.worldToView) * direction, 0});
    }
    const std::vector<FirstHit> a = exactFirstHits(embree, world, glm::dmat4(1.0), 1);
    const std::vector<FirstHit> b = exactFirstHits(embree, world, glm::dmat4(1.0), 8);
    const std::vector<FirstHit> c = exactFirstHits(embree, seen, glm::inverse(view.worldToView));
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].position, b[i].position);
        EXPECT_EQ(a[i].material, b[i].material);
        ASSERT_EQ(a[i].material, c[i].material);
        if (!a[i].exists()) continue;
        // Doubles all the way, but for which triangle: 1e-12 of some 10 m.
        const glm::dvec3 back = glm::dvec3(view.worldToView * glm::dvec4(a[i].position, 1.0));
        EXPECT_LT(glm::length(back - c[i].position), 1e-10);
    }
}

}  // namespace
}  // namespace kaustik::reference
