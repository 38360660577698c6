// SPDX-License-Identifier: MIT
// trace.background and gather.project: what photons find in their light's depths, and what of a map
// the eye gets, against closed forms (SP05; WD06; WD08, section 3). A sheet of index 1 lets light
// through as it comes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/stage_harness.h"
#include "tests/gpu/techniques/caustic_map_frame.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using namespace transport;
using glm::dvec3;

const std::string kAir = "[[material]]\nname = \"air\"\ntype = \"dielectric\"\nior = 1\n";
const CameraText kAbove{{0.0, 3.0, 4.0}, {0.0, -0.5, 0.0}, 60.0, 0.01};

std::string lamp(const dvec3& position, double intensity = 1000.0) {
    return fmt::format(
        "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = {}\nintensity = {}\n",
        numbers(position), number(intensity));
}
std::string spot(const dvec3& position, const dvec3& direction, double intensity = 1000.0) {
    return fmt::format(
        "[[light]]\nname = \"spot\"\ntype = \"spot\"\nposition = {}\ndirection = {}\n"
        "intensity = {}\ninner_cone_degrees = 70\nouter_cone_degrees = 75\n",
        numbers(position), numbers(direction), number(intensity));
}
std::string airSheet(double side, double height = 0.0) {
    return kAir + object("sheet", "plane", "air", {0, height, 0},
                         fmt::format("size = [{0}, {0}]", number(side)));
}

// Lights that look at what lies below the origin by a parallel view, a perspective one and a cube.
struct LightCase {
    std::string name;
    std::string text;
    std::function<double(const dvec3&, const dvec3&)> irradiance;  // at a place, by its normal
    int views = 1;
};
double ofLamp(const dvec3& from, const dvec3& place, const dvec3& normal) {
    const dvec3 way = from - place;
    return 1000.0 * glm::dot(normal, way) / std::pow(glm::length(way), 3.0);
}
std::vector<LightCase> lights() {
    const dvec3 along = glm::normalize(dvec3(0.3, -1.0, 0.2));
    const dvec3 high(0.1, 1.5, 0.2);
    const dvec3 low(0.1, 0.3, 0.05);
    return {{"sun", sun(along),
             [along](const dvec3&, const dvec3& n) { return -1000.0 * glm::dot(along, n); }},
            {"spot", spot(high, {0, -1, 0}),
             [high](const dvec3& p, const dvec3& n) { return ofLamp(high, p, n); }},
            {"cube", lamp(low), [low](const dvec3& p, const dvec3& n) { return ofLamp(low, p, n); },
             6}};
}

// Of pixels whose place satisfies `isJudged`: relative to what is expected.
struct Deviation {
    int pixels = 0;
    double worst = 0.0;
    double mean = 0.0;  // with its sign
};
Deviation deviationOf(const numerics::Frame& frame,
                      const std::function<bool(const dvec3&)>& isJudged,
                      const std::function<double(const dvec3&, const dvec3&)>& expected) {
    const Texels receiver = frame.read("eye.receiver");
    const Texels surface = frame.read("eye.receiver_surface");
    const Texels irradiance = frame.causticIrradiance();
    const glm::dmat3 axes = glm::transpose(glm::dmat3(frame.view().worldToView));
    Deviation deviation;
    for (int y = 0; y < receiver.height; ++y) {
        for (int x = 0; x < receiver.width; ++x) {
            const auto depth = double{receiver.at(x, y, 0)};
            if (depth <= 0.0) continue;
            const dvec3 place = frame.worldAt(x, y, depth);
            if (!isJudged(place)) continue;
            const dvec3 normal = axes * surface.rgb(x, y);
            // Of a curved surface that the eye sees edge-on a pixel spans more than its plane
            // tells.
            if (glm::dot(normal, glm::normalize(frame.toWorld({}) - place)) < 0.2) continue;
            const double off = irradiance.rgb(x, y).g / expected(place, normal) - 1.0;
            ++deviation.pixels;
            deviation.worst = std::max(deviation.worst, std::abs(off));
            deviation.mean += off;
        }
    }
    deviation.mean /= std::max(deviation.pixels, 1);
    return deviation;
}

// A slanted floor in a room whose walls a lamp sees all around.
scene::Scene slanted(const LightCase& light) {
    return makeScene(kAbove, light.text + airSheet(2.0) +
                                 object("slope", "plane", "grey", {0, -1, 0},
                                        "size = [3.2, 3.2]\nrotation_degrees = [25, 0, 12]"));
}

class UnderEachLight : public ::testing::TestWithParam<LightCase> {};

TEST_P(UnderEachLight, APhotonHitsAFlatReceiverWhereItsRayMeetsIt) {
    const scene::Scene scene = slanted(GetParam());
    const dvec3 normal(scene.objects[1].toWorld[1]);
    const dvec3 middle(scene.objects[1].toWorld[3]);
    for (const char* steps : {"0", "48"}) {
        for (const char* step : {"plane", "distance"}) {
            SCOPED_TRACE(fmt::format("{} {}", step, steps));
            const MapFrame frame(scene, "caustic_map",
                                 {{"emit.photons", "48x48"},
                                  {"reconstruct.map_size", "512"},
                                  {"reconstruct.map_covers", "scene"},
                                  {"trace.background.step", step},
                                  {"trace.background.steps", steps}});
            EXPECT_EQ(frame.map().on.views->count(), GetParam().views);
            int photons = 0;
            int hits = 0;
            double worst = 0.0;
            for (const MapPhoton& photon : frame.photons()) {
                if (photon.fate != kFateInFlight) continue;
                const double t =
                    glm::dot(normal, middle - photon.position) / glm::dot(normal, photon.direction);
                const dvec3 there = photon.position + t * photon.direction;
                const dvec3 local(glm::inverse(scene.objects[1].toWorld) * glm::dvec4(there, 1.0));
                if (t < 0.0 || std::max(std::abs(local.x), std::abs(local.z)) > 1.5) continue;
                ++photons;
                if (photon.hitFate != kFateReceiver) continue;
                ++hits;
                worst = std::max(worst, glm::distance(photon.hit, there));
            }
            EXPECT_GT(photons, 300);
            EXPECT_EQ(hits, photons);
            // By planes exactly; by distances to within the residual, of texels of 5 m over 256.
            EXPECT_LT(worst, std::string(step) == "plane" ? 1e-4 : 0.08);
            frame.expectBalance();
        }
    }
}

// Of a cube around a lamp a bent ray goes from face to face: it ends where it meets the floor, not
// where a face ends before.
TEST(ABentRay, ThatGoesOnInTheNextFaceHitsAsIfThereWereNoEdge) {
    const dvec3 from(0.1, 0.3, 0.05);
    const scene::Scene scene = makeScene(
        kAbove, lamp(from) + object("sheet", "plane", "water", {0, 0, 0}, "size = [2, 2]") +
                    floorPlane("floor", "grey", 6, {0, -1, 0}));
    const auto faceOf = [&](const dvec3& place) {
        const dvec3 way = glm::abs(place - from);
        return way.x > way.y && way.x > way.z ? 0 : way.z > way.y ? 2 : 1;
    };
    for (const char* steps : {"0", "48"}) {
        SCOPED_TRACE(steps);
        const MapFrame frame(scene, "caustic_map",
                             {{"emit.photons", "96x96"},
                              {"reconstruct.map_size", "64"},
                              {"reconstruct.map_covers", "scene"},
                              {"trace.background.steps", steps}});
        ASSERT_EQ(frame.map().on.views->count(), 6);
        int changes = 0;
        double worst = 0.0;
        for (const MapPhoton& photon : frame.photons()) {
            if (photon.fate != kFateInFlight || photon.hitFate != kFateReceiver) continue;
            const double t = (-1.0 - photon.position.y) / photon.direction.y;
            const dvec3 there = photon.position + t * photon.direction;
            changes += faceOf(photon.position) != faceOf(there) ? 1 : 0;
            worst = std::max(worst, glm::distance(photon.hit, there));
        }
        EXPECT_GT(changes, 100);
        EXPECT_LT(worst, 1e-4);
        frame.expectBalance();
    }
}

TEST_P(UnderEachLight, IrradianceIsOverTheAreaOfASlantedReceiver) {
    const scene::Scene scene = slanted(GetParam());
    const MapFrame frame(scene, "caustic_map",
                         {{"emit.photons", "256x256"},
                          {"reconstruct.map_size", "256"},
                          {"reconstruct.map_covers", "scene"}},
                         false, 160, 120);
    const Deviation deviation = deviationOf(
        frame, [](const dvec3& p) { return std::hypot(p.x, p.z) < 0.45; }, GetParam().irradiance);
    EXPECT_GT(deviation.pixels, 200);
    // A texel's middle stands for all of it, and a splat of seven for what changes within it.
    EXPECT_LT(deviation.worst, 0.06);
    EXPECT_LT(std::abs(deviation.mean), 0.015);
}

INSTANTIATE_TEST_SUITE_P(As, UnderEachLight, ::testing::ValuesIn(lights()),
                         [](const auto& tested) { return tested.param.name; });

TEST(TwoLights, AreTheSumOfEachAlone) {
    const std::vector<LightCase> both = lights();
    const auto sceneOf = [](const std::string& text) {
        return makeScene(kAbove,
                         text + airSheet(1.2) + floorPlane("floor", "grey", 5.0, {0, -1, 0}));
    };
    const scene::Scene scenes[3] = {sceneOf(both[0].text), sceneOf(both[1].text),
                                    sceneOf(both[0].text + both[1].text)};
    const Settings settings{{"emit.photons", "96x96"},
                            {"reconstruct.map_size", "128"},
                            {"reconstruct.map_covers", "scene"}};
    std::vector<Texels> pictures;
    for (const scene::Scene& scene : scenes) {
        const MapFrame frame(scene, "caustic_map", settings);
        pictures.push_back(frame.causticIrradiance());
        frame.expectBalance();
    }
    double brightest = 0.0;
    double worst = 0.0;
    for (std::size_t i = 0; i < pictures[0].values.size(); ++i) {
        const double sum = double{pictures[0].values[i]} + double{pictures[1].values[i]};
        brightest = std::max(brightest, sum);
        worst = std::max(worst, std::abs(double{pictures[2].values[i]} - sum));
    }
    EXPECT_GT(brightest, 500.0);
    EXPECT_LT(worst, 1e-5 * brightest);
}

// A ball below the sheet, which the light sees less of towards its rim.
TEST(ACurvedReceiver, HasTheCosineOfTheLight) {
    const scene::Scene scene = makeScene(
        {{0.0, 2.0, 2.5}, {0.0, -0.6, 0.0}, 40.0, 0.01},
        sun({0, -1, 0}) + airSheet(2.0) +
            object("ball", "sphere", "grey", {0, -0.6, 0}, "radius = 0.5\nsegments = 320") +
            floorPlane("floor", "grey", 5.0, {0, -1.2, 0}));
    const MapFrame frame(scene, "caustic_map",
                         {{"emit.photons", "256x256"},
                          {"reconstruct.map_size", "512"},
                          {"reconstruct.map_covers", "scene"}},
                         false, 160, 120);
    const auto isOnTop = [](const dvec3& p) { return p.y > -0.6 + 0.5 * 0.6; };
    const Deviation deviation = deviationOf(
        frame, isOnTop, [](const dvec3&, const dvec3& normal) { return 1000.0 * normal.y; });
    EXPECT_GT(deviation.pixels, 500);
    // Down to a cosine of 0.6.
    EXPECT_LT(deviation.worst, 0.08);
    EXPECT_LT(std::abs(deviation.mean), 0.02);
    frame.expectBalance();
}

// A table over the floor, half below the sheet's light.
TEST(Edges, OfWhatHidesTheFloorDoNotLeak) {
    const double table = 0.5;
    const scene::Scene scene = makeScene(
        {{0.6, 0.9, 2.4}, {0.4, -1.0, 0.0}, 50.0, 0.01},
        sun({0, -1, 0}) + airSheet(2.0) + floorPlane("table", "white", 2.0 * table, {0, -0.3, 0}) +
            floorPlane("floor", "grey", 5.0, {0, -1, 0}));
    const MapFrame frame(scene, "caustic_map",
                         {{"emit.photons", "192x192"},
                          {"reconstruct.map_size", "256"},
                          {"reconstruct.map_covers", "scene"}},
                         false, 200, 150);
    const Texels receiver = frame.read("eye.receiver");
    const Texels irradiance = frame.causticIrradiance();
    const double texel = 5.0 / 256.0;
    int shadowed = 0;
    int lit = 0;
    int rim = 0;
    for (int y = 0; y < receiver.height; ++y) {
        for (int x = 0; x < receiver.width; ++x) {
            const auto depth = double{receiver.at(x, y, 0)};
            if (depth <= 0.0) continue;
            const dvec3 place = frame.worldAt(x, y, depth);
            const double out = std::max(std::abs(place.x), std::abs(place.z)) - table;
            const double green = irradiance.rgb(x, y).g;
            if (std::abs(place.y + 1.0) < 1e-3 && out < -1.5 * texel) {
                ++shadowed;
                EXPECT_EQ(green, 0.0) << place.x << " " << place.z;
            } else if (std::abs(place.y + 1.0) < 1e-3 && out > 1.5 * texel && out < 0.35) {
                ++lit;
                EXPECT_NEAR(green, 1000.0, 450.0) << place.x << " " << place.z;
            } else if (std::abs(place.y + 0.3) < 1e-3 && out > -4.0 * texel && out < -texel) {
                // Light of the table's rim stays on the table.
                ++rim;
                EXPECT_GT(green, 700.0) << place.x << " " << place.z;
            }
        }
    }
    EXPECT_GT(shadowed, 100);
    EXPECT_GT(lit, 500);
    EXPECT_GT(rim, 50);
    frame.expectBalance();
}

class Background : public ::testing::Test {
  protected:
    Traced trace(const scene::Scene& scene, const std::vector<StagePhoton>& photons,
                 const Settings& more = {}) {
        Settings settings{{"reconstruct.map_size", "256"}, {"reconstruct.map_covers", "scene"}};
        settings.insert(settings.end(), more.begin(), more.end());
        return tracePhotons(lab_, lab_.choose(TraceStage::name, "background"), scene, photons,
                            settings);
    }
    static StagePhoton from(const dvec3& position, const dvec3& to) {
        StagePhoton photon;
        photon.position = position;
        photon.direction = glm::normalize(to - position);
        return photon;
    }

  private:
    Registry registry_ = registerAll();
    Suite suite_;
    Lab lab_{context(), registry_, suite_};
};

TEST_F(Background, BooksWhatIsHiddenOrBesideItsMap) {
    const scene::Scene scene =
        makeScene(kAbove, sun({0, -1, 0}) + floorPlane("table", "white", 1.0, {0, -0.3, 0}) +
                              floorPlane("floor", "grey", 4.0, {0, -1, 0}));
    std::vector<StagePhoton> photons;
    photons.push_back(from({1.0, 0.5, 0.0}, {1.2, -1.0, 0.3}));  // hit
    for (int i = 0; i < 2; ++i)                                  // below the table
        photons.push_back(from({1.0, -0.5, 0.02 * i}, {0.0, -1.0, 0.1}));
    for (int i = 0; i < 4; ++i)  // next to the floor
        photons.push_back(from({1.0, 0.5, 0.02 * i}, {4.0, -0.5, 0.1}));
    const Traced traced = trace(scene, photons);
    EXPECT_EQ(traced.hitCount(), 1U);
    EXPECT_NEAR(traced.ledger.watts[kAccountHiddenInMap], 2.0, 1e-5);
    EXPECT_NEAR(traced.ledger.watts[kAccountOutsideMap], 4.0, 1e-5);
}

// Cases A8 and A9 in the light's view: a board that rays pass behind, and one that they cross
// between two steps.
TEST_F(Background, PassesBehindWhatItDoesNotTouch) {
    const scene::Scene scene =
        makeScene(kAbove, sun({0, -1, 0}) + floorPlane("table", "white", 0.3, {0, 0.5, 0}) +
                              floorPlane("floor", "grey", 4.0, {0, -1, 0}));
    std::vector<StagePhoton> photons;
    for (int i = 0; i < 40; ++i) {
        const double z = -0.3 + 0.015 * i;
        photons.push_back(from({-1.0, -0.3, z}, {1.0, -1.0, z}));  // in the table's shadow
    }
    const Traced traced = trace(scene, photons);
    for (std::size_t i = 0; i < photons.size(); ++i) {
        ASSERT_TRUE(traced.hits[i].isHit());
        EXPECT_LT(glm::distance(traced.hits[i].position, dvec3(1.0, -1.0, photons[i].position.z)),
                  1e-4);
    }
}

TEST_F(Background, FindsAThinBoardBetweenTwoSteps) {
    // 4 mm thick: no step ends within it.
    const scene::Scene scene =
        makeScene(kAbove, sun({0, -1, 0}) +
                              object("shelf", "box", "white", {0, 0, 0}, "size = [0.4, 0.004, 1]") +
                              floorPlane("floor", "grey", 4.0, {0, -1, 0}));
    std::vector<StagePhoton> photons;
    std::vector<dvec3> expected;
    for (int i = 0; i < 40; ++i) {
        const dvec3 place(-0.18 + 0.009 * i, 0.002, 0.3 * std::sin(3.0 * i));
        photons.push_back(from(place + dvec3(0.1, 2.0, 0.05), place));
        expected.push_back(place);
    }
    const Traced traced = trace(scene, photons);
    for (std::size_t i = 0; i < photons.size(); ++i) {
        ASSERT_TRUE(traced.hits[i].isHit()) << i;
        EXPECT_LT(glm::distance(traced.hits[i].position, expected[i]), 1e-4) << i;
    }
}

// The thin rod of the scene "blocker", in each kind of view: hits lie on the rod or on the floor. A
// texel that sees the rod's side nearly edge-on, as under the sun, says no more of how deep it lies
// than the residual allows: view.glsl's depthMargin, five footprints.
TEST_F(Background, FindsNothingBetweenTheSidesOfADepthEdge) {
    for (const LightCase& light : lights()) {
        SCOPED_TRACE(light.name);
        const scene::Scene scene = makeScene(
            kAbove, light.text +
                        object("rod", "box", "white", {0, -0.5, 0}, "size = [0.04, 0.04, 2]") +
                        floorPlane("floor", "grey", 4.0, {0, -1, 0}));
        std::vector<StagePhoton> photons;
        for (int i = 0; i < 2000; ++i) {
            const double u = std::fmod(0.618034 * i, 1.0);
            const double v = (i + 0.5) / 2000.0;
            photons.push_back(from({-0.6 + 0.2 * v, -0.1, 0.8 * u - 0.4},
                                   {-0.9 + 1.8 * v, -1.0, 0.9 * std::sin(11.0 * i)}));
        }
        const Traced traced = trace(scene, photons);
        // Of the map, m: 4 m by 256 texels, or at a depth of 1 m by the 128 of a face.
        const double texel = 4.5 / 256.0 * (light.views > 1 ? 1.5 : 1.0);
        int onRod = 0;
        int near = 0;
        int elsewhere = 0;
        for (const StageHit& hit : traced.hits) {
            if (!hit.isHit() || std::abs(hit.position.y + 1.0) < 1e-3) continue;
            const dvec3 off = glm::abs(hit.position - dvec3(0, -0.5, 0)) - dvec3(0.02, 0.02, 1.0);
            const double across = std::max(off.x, off.z);
            const bool isOnRod = std::max(across, off.y) < texel;
            (isOnRod ? onRod : across < texel && off.y < 6.0 * texel ? near : elsewhere)++;
        }
        EXPECT_GT(traced.hitCount(), 1000U);
        EXPECT_GT(onRod, 5);
        EXPECT_EQ(elsewhere, 0);
        EXPECT_LT(near, 100);
        double sum = double(traced.hitCount());
        for (const std::uint32_t account :
             {kAccountHiddenInMap, kAccountOutsideMap, kAccountUnresolved, kAccountMissedByTracer})
            sum += traced.ledger.watts[account];
        EXPECT_NEAR(sum, 2000.0, 1e-3);
    }
}

// Glossy: all of a texel's light comes from its mean direction, which for one direction is it.
TEST(AGlossyReceiver, GetsWhatStoringOnTheScreenGives) {
    const scene::Scene scene =
        makeScene({{0.0, 1.2, 2.2}, {0.0, -1.0, -0.2}, 45.0, 0.01},
                  sun({0.0, -1.0, -0.5}) + airSheet(2.0, 0.6) +
                      "[[material]]\nname = \"varnish\"\ntype = \"glossy\"\nalbedo = 0.3\n"
                      "specular = 0.4\nexponent = 20\n" +
                      floorPlane("table", "varnish", 4.0, {0, -1, 0}));
    const auto render = [&](const char* space, const char* gather) {
        const numerics::FrameRequest request{160,
                                             120,
                                             {{"emit.photons", "192x192"},
                                              {"reconstruct.map_size", "256"},
                                              {"reconstruct.map_covers", "scene"},
                                              {"reconstruct.space", space},
                                              {"gather", gather}},
                                             {"caustic.radiance", "eye.receiver"}};
        static const Registry registry = registerAll();
        return numerics::Frame(context(), registry, scene, registry.findTechnique("caustic_map"),
                               request);
    };
    const numerics::Frame map = render("light", "project");
    const numerics::Frame screen = render("screen", "screen");
    const Texels a = map.read("caustic.radiance");
    const Texels b = screen.read("caustic.radiance");
    const Texels receiver = map.read("eye.receiver");
    int judged = 0;
    double worst = 0.0;
    double sum = 0.0;
    double brightest = 0.0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const auto depth = double{receiver.at(x, y, 0)};
            if (depth <= 0.0) continue;
            const dvec3 place = map.worldAt(x, y, depth);
            if (std::abs(place.x) > 0.7 || std::abs(place.z + 0.8) > 0.7) continue;
            ++judged;
            const double ratio = a.rgb(x, y).g / b.rgb(x, y).g;
            worst = std::max(worst, std::abs(ratio - 1.0));
            sum += ratio;
            brightest = std::max(brightest, b.rgb(x, y).g);
        }
    }
    EXPECT_GT(judged, 1000);
    EXPECT_GT(brightest, 10.0);
    // Splats of seven pixels on the screen ripple by the photons that fall on them, and the lobe
    // changes within them.
    EXPECT_LT(worst, 0.25);
    EXPECT_NEAR(sum / judged, 1.0, 0.02);
}

}  // namespace
}  // namespace kaustik::test
