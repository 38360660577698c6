// SPDX-License-Identifier: MIT
// specular.two_interfaces against closed forms: plane-parallel slabs, balls, mirrors, and light
// that it does not follow (W05; WD08, section 3).
#include <fmt/format.h>

#include <cmath>

#include "framework/numerics/cases/scene_text.h"
#include "tests/gpu/techniques/caustic_map_frame.h"
#include "tests/gpu/techniques/smooth_tracer.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using namespace transport;
using glm::dvec3;

constexpr double kThickness = 0.3;  // of the slab, m
constexpr int kSide = 1024;         // of the view of the back faces
const CameraText kAbove{{0.0, 4.0, 5.0}, {0.0, -0.5, 0.0}, 50.0, 0.01};

std::string floorBelow(double height = -1.0) {
    return floorPlane("floor", "grey", 16.0, {0, height, 0});
}
std::string slabOf(const std::string& material) {
    return object("slab", "box", material, {0, 0, 0},
                  fmt::format("size = [4, {}, 4]", number(kThickness)));
}

MapFrame render(const scene::Scene& scene, Settings more, const std::string& photons = "64x64") {
    Settings settings = {{"emit.photons", photons},
                         {"reconstruct.map_covers", "scene"},
                         {"specular.two_interfaces.size", std::to_string(kSide)}};
    settings.insert(settings.end(), more.begin(), more.end());
    return {scene, "caustic_map", settings};
}

scene::Bounds boundsOfSpecular(const scene::Scene& scene) {
    scene::Bounds bounds;
    for (const scene::Object& object : scene.objects) {
        if (isReceiver(scene.materials[object.material].kind)) continue;
        const scene::Bounds one = objectBounds(scene, object);
        bounds.include(one.minimum);
        bounds.include(one.maximum);
    }
    return bounds;
}

// Of the view of the back faces, m across the light.
double backTexel(const scene::Scene& scene) {
    const render::RasterView view =
        render::makeLightView(scene.lights.front(), boundsOfSpecular(scene), sceneBounds(scene));
    return 2.0 * std::max(view.halfExtent.x, view.halfExtent.y) / kSide;
}

struct Slant {
    double degrees = 0.0;
    [[nodiscard]] double angle() const { return glm::radians(degrees); }
    // Of the sun; not along an axis of the light's view.
    [[nodiscard]] dvec3 direction() const {
        const double sine = std::sin(angle());
        return {sine * std::cos(0.4), -std::cos(angle()), sine * std::sin(0.4)};
    }
    [[nodiscard]] double inside() const { return std::asin(std::sin(angle()) / kGlassIndex); }
};

// Whether a ray from an entry may go `lateral` m sideways, this way or along the sun, and still
// meet the slab's underside.
bool isInTheMiddle(const dvec3& entry, const Slant& slant) {
    if (std::abs(entry.y - 0.5 * kThickness) > 1e-3) return false;
    const dvec3 along = slant.direction() * (kThickness / std::cos(slant.angle()));
    const dvec3 end = entry + along;
    const double maximum = 1.95;
    return std::max({std::abs(entry.x), std::abs(entry.z), std::abs(end.x), std::abs(end.z)}) <
           maximum;
}

class Slab : public ::testing::TestWithParam<double> {
  protected:
    const Slant slant{GetParam()};
    const scene::Scene scene =
        makeScene(kAbove, sun(slant.direction()) + slabOf("glass") + floorBelow(-0.5));
    const dvec3 along = refractedBy(glm::normalize(slant.direction()), {0, 1, 0}, 1.0, kGlassIndex);
    // A texel of the back faces is known at its middle, where the light sees them at this slant.
    const double texel = backTexel(scene);
    const double straight = kThickness / std::cos(slant.angle());
    // The search ends with eight halvings of a step that may be 1.6 quarters of all before it.
    const double resolved = straight * 0.4 / 256.0 * 1.6;

    struct Worst {
        int photons = 0;
        double inside = 0.0;     // m, from the distance that is expected
        double sideways = 0.0;   // m, of the exit from the refracted ray
        double direction = 0.0;  // from the sun's
        double flux = 0.0;       // relative, from T(θ)²
    };
    [[nodiscard]] Worst worstOf(const MapFrame& frame, double expected) const {
        Worst worst;
        for (const MapPhoton& photon : frame.photons()) {
            if (photon.fate != kFateInFlight || !isInTheMiddle(photon.entry, slant)) continue;
            ++worst.photons;
            const dvec3 way = photon.position - photon.entry;
            const double inside = glm::dot(way, along);
            worst.inside = std::max(worst.inside, std::abs(inside - expected));
            worst.sideways = std::max(worst.sideways, glm::length(way - inside * along));
            worst.direction = std::max(
                worst.direction, glm::length(photon.direction - glm::normalize(slant.direction())));
            const double t = transmittance(std::cos(slant.angle()), 1.0, kGlassIndex);
            worst.flux =
                std::max(worst.flux, std::abs(photon.flux.g / (photon.entryFlux.g * t * t) - 1.0));
        }
        return worst;
    }
    static void expectParallel(const Worst& worst) {
        EXPECT_GT(worst.photons, 1000);
        // Positions and directions are 32-bit, some metres from the eye.
        EXPECT_LT(worst.sideways, 1e-5);
        EXPECT_LT(worst.direction, 1e-5);
        EXPECT_LT(worst.flux, 1e-5);
    }
};

TEST_P(Slab, BySearchSendsLightOutWhereTheRefractedRayMeetsTheBack) {
    const MapFrame frame = render(scene, {{"specular.two_interfaces.distance", "search"}});
    const Worst worst = worstOf(frame, kThickness / std::cos(slant.inside()));
    expectParallel(worst);
    const double known = 0.5 * texel * std::sin(slant.angle()) / std::cos(slant.inside());
    EXPECT_LT(worst.inside, 1.5 * known + resolved);
    frame.expectBalance();
}

TEST_P(Slab, ShiftsLightSideways) {
    const MapFrame frame = render(scene, {{"specular.two_interfaces.distance", "search"}});
    // Hard case 25: t sin(θ1 - θ2)/cos θ2, and on the floor that over cos θ1.
    const double shift =
        kThickness * std::sin(slant.angle() - slant.inside()) / std::cos(slant.inside());
    int judged = 0;
    double sum = 0.0;
    for (const MapPhoton& photon : frame.photons()) {
        if (photon.hitFate != kFateReceiver || !isInTheMiddle(photon.entry, slant)) continue;
        const dvec3 unit = glm::normalize(slant.direction());
        const dvec3 way = photon.hit - photon.entry;
        sum += glm::length(way - glm::dot(way, unit) * unit);
        ++judged;
    }
    ASSERT_GT(judged, 1000);
    // The mean over texels of the back faces.
    EXPECT_NEAR(sum / judged, shift, 0.5 * texel * std::sin(slant.angle()) + resolved);
}

TEST_P(Slab, ByEstimatesGoesAsFarAsTheirWeightsSay) {
    const double weight = slant.inside() / slant.angle();
    // d_V: along the sun's own ray; d_N: along the normal, the slab's thickness.
    const double expected = weight * straight + (1.0 - weight) * kThickness;
    const Worst worst =
        worstOf(render(scene, {{"specular.two_interfaces.distance", "estimates"}}), expected);
    expectParallel(worst);
    const double known =
        0.5 * texel * (weight * std::tan(slant.angle()) + (1.0 - weight) * std::sin(slant.angle()));
    EXPECT_LT(worst.inside, 1.5 * known + resolved);
    // It is no search: from 30° on they are millimetres apart, and centimetres at 75°.
    EXPECT_GT(expected - kThickness / std::cos(slant.inside()), 2.0 * known);
}

TEST_P(Slab, WithoutStepsGoesAsFarAsTheSunsRayWould) {
    const Worst worst = worstOf(render(scene, {{"specular.two_interfaces.steps", "0"}}), straight);
    expectParallel(worst);
    EXPECT_LT(worst.inside, 0.75 * texel * std::tan(slant.angle()) + 1e-5);
}

INSTANTIATE_TEST_SUITE_P(At, Slab, ::testing::Values(30.0, 45.0, 60.0, 75.0));

// A tinted slab.
scene::Scene tinted(const dvec3& direction) {
    return makeScene(kAbove, sun(direction) +
                                 "[[material]]\nname = \"tint\"\ntype = \"dielectric\"\nior = 1.5\n"
                                 "absorption_per_meter = [0.5, 1, 4]\n" +
                                 slabOf("tint") + floorBelow());
}

TEST(SlabInTheLedger, AbsorbsAndReflectsAtBothInterfacesInClosedForm) {
    // The sun's own ray is the refracted one.
    const MapFrame frame = render(tinted({0, -1, 0}), {{"specular.two_interfaces.steps", "0"}});
    const double emitted = 16000.0;
    const double t = transmittance(1.0, 1.0, kGlassIndex);
    double left = 0.0;  // of the three channels' mean
    for (const double a : {0.5, 1.0, 4.0})
        left += std::exp(-a * kThickness) / 3.0;
    // In 32-bit products, over back faces a flat distance away.
    const double tolerance = 1e-5 * emitted;
    EXPECT_NEAR(frame.watts(kAccountEmitted), emitted, tolerance);
    EXPECT_NEAR(frame.watts(kAccountAbsorbed), emitted * t * (1.0 - left), tolerance);
    EXPECT_NEAR(frame.watts(kAccountUntracedBranch), emitted * (1.0 - t) * (1.0 + t * left),
                tolerance);
    EXPECT_NEAR(frame.watts(kAccountArrived), emitted * t * t * left, tolerance);
    frame.expectBalance();
}

TEST(SlabInTheLedger, AbsorbsByTheWayThatIsTaken) {
    const Slant slant{60.0};
    const double t = transmittance(0.5, 1.0, kGlassIndex);
    for (const char* distance : {"estimates", "search"}) {
        SCOPED_TRACE(distance);
        const MapFrame frame =
            render(tinted(slant.direction()), {{"specular.two_interfaces.distance", distance}});
        double worst = 0.0;
        int judged = 0;
        for (const MapPhoton& photon : frame.photons()) {
            if (photon.fate != kFateInFlight || !isInTheMiddle(photon.entry, slant)) continue;
            const double way = glm::length(photon.position - photon.entry);
            const dvec3 left = glm::exp(-dvec3(0.5, 1.0, 4.0) * way);
            const dvec3 ratio = photon.flux / (photon.entryFlux * t * t * left);
            for (int c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(ratio[c] - 1.0));
            ++judged;
        }
        EXPECT_GT(judged, 1000);
        EXPECT_LT(worst, 2e-5);  // positions of 1e-6 m, times 4/m
        frame.expectBalance();
    }
}

TEST(SlabOfIndexOne, ChangesNothing) {
    const Slant slant{50.0};
    const scene::Scene scene =
        makeScene(kAbove, sun(slant.direction()) +
                              "[[material]]\nname = \"air\"\ntype = \"dielectric\"\nior = 1\n" +
                              slabOf("air") + floorBelow());
    for (const char* distance : {"estimates", "search"}) {
        const MapFrame frame = render(scene, {{"specular.two_interfaces.distance", distance}});
        EXPECT_EQ(frame.watts(kAccountUntracedBranch), 0.0);
        EXPECT_EQ(frame.watts(kAccountInternalReflectionLimit), 0.0);
        for (const MapPhoton& photon : frame.photons()) {
            const dvec3 unit = glm::normalize(slant.direction());
            const dvec3 way = photon.position - photon.entry;
            ASSERT_LT(glm::length(photon.direction - unit), 1e-5);
            ASSERT_LT(glm::length(way - glm::dot(way, unit) * unit), 1e-5);
        }
    }
}

TEST(BallInTwoInterfaces, BySearchIsThatOfExactRays) {
    const dvec3 direction = glm::normalize(dvec3(0.3, -1.0, 0.2));
    const dvec3 center(0.1, 0.3, 0.0);
    const double radius = 0.5;
    const scene::Scene scene = makeScene(
        kAbove, sun(direction) +
                    object("ball", "sphere", "glass", center, "radius = 0.5\nsegments = 640") +
                    floorBelow());
    const SmoothScene smooth = smoothBall(center, radius, kGlassIndex);
    const MapFrame frame = render(scene, {{"specular.two_interfaces.distance", "search"}});
    int paraxial = 0;
    int oblique = 0;
    for (const MapPhoton& photon : frame.photons()) {
        if (photon.fate != kFateInFlight) continue;
        const double height = glm::length(glm::cross(photon.entry - center, direction)) / radius;
        // Beyond 0.95 radii the light sees the ball's sides nearly edge-on.
        if (height > 0.95) continue;
        const std::vector<SmoothHit> own =
            followPath(smooth, {photon.entry - 0.5 * direction, direction}, {false, false});
        ASSERT_EQ(own.size(), 2U);
        (height < 0.3 ? paraxial : oblique)++;
        // Texels are a 1024th of the ball, its edges a 640th of its circumference, which is
        // what the straight edges and their turning normals make of directions.
        EXPECT_LT(glm::length(photon.position - own[1].position), 3e-3 * radius) << height;
        EXPECT_LT(glm::length(photon.direction - own[1].next.direction), height < 0.3 ? 1e-3 : 8e-3)
            << height;
    }
    EXPECT_GT(paraxial, 100);
    EXPECT_GT(oblique, 1000);
    frame.expectBalance();
}

TEST(BallInTwoInterfaces, ByEstimatesIsExactOnTheAxis) {
    const dvec3 direction(0.0, -1.0, 0.0);
    const scene::Scene scene = makeScene(
        kAbove, sun(direction) +
                    object("ball", "sphere", "glass", {0, 0.3, 0}, "radius = 0.5\nsegments = 640") +
                    floorBelow());
    const SmoothScene smooth = smoothBall({0, 0.3, 0}, 0.5, kGlassIndex);
    int judged = 0;
    const MapFrame frame = render(scene, {});
    for (const MapPhoton& photon : frame.photons()) {
        const double height = std::hypot(photon.entry.x, photon.entry.z) / 0.5;
        if (photon.fate != kFateInFlight || height > 0.1) continue;
        const std::vector<SmoothHit> own =
            followPath(smooth, {photon.entry + dvec3(0, 0.5, 0), direction}, {false, false});
        ASSERT_EQ(own.size(), 2U);
        ++judged;
        // d_V and d_N of a ball both differ from the ray's way by the height squared alone.
        EXPECT_LT(glm::length(photon.position - own[1].position), 0.5 * (height * height + 2e-3));
        EXPECT_LT(glm::length(photon.direction - own[1].next.direction), 3e-3);
    }
    EXPECT_GT(judged, 20);
}

TEST(AMirror, ReflectsOnceExactly) {
    const dvec3 direction = glm::normalize(dvec3(0.0, -1.0, -0.3));
    const scene::Scene scene =
        makeScene({{3.0, 2.0, 5.0}, {0.0, 0.0, 0.0}, 60.0, 0.01},
                  sun(direction) +
                      object("mirror", "plane", "mirror", {0, 0, 0},
                             "size = [1, 1]\nrotation_degrees = [0, 0, -50]") +
                      object("wall", "plane", "grey", {2, 0, 0},
                             "size = [8, 8]\nrotation_degrees = [0, 0, 90]") +
                      floorBelow(-2.0));
    const double turn = glm::radians(-50.0);
    const dvec3 normal(-std::sin(turn), std::cos(turn), 0.0);
    const dvec3 expected = direction - 2.0 * glm::dot(direction, normal) * normal;
    const MapFrame frame = render(scene, {});
    int judged = 0;
    for (const MapPhoton& photon : frame.photons()) {
        if (photon.fate != kFateInFlight) continue;
        ++judged;
        ASSERT_TRUE(photon.isReflected);
        ASSERT_LT(glm::length(photon.direction - expected), 1e-6);
        ASSERT_LT(glm::length(photon.position - photon.entry), 1e-6);
        ASSERT_NEAR(photon.flux.g, 0.9 * photon.entryFlux.g, 1e-6 * photon.entryFlux.g);
    }
    EXPECT_GT(judged, 2000);
    EXPECT_NEAR(frame.watts(kAccountAbsorbed), 0.1 * frame.watts(kAccountEmitted),
                1e-6 * frame.watts(kAccountEmitted));
    frame.expectBalance();
}

TEST(TheReflectedBranch, LeavesTheFirstInterfaceAlone) {
    const Slant slant{60.0};
    const scene::Scene scene =
        makeScene(kAbove, sun(slant.direction()) + slabOf("glass") + floorBelow());
    const MapFrame frame = render(scene, {{"specular.two_interfaces.branch", "reflected"}});
    const double r = 1.0 - transmittance(0.5, 1.0, kGlassIndex);
    int judged = 0;
    for (const MapPhoton& photon : frame.photons()) {
        if (!isInTheMiddle(photon.entry, slant)) continue;
        ++judged;
        ASSERT_TRUE(photon.isReflected);
        const dvec3 unit = glm::normalize(slant.direction());
        ASSERT_LT(glm::length(photon.direction - dvec3(unit.x, -unit.y, unit.z)), 1e-5);
        ASSERT_NEAR(photon.flux.g, r * photon.entryFlux.g, 1e-5 * photon.entryFlux.g);
        ASSERT_NE(photon.hitFate, kFateReceiver);  // it goes up, and there is nothing
    }
    EXPECT_GT(judged, 1000);
    frame.expectBalance();
}

// Straight onto a prism's base, and then at 45° onto its sides: more than the critical angle.
TEST(TotalReflectionInside, IsInTheLedger) {
    const scene::Scene scene = makeScene(
        kAbove, sun({0, -1, 0}) +
                    object("prism", "prism", "glass", {0, 0, 0},
                           "apex_degrees = 90\nheight = 0.5\nlength = 1\nrotation_degrees = "
                           "[180, 0, 0]") +
                    floorBelow());
    const MapFrame frame = render(scene, {});
    const double emitted = frame.watts(kAccountEmitted);
    EXPECT_NEAR(emitted, 1000.0, 1.0);  // the base is 1 m by 1 m, whose border is a part of a cell
    const double t = transmittance(1.0, 1.0, kGlassIndex);
    // At the very rim, and on the apex's edge, the back faces are another texel's.
    EXPECT_NEAR(frame.watts(kAccountInternalReflectionLimit), t * emitted, 2e-2 * emitted);
    EXPECT_LT(frame.watts(kAccountArrived), 2e-2 * emitted);
    frame.expectBalance();
}

// A mirror below half of a slab: what has been bent before is not followed, but known.
TEST(LightThatHasBeenBentBefore, IsInTheLedger) {
    if (lacksExactTracer()) GTEST_SKIP() << "the build has no Embree";
    const scene::Scene scene = makeScene(
        kAbove, sun({0, -1, 0}) + object("slab", "box", "glass", {0, 0, 0}, "size = [2, 0.2, 2]") +
                    object("half", "plane", "mirror", {-0.5, -0.5, 0}, "size = [1, 2]") +
                    floorBelow());
    const MapFrame frame = render(scene, {{"trace", "raytraced"}, {"specular.bounces", "4"}});
    const double t = transmittance(1.0, 1.0, kGlassIndex);
    const double emitted = 4000.0;
    EXPECT_NEAR(frame.watts(kAccountEmitted), emitted, 1e-5 * emitted);
    EXPECT_NEAR(frame.watts(kAccountBounceLimit), 0.5 * t * t * emitted, 1e-5 * emitted);
    EXPECT_NEAR(frame.watts(kAccountArrived), 0.5 * t * t * emitted, 1e-5 * emitted);
    frame.expectBalance();
}

}  // namespace
}  // namespace kaustik::test
