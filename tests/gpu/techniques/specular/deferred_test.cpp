// SPDX-License-Identifier: MIT
// specular.deferred against closed forms and exact rays: slabs and balls one behind the other, what
// lies between them, beams through both, and bodies that are not kept (WN09, section 3.1.1).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/gpu/techniques/balls_of_glass.h"
#include "tests/gpu/techniques/caustic_map_frame.h"
#include "tests/gpu/techniques/smooth_tracer.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using namespace transport;
using glm::dvec3;

constexpr int kSide = 1024;  // of the view of fronts and backs
const CameraText kAside{{0.0, 3.0, 7.0}, {0.0, 0.0, 0.0}, 50.0, 0.01};

MapFrame render(const scene::Scene& scene, const Settings& more, bool hasBeams = false,
                const std::string& photons = "96x96") {
    Settings settings = {{"specular", "deferred"},
                         {"emit.photons", photons},
                         {"reconstruct.map_covers", "scene"},
                         {"specular.deferred.distance", "search"},
                         {"specular.deferred.size", std::to_string(kSide)}};
    settings.insert(settings.end(), more.begin(), more.end());
    return {scene, "caustic_map", settings, hasBeams};
}

// Three plane-parallel slabs, the light's rays 40° off their normals.
class DeferredSlabs : public ::testing::Test {
  protected:
    const double angle = glm::radians(40.0);
    const dvec3 direction{std::sin(angle) * std::cos(0.4), -std::cos(angle),
                          std::sin(angle) * std::sin(0.4)};
    const std::vector<double> thickness{0.3, 0.2, 0.1};
    const std::vector<double> height{1.2, 0.4, -0.3};  // of their middles
    [[nodiscard]] scene::Scene scene() const {
        std::string slabs;
        for (std::size_t i = 0; i < height.size(); ++i) {
            slabs += object(fmt::format("slab {}", i), "box", "glass", {0, height[i], 0},
                            fmt::format("size = [5, {}, 5]", number(thickness[i])));
        }
        return makeScene(kAside, sun(direction) + slabs + floorBelow());
    }
};

TEST_F(DeferredSlabs, ShiftLightByTheSumOfTheirShiftsAndKeepItsDirection) {
    const scene::Scene slabs = scene();
    const double inside = std::asin(std::sin(angle) / kGlassIndex);
    for (const char* incidence : {"ray", "light"}) {
        for (std::size_t layers = 1; layers <= thickness.size(); ++layers) {
            SCOPED_TRACE(fmt::format("{} of {}", layers, incidence));
            const MapFrame frame =
                render(slabs, {{"specular.deferred.incidence", incidence},
                               {"specular.deferred.layers", std::to_string(layers)}});
            double shift = 0.0;
            for (std::size_t i = 0; i < layers; ++i)
                shift += thickness[i] * std::sin(angle - inside) / std::cos(inside);
            const double t = transmittance(std::cos(angle), 1.0, kGlassIndex);
            const double bottom = height[layers - 1] - 0.5 * thickness[layers - 1];
            double sum = 0.0;
            int judged = 0;
            for (const MapPhoton& photon : frame.photons()) {
                const dvec3 end = photon.entry + direction * (2.0 / std::cos(angle));
                if (photon.fate != kFateInFlight || photon.entry.y < 1.3499 ||
                    std::max({std::abs(photon.entry.x), std::abs(photon.entry.z), std::abs(end.x),
                              std::abs(end.z)}) > 2.4)
                    continue;
                // Positions and directions are 32-bit, some metres from the eye.
                ASSERT_LT(glm::length(photon.direction - direction), 1e-5);
                // A texel of the backs is known at its middle: 8 mm, and as much in depth at 40°.
                ASSERT_NEAR(photon.position.y, bottom, 0.01);
                ASSERT_NEAR(photon.flux.g / photon.entryFlux.g / std::pow(t, 2.0 * double(layers)),
                            1.0, 1e-4);
                const dvec3 way = photon.position - photon.entry;
                sum += glm::length(way - glm::dot(way, direction) * direction);
                ++judged;
            }
            ASSERT_GT(judged, 300);
            EXPECT_NEAR(sum / judged, shift, 2e-3 * double(layers));
            frame.expectBalance();
        }
    }
}

// Two balls, the second one off the first one's axis, in its converging light.
class DeferredBalls : public ::testing::Test {
  protected:
    const dvec3 direction = glm::normalize(dvec3(0.3, -1.0, 0.2));
    const dvec3 first{-0.1, 1.2, 0.0};
    const dvec3 second{0.2, 0.1, 0.2};
    const double radius = 0.5;
    const double secondRadius = 0.4;
    [[nodiscard]] scene::Scene scene(const std::string& more = "") const {
        return makeScene(kAside, sun(direction) + ballAt("first", first, radius) +
                                     ballAt("second", second, secondRadius) + more + floorBelow());
    }
    [[nodiscard]] SmoothScene smooth() const {
        SmoothScene balls = smoothBall(first, radius, kGlassIndex);
        const SmoothScene other = smoothBall(second, secondRadius, kGlassIndex);
        balls.insert(balls.end(), other.begin(), other.end());
        return balls;
    }
    [[nodiscard]] std::vector<SmoothHit> follow(const dvec3& entry) const {
        return followPath(smooth(), {entry - 0.3 * direction, direction},
                          {false, false, false, false});
    }
    [[nodiscard]] bool isOnFirst(const dvec3& point) const {
        return std::abs(glm::length(point - first) - radius) < 0.02;
    }
    [[nodiscard]] bool isOnSecond(const dvec3& point) const {
        return std::abs(glm::length(point - second) - secondRadius) < 0.02;
    }

    struct Errors {
        std::vector<double> degrees;  // of directions beyond the last interface
        int exact = 0;                // photons of which the exact ray goes through both balls
        int both = 0;                 // of these, those that do
        [[nodiscard]] double median() const { return medianOf(degrees); }
    };
    // `interfaces`: 2 or 4, after which directions are compared.
    [[nodiscard]] Errors errorsOf(const MapFrame& frame, std::size_t interfaces) const {
        Errors errors;
        for (const MapPhoton& photon : frame.photons()) {
            if (photon.fate != kFateInFlight || !isOnFirst(photon.entry)) continue;
            // Beyond 0.9 radii the light sees the ball's sides nearly edge-on.
            if (glm::length(glm::cross(photon.entry - first, direction)) > 0.9 * radius) continue;
            const std::vector<SmoothHit> own = follow(photon.entry);
            if (own.size() != 4) continue;
            ++errors.exact;
            const bool isThroughBoth = isOnSecond(photon.position);
            if (isThroughBoth != (interfaces == 4)) continue;
            ++errors.both;
            errors.degrees.push_back(
                degreesBetween(photon.direction, own[interfaces - 1].next.direction));
        }
        return errors;
    }
};

TEST_F(DeferredBalls, SendLightOnByItsOwnDirectionAsExactRaysGo) {
    const scene::Scene balls = scene();
    const MapFrame one = render(balls, {{"specular.deferred.layers", "1"}});
    const MapFrame two = render(balls, {});
    const MapFrame asPublished = render(balls, {{"specular.deferred.incidence", "light"}});
    const Errors afterOne = errorsOf(one, 2);
    const Errors afterTwo = errorsOf(two, 4);
    const Errors published = errorsOf(asPublished, 4);
    const std::string said = fmt::format(
        "median angle error: {:.4f}° beyond interface 2, {:.4f}° beyond interface 4 by the ray's "
        "direction, {:.4f}° by the light's; {} of {} photons meet both balls",
        afterOne.median(), afterTwo.median(), published.median(), afterTwo.both, afterTwo.exact);
    RecordProperty("angles", said);
    ASSERT_GT(afterTwo.exact, 1000) << said;
    // Edges of the balls are a 640th of their circumference, and texels a thousandth of both.
    EXPECT_LT(afterOne.median(), 0.2) << said;
    EXPECT_LT(afterTwo.median(), 0.5) << said;
    EXPECT_GT(published.median(), 10.0 * afterTwo.median()) << said;
    EXPECT_GT(afterTwo.both, 0.98 * afterTwo.exact) << said;
    for (const MapFrame* frame : {&one, &two, &asPublished})
        frame->expectBalance();
}

TEST_F(DeferredBalls, LoseAtFourInterfacesWhatFresnelSays) {
    const scene::Scene balls = scene();
    const MapFrame frame = render(balls, {});
    std::vector<double> errors;
    for (const MapPhoton& photon : frame.photons()) {
        if (photon.fate != kFateInFlight || !isOnFirst(photon.entry)) continue;
        const std::vector<SmoothHit> own = follow(photon.entry);
        if (own.size() != 4 || !isOnSecond(photon.position)) continue;
        double left = 1.0;
        for (std::size_t i = 0; i < 4; ++i) {
            // The smaller cosine is that in the air.
            left *= transmittance(own[i].cosine, 1.0, kGlassIndex);
        }
        errors.push_back(std::abs(photon.flux.g / (photon.entryFlux.g * left) - 1.0));
    }
    ASSERT_GT(errors.size(), 1000U);
    EXPECT_LT(medianOf(errors), 2e-3);  // by directions that are a tenth of a degree off
}

TEST_F(DeferredBalls, CarryBeamsThroughAllInterfaces) {
    const scene::Scene balls = scene();
    const MapFrame frame = render(balls, {{"reconstruct", "beams"}}, true);
    // Beyond the second ball, m.
    const double distance = 0.7;
    // Area of the beam of a square of side `step` around where a photon comes in.
    const double step = 1e-4;
    const dvec3 across = glm::normalize(glm::cross(direction, dvec3(0, 0, 1)));
    const dvec3 along = glm::cross(direction, across);
    std::vector<double> ratios;
    for (const MapPhoton& photon : frame.photons()) {
        if (photon.fate != kFateInFlight || !isOnFirst(photon.entry) ||
            !isOnSecond(photon.position))
            continue;
        if (glm::length(glm::cross(photon.entry - first, direction)) > 0.6 * radius) continue;
        std::vector<Ray> rays;
        for (const dvec3& offset : {dvec3(0.0), step * across, step * along}) {
            const std::vector<SmoothHit> own = follow(photon.entry + offset);
            if (own.size() == 4) rays.push_back(own[3].next);
        }
        if (rays.size() != 3) continue;
        // On the plane across the photon's own ray.
        const auto onPlane = [&](const Ray& ray) {
            const dvec3 point = rays[0].origin + distance * rays[0].direction;
            const double t = glm::dot(point - ray.origin, rays[0].direction) /
                             glm::dot(ray.direction, rays[0].direction);
            return ray.origin + t * ray.direction - point;
        };
        const double area = glm::length(glm::cross(onPlane(rays[1]), onPlane(rays[2])));
        const double cell = photon.entryFlux.g / 1000.0;  // m², of a sun of 1000 W/m²
        const double width = photon.widthAfter(distance);
        const double expected = area / (step * step) * cell;
        if (expected < 0.05 * cell) continue;  // near a caustic's fold
        ratios.push_back(width * width / expected);
    }
    ASSERT_GT(ratios.size(), 300U);
    std::vector<double> errors;
    for (const double ratio : ratios)
        errors.push_back(std::abs(ratio - 1.0));
    EXPECT_NEAR(medianOf(ratios), 1.0, 0.03);
    // Curvatures are differences of normals that are interpolated, twice in each ball.
    EXPECT_LT(medianOf(errors), 0.1);
}

TEST_F(DeferredBalls, AreHiddenByWhatIsOpaqueBetweenThem) {
    const scene::Scene parted =
        scene(object("wall", "plane", "grey", {0, 0.6, 0}, "size = [4, 4]"));
    const MapFrame frame = render(parted, {});
    int judged = 0;
    for (const MapPhoton& photon : frame.photons()) {
        if (photon.fate != kFateInFlight) continue;
        ++judged;
        EXPECT_GT(photon.position.y, 0.6);
    }
    EXPECT_GT(judged, 1000);
    frame.expectBalance();
}

TEST_F(DeferredBalls, AreDrawnOnceToTheSameBitsAsTwice) {
    const scene::Scene balls = scene();
    const std::vector<std::string> buffers = {"light.body_depth", "light.body_surface",
                                              "light.body_shape"};
    std::vector<std::vector<Texels>> read;
    for (const char* geometry : {"once", "twice"}) {
        const Frame frame(balls, 100, 75,
                          {{"specular", "deferred"},
                           {"reconstruct", "beams"},
                           {"specular.deferred.size", "512"},
                           {"specular.deferred.geometry", geometry}},
                          buffers, false, "caustic_map");
        read.emplace_back();
        for (const std::string& buffer : buffers) {
            // Of two bodies, and of what is opaque.
            for (int layer = 0; layer < 5; ++layer)
                read.back().push_back(frame.read(buffer, layer));
        }
    }
    for (std::size_t i = 0; i < read[0].size(); ++i) {
        EXPECT_EQ(read[0][i].values, read[1][i].values) << buffers[i / 5] << ", layer " << i % 5;
        // What is opaque here is flat: its normals do not turn.
        const bool isFlat = i == read[0].size() - 1;
        EXPECT_EQ(read[0][i].sum() == 0.0, isFlat) << buffers[i / 5] << ", layer " << i % 5;
    }
}

TEST(DeferredBall, AloneIsThatOfTwoInterfaces) {
    const scene::Scene ball =
        makeScene(kAside, sun(glm::normalize(dvec3(0.3, -1.0, 0.2))) +
                              ballAt("ball", {0.0, 0.3, 0.0}, 0.5) + floorBelow());
    for (const char* distance : {"estimates", "search"}) {
        const MapFrame deferred = render(ball, {{"specular.deferred.distance", distance}});
        const MapFrame before(ball, "caustic_map",
                              {{"emit.photons", "96x96"},
                               {"reconstruct.map_covers", "scene"},
                               {"specular.two_interfaces.distance", distance},
                               {"specular.two_interfaces.size", std::to_string(kSide)}});
        const std::vector<MapPhoton> ours = deferred.photons();
        const std::vector<MapPhoton> theirs = before.photons();
        ASSERT_EQ(ours.size(), theirs.size());
        std::size_t different = 0;
        for (std::size_t i = 0; i < ours.size(); ++i) {
            const bool isSame = ours[i].fate == theirs[i].fate &&
                                glm::length(ours[i].position - theirs[i].position) < 1e-6 &&
                                (ours[i].fate != kFateInFlight ||
                                 glm::length(ours[i].direction - theirs[i].direction) < 1e-6);
            different += isSame ? 0 : 1;
        }
        // Where two back faces are equally far a device may keep either: another rounding of depth.
        EXPECT_LE(different, ours.size() / 1000);
        deferred.expectBalance();
    }
}

// A third ball next to the first two, farther away and lit by itself.
TEST(DeferredBodies, BeyondThoseKeptAreNamedAndInTheLedger) {
    const dvec3 direction(0.0, -1.0, 0.0);
    const double radius = 0.4;
    const scene::Scene scene =
        makeScene(kAside, sun(direction) + ballAt("upper", {0, 1.5, 0}, 0.5) +
                              ballAt("lower", {0, 0.3, 0}, 0.5) +
                              ballAt("aside", {2.0, -1.0, 0}, radius) + floorBelow());
    const MapFrame all = render(scene, {});
    const MapFrame two = render(scene, {{"specular.deferred.layers", "2"}});
    const auto names = [](const MapFrame& frame) {
        return std::any_of(frame.renderer().warnings().begin(), frame.renderer().warnings().end(),
                           [](const std::string& warning) {
                               return warning.find("'aside'") != std::string::npos &&
                                      warning.find("specular.deferred.layers") != std::string::npos;
                           });
    };
    EXPECT_FALSE(names(all));
    EXPECT_TRUE(names(two));
    all.expectBalance();
    two.expectBalance();
    // Of what the other two send, all but none comes to it.
    EXPECT_LT(all.watts(kAccountBounceLimit), 1e-3 * all.watts(kAccountEmitted));
    EXPECT_EQ(two.watts(kAccountEmitted), all.watts(kAccountEmitted));
    // What enters it: E π r² times the mean of T over the disc.
    double entering = 0.0;
    const int rings = 1000;
    for (int i = 0; i < rings; ++i) {
        const double height = (i + 0.5) / rings;
        entering += 2.0 * height / rings *
                    transmittance(std::sqrt(1.0 - height * height), 1.0, kGlassIndex);
    }
    entering *= 1000.0 * std::numbers::pi * radius * radius;
    // Its rim is a row of cells that are partly on it.
    EXPECT_NEAR(two.watts(kAccountBounceLimit), entering, 0.01 * entering);
    // The light of the others is what it was.
    const double arrived = all.watts(kAccountArrived) - two.watts(kAccountArrived);
    EXPECT_GT(arrived, 0.8 * entering);
    EXPECT_LT(arrived, entering);
}

// Most of the second ball lies in the box of the first, which alone is kept: what comes to its own
// front is not taken for the first one's.
TEST(DeferredBodies, BeyondThoseKeptAreToldApartWhereBoxesOverlap) {
    const auto rendered = [](const std::string& balls, const char* layers) {
        const scene::Scene scene = makeScene(kAside, sun({0, -1, 0}) + balls + floorBelow());
        return render(scene, {{"specular.deferred.layers", layers}});
    };
    const std::string first = ballAt("first", {0, 1.5, 0}, 1.0);
    const std::string both = first + ballAt("second", {0.85, 1.9, 0.85}, 0.2);
    const MapFrame alone = rendered(first, "1");
    const MapFrame all = rendered(both, "2");
    const MapFrame kept = rendered(both, "1");
    kept.expectBalance();
    // What comes to a ball from below comes to none of the fronts that the sun sees.
    const double fromBelow = all.watts(kAccountBounceLimit);
    EXPECT_LT(fromBelow, 0.01 * all.watts(kAccountEmitted));
    // It reflects less than a tenth, and is the one that light comes to next to the first.
    const double onSecond = kept.watts(kAccountEmitted) - alone.watts(kAccountEmitted);
    EXPECT_GT(onSecond, 0.03 * kept.watts(kAccountEmitted));
    EXPECT_GT(kept.watts(kAccountBounceLimit), 0.85 * onSecond);
    EXPECT_LT(kept.watts(kAccountBounceLimit), onSecond + fromBelow);
    EXPECT_LT(kept.watts(kAccountInternalReflectionLimit), 1e-3 * kept.watts(kAccountEmitted));
}

// The third ball's box overlaps that around the first two, the fourth one's box that of the second,
// without meeting it, and the fifth meets the second.
TEST(DeferredBodies, AreThoseThatMeet) {
    const std::string three = ballAt("first", {0, 1.5, 0}, 0.4) +
                              ballAt("second", {-0.9, 0.6, 0.9}, 0.4) +
                              ballAt("third", {0.1, 0.5, 0}, 0.4);
    const auto lostInside = [](const std::string& balls, bool isOneBody) {
        const scene::Scene scene = makeScene(kAside, sun({0, -1, 0}) + balls + floorBelow());
        const MapFrame frame = render(scene, {});
        frame.expectBalance();
        bool isMentioned = false;
        for (const std::string& warning : frame.renderer().warnings())
            isMentioned = isMentioned || warning.find("which meet") != std::string::npos;
        EXPECT_EQ(isMentioned, isOneBody);
        return frame.watts(kAccountInternalReflectionLimit) / frame.watts(kAccountEmitted);
    };
    // Light that has entered a ball comes to its back at an angle at which it leaves.
    EXPECT_LT(lostInside(three, false), 1e-3);
    EXPECT_LT(lostInside(three + ballAt("fourth", {-0.5, -0.1, 0.7}, 0.4), false), 1e-3);
    EXPECT_GT(lostInside(three + ballAt("fifth", {-0.6, 0.1, 0.8}, 0.4), true), 1e-2);
}

}  // namespace
}  // namespace kaustik::test
