// SPDX-License-Identifier: MIT
// A1 to A3, A6 to A11 and B17 for every node that answers `trace`: photons made up one by one, in
// scenes of planes and boxes, against where a ray in double hits them.
#include <algorithm>
#include <cmath>

#include "framework/numerics/cases/common_cases.h"
#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/stage_harness.h"
#include "framework/transport/watts.h"

namespace kaustik::numerics {
namespace {

using namespace transport;

// The camera of most cases: 128 x 128 pixels of 60 degrees at the origin.
constexpr double kFootprintPerMeter = 2.0 * 0.57735026918962576 / 128.0;

// The hit on a plane lies where the ray hits the plane that the pixel holds.
const Tolerance kOnPlane{2e-5,
                         "t comes from a 32-bit depth of some 10 m (1e-6 m) and a 32-bit "
                         "normal, along rays that close in on the plane with a cosine of 0.1 "
                         "or more"};

StagePhoton photon(const glm::dvec3& position, const glm::dvec3& direction) {
    StagePhoton result;
    result.position = position;
    result.direction = glm::normalize(direction);
    return result;
}

// Along the ray to the plane n·p = d.
double exactDistance(const StagePhoton& photon, const glm::dvec3& normal, double d) {
    return (d - glm::dot(normal, photon.position)) / glm::dot(normal, photon.direction);
}

double totalFlux(const std::vector<StagePhoton>& photons) {
    double total = 0.0;
    for (const StagePhoton& p : photons)
        total += wattsOf(p.fluxWatts);
    return total;
}

// Rows that say that every photon hits the plane n·p = d, of this material, where it should.
void expectHits(Lab& lab, const std::string& subject, const std::string& what,
                const std::vector<StagePhoton>& photons, const Traced& traced,
                const glm::dvec3& normal, double d, std::uint32_t material,
                const Tolerance& tolerance = kOnPlane) {
    double worst = 0.0;
    std::size_t right = 0;
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const StageHit& hit = traced.hits[i];
        if (!hit.isHit() || hit.material != material) continue;
        ++right;
        worst =
            std::max(worst, std::abs(hit.distanceMeters - exactDistance(photons[i], normal, d)));
    }
    lab.expect(subject, "hits of " + what, static_cast<double>(photons.size()),
               static_cast<double>(right), kExactly);
    lab.expectDeviation(subject, "worst error of t of " + what + ", m", worst, tolerance);
}

const Tolerance kLedger{1e-5,
                        "the ledger's quantum is 2^-60 of the light; photons hold 32-bit flux"};

// Rows that say that no photon hits anything, and that these accounts hold all of their flux.
void expectNoHits(Lab& lab, const std::string& subject, const std::string& what,
                  const std::vector<StagePhoton>& photons, const Traced& traced,
                  const std::vector<unsigned>& accounts, const std::string& names) {
    double counted = 0.0;
    for (const unsigned account : accounts)
        counted += traced.ledger.watts[account];
    lab.expect(subject, "hits of " + what, 0.0, static_cast<double>(traced.hitCount()), kExactly);
    lab.expect(subject, "flux of " + what + " counted as " + names + ", share", 1.0,
               counted / totalFlux(photons), kLedger);
}

// The same of what the eye does not see; of a tracer that sees it all the same, rows that say that
// all hit. The scenes are of flat receivers, which their light sees.
void expectCounted(Lab& lab, const Lab::Choice& tracer, const std::string& what,
                   const std::vector<StagePhoton>& photons, const Traced& traced,
                   const std::vector<unsigned>& accounts, const std::string& names) {
    if (lab.tracerReach(tracer) != TracerReach::eyeLayers) {
        lab.expect(tracer.subject, "hits of " + what + ", which it sees",
                   static_cast<double>(photons.size()), static_cast<double>(traced.hitCount()),
                   kExactly);
        return;
    }
    expectNoHits(lab, tracer.subject, what, photons, traced, accounts, names);
}

// Flux that is in the ledger needs a light for its quantum, and a tracer in a light's depths one
// that sees what is to be hit: the sun sees no wall that faces the eye, a lamp next to the eye all
// around it.
const std::string kSun = sun({0.0, -1.0, 0.0});
const std::string kLampAtTheEye =
    "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = [0.02, 0.03, 0]\nintensity = 1000\n";
// Of what the light's view of receivers does not show.
const std::vector<unsigned> kUnseenByLight = {kAccountHiddenInMap, kAccountOutsideMap,
                                              kAccountUnresolved};

void nearPlaneAndBehindTheEye(Lab& lab) {
    const scene::Scene scene =
        makeScene({}, kLampAtTheEye + facingPlane("wall", "grey", 60, {0, 0, -10}) +
                          facingPlane("wall behind", "grey", 60, {0, 0, 10}));
    std::vector<StagePhoton> fromBehind;
    std::vector<StagePhoton> toBehind;
    for (int i = 0; i < 64; ++i) {
        const double x = 0.05 * (i % 8 - 3.6);
        const double y = 0.05 * (i / 8 - 3.4);
        fromBehind.push_back(
            photon({x, y, 3.0}, glm::dvec3(8.0 * x, -6.0 * y, -10.0) - glm::dvec3(x, y, 3.0)));
        toBehind.push_back(photon({10.0 * x, 10.0 * y, -5.0}, {-2.0 * x, -2.0 * y, 1.0}));
    }
    for (const Lab::Choice& tracer : lab.each<TraceStage>()) {
        expectHits(lab, tracer.subject, "rays that come from behind the eye", fromBehind,
                   tracePhotons(lab, tracer, scene, fromBehind), {0, 0, 1}, -10.0, kGrey);
        expectCounted(lab, tracer, "rays that go behind it", toBehind,
                      tracePhotons(lab, tracer, scene, toBehind),
                      {kAccountBehindEye, kAccountOffScreen}, "behind the eye or off screen");
    }
}

void whollyBehindTheEye(Lab& lab) {
    const scene::Scene scene =
        makeScene({}, kLampAtTheEye + facingPlane("wall", "grey", 60, {0, 0, -10}) +
                          facingPlane("wall behind", "grey", 60, {0, 0, 10}));
    std::vector<StagePhoton> photons;
    for (int i = 0; i < 64; ++i)
        photons.push_back(photon({0.3 * (i % 8) - 1.0, 0.3 * (i / 8) - 1.0, 1.0}, {0.1, 0.2, 1.0}));
    for (const Lab::Choice& tracer : lab.each<TraceStage>()) {
        expectCounted(lab, tracer, "rays behind the eye", photons,
                      tracePhotons(lab, tracer, scene, photons), {kAccountBehindEye},
                      "behind the eye");
    }
}

void alongTheViewDirection(Lab& lab) {
    const scene::Scene scene =
        makeScene({}, kLampAtTheEye + facingPlane("wall", "grey", 60, {0, 0, -10}) +
                          facingPlane("plate", "white", 4, {0, 0, -3}));
    std::vector<StagePhoton> parallel;
    std::vector<StagePhoton> away;
    std::vector<StagePhoton> towards;
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 p(0.037 * (i % 10) - 0.2, 0.041 * (i / 10) - 0.2, -1.0);
        parallel.push_back(photon(p, {0, 0, -1}));
        away.push_back(photon(p, p));
        towards.push_back(photon(7.0 * p, -p));
    }
    for (const Lab::Choice& tracer : lab.each<TraceStage>()) {
        expectHits(lab, tracer.subject, "rays parallel to the view direction", parallel,
                   tracePhotons(lab, tracer, scene, parallel), {0, 0, 1}, -3.0, kWhite);
        expectHits(lab, tracer.subject, "rays straight away from the eye", away,
                   tracePhotons(lab, tracer, scene, away), {0, 0, 1}, -3.0, kWhite);
        expectHits(lab, tracer.subject, "rays straight towards the eye", towards,
                   tracePhotons(lab, tracer, scene, towards), {0, 0, 1}, -3.0, kWhite);
    }
}

// A point at this depth on this pixel position, of 128 x 128.
glm::dvec3 at(double pixelX, double pixelY, double depth) {
    const double tangent = 64.0 * kFootprintPerMeter;
    return {(pixelX / 64.0 - 1.0) * tangent * depth, (pixelY / 64.0 - 1.0) * tangent * depth,
            -depth};
}

void diagonalsEdgesAndTies(Lab& lab) {
    const scene::Scene scene =
        makeScene({}, kLampAtTheEye + facingPlane("wall", "grey", 60, {0, 0, -10}));
    std::vector<StagePhoton> photons;
    for (const double start : {20.0, 20.5, 33.25}) {
        for (const double length : {1.0, 7.0, 32.0, 60.0}) {
            for (const auto& [dx, dy] : {std::pair(1.0, 1.0), std::pair(1.0, 0.0),
                                         std::pair(0.0, 1.0), std::pair(1.0, 0.5)}) {
                const glm::dvec3 from = at(start, start, 4.0);
                const glm::dvec3 to = at(start + dx * length, start + dy * length, 10.0);
                photons.push_back(photon(from, to - from));
            }
        }
    }
    for (const Lab::Choice& tracer : lab.each<TraceStage>()) {
        expectHits(lab, tracer.subject, "rays along diagonals and pixel edges", photons,
                   tracePhotons(lab, tracer, scene, photons), {0, 0, 1}, -10.0, kGrey);
    }
}

void offScreenAndBeyondTheLastLayer(Lab& lab) {
    const scene::Scene scene =
        makeScene({}, kLampAtTheEye + facingPlane("1", "grey", 40, {0, 0, -3}) +
                          facingPlane("2", "grey", 40, {0, 0, -4}) +
                          facingPlane("3", "grey", 40, {0, 0, -5}) +
                          facingPlane("4", "grey", 40, {0, 0, -6}));
    std::vector<StagePhoton> leaving;
    std::vector<StagePhoton> hidden;
    for (int i = 0; i < 64; ++i) {
        const double x = 0.1 * (i % 8) - 0.35;
        const double y = 0.1 * (i / 8) - 0.35;
        leaving.push_back(photon({x, y, -2.0}, {4.0, 0.3 * y, -1.0}));
        hidden.push_back(photon({x, y, -5.5}, {0.2, 0.1, -1.0}));
    }
    for (const Lab::Choice& tracer : lab.each<TraceStage>()) {
        expectCounted(
            lab, tracer, "rays that leave the screen before they hit", leaving,
            tracePhotons(lab, tracer, scene, leaving, {{"reconstruct.map_covers", "scene"}}),
            {kAccountOffScreen}, "off screen");
        if (lab.tracerReach(tracer) == TracerReach::lightFront) {
            expectNoHits(lab, tracer.subject, "rays beyond what the light sees", hidden,
                         tracePhotons(lab, tracer, scene, hidden), kUnseenByLight,
                         "hidden in the map or unresolved");
            continue;
        }
        expectCounted(lab, tracer, "rays beyond the last of 3 layers", hidden,
                      tracePhotons(lab, tracer, scene, hidden, {{"layers.count", "3"}}),
                      {kAccountBeyondLastLayer, kAccountUnresolved},
                      "beyond the layers or unresolved");
    }
}

void passesBehind(Lab& lab) {
    const scene::Scene scene =
        makeScene({}, kLampAtTheEye + facingPlane("wall", "grey", 60, {0, 0, -10}) +
                          object("box", "box", "white", {0, 0, -5}, "size = [2, 2, 1]") +
                          facingPlane("plate", "white", 1, {2, 1.5, -5}));
    std::vector<StagePhoton> photons;
    for (int i = 0; i < 100; ++i)
        photons.push_back(
            photon({-4.0, 0.12 * (i / 10) - 0.5, -8.0 - 0.02 * (i % 10)}, {1.0, 0.05, -0.25}));
    for (const Lab::Choice& tracer : lab.each<TraceStage>()) {
        expectHits(lab, tracer.subject, "the wall by rays that pass behind a box and a plate",
                   photons, tracePhotons(lab, tracer, scene, photons), {0, 0, 1}, -10.0, kGrey);
    }
}

void stepsAcrossAThinSurface(Lab& lab) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.0, std::sin(0.5), std::cos(0.5)));
    const scene::Scene scene =
        makeScene({}, kLampAtTheEye + facingPlane("wall", "grey", 60, {0, 0, -100}) +
                          object("sheet", "plane", "white", {0, 0, -5},
                                 fmt::format("size = [8, 8]\nrotation_degrees = [{}, 0, 0]",
                                             number(90.0 - glm::degrees(0.5)))));
    std::vector<StagePhoton> photons;
    for (int i = 0; i < 400; ++i) {
        const glm::dvec3 p(0.031 * (i % 20) - 0.3, 0.029 * (i / 20) - 0.3, -1.0);
        // Less than two pixels on the screen, and 99 m deep.
        photons.push_back(photon(p, p + glm::dvec3(0.003 * (i % 7), 0.002 * (i % 5), 0.0)));
    }
    const double d = glm::dot(normal, glm::dvec3(0, 0, -5));
    for (const Lab::Choice& tracer : lab.each<TraceStage>()) {
        expectHits(lab, tracer.subject, "a sheet that lies between two samples", photons,
                   tracePhotons(lab, tracer, scene, photons), normal, d, kWhite);
        expectHits(lab, tracer.subject, "the same in 16 x 16 pixels", photons,
                   tracePhotons(lab, tracer, scene, photons, {}, {16, 16}), normal, d, kWhite);
    }
}

// Water at y = 0, a floor at y = -depth, seen from above at a slant.
scene::Scene basin(double depth, double shift) {
    const glm::dvec3 offset(shift, 0.0, shift);
    CameraText camera;
    camera.position = offset + glm::dvec3(0.0, 2.0, 3.0);
    camera.target = offset;
    return makeScene(camera, kSun +
                                 floorPlane("floor", "grey", 6, offset - glm::dvec3(0, depth, 0)) +
                                 floorPlane("water", "water", 6, offset));
}

void startsOnASurface(Lab& lab) {
    for (const Lab::Choice& tracer : lab.each<TraceStage>()) {
        for (const double depth : {1.0, 0.02}) {
            for (const double shift : {0.0, 1e5}) {
                const scene::Scene scene = basin(depth, shift);
                std::vector<StagePhoton> photons;
                for (int i = 0; i < 400; ++i) {
                    StagePhoton p =
                        photon({shift + 0.05 * (i % 20) - 0.5, 0.0, shift + 0.05 * (i / 20) - 0.5},
                               {0.3, -1.0, 0.1});
                    p.media = {kWater};
                    p.startNormal = {0, 1, 0};
                    p.startMaterial = kWater;
                    photons.push_back(p);
                }
                expectHits(lab, tracer.subject,
                           fmt::format("a floor {} m below the water that they start on, {:.0e} m "
                                       "from the origin",
                                       depth, shift),
                           photons, tracePhotons(lab, tracer, scene, photons), {0, 1, 0}, -depth,
                           kGrey,
                           {1e-4,
                            "32-bit depths of some 4 m, camera-relative, and normals, along "
                            "rays that close in with a cosine above 0.9"});
            }
        }
    }
}

// Two open mirrors that face each other's backs, 4 m apart, seen at a slant from above.
void openMirrors(Lab& lab) {
    CameraText camera;
    camera.position = {0.0, 4.0, 6.0};
    camera.target = {0.0, 0.0, 0.0};
    const auto sheet = [](const char* name, double x, double degrees) {
        return object(name, "plane", "mirror", {x, 0, 0},
                      fmt::format("size = [3, 3]\nrotation_degrees = [0, 0, {}]", number(degrees)));
    };
    // Rotated by -90 degrees about z the plane's +y becomes +x.
    const scene::Scene scene =
        makeScene(camera, kSun + sheet("left", -2.0, -90.0) + sheet("right", 2.0, -90.0) +
                              floorPlane("floor", "grey", 20, {0, -2, 0}));
    const glm::dvec3 toRight = {1.0, 0.02, 0.03};
    std::vector<StagePhoton> fromFront;
    std::vector<StagePhoton> fromBack;
    std::vector<StagePhoton> inTheOpen;
    for (int i = 0; i < 100; ++i) {
        const double y = 0.1 * (i % 10) - 0.4;
        const double z = 0.1 * (i / 10) - 0.4;
        // Where a tracer puts a photon: near the surface, on either side.
        const double off = 1e-4 * (i % 3 - 1);
        StagePhoton p = photon({-2.0 + off, y, z}, toRight);
        p.leftSide = kLeftOutside;
        fromFront.push_back(p);
        p = photon({2.0 + off, y, z}, {-1.0, 0.02, 0.03});
        p.leftSide = kLeftInside;
        fromBack.push_back(p);
        inTheOpen.push_back(photon({0.0, y, z}, toRight));
    }
    const Tolerance offsets{1e-4, "32-bit depths and normals of planes 6 m away, seen at a slant"};
    for (const Lab::Choice& tracer : lab.each<TraceStage>()) {
        if (lab.seesReceiversOnly(tracer)) {
            for (const std::vector<StagePhoton>* photons : {&inTheOpen, &fromFront, &fromBack}) {
                expectNoHits(lab, tracer.subject,
                             "photons between open mirrors, of which it sees none", *photons,
                             tracePhotons(lab, tracer, scene, *photons, {{"trace.blockers", "0"}}),
                             kUnseenByLight, "unresolved or outside of the map");
            }
            continue;
        }
        expectHits(lab, tracer.subject, "the back of an open mirror", inTheOpen,
                   tracePhotons(lab, tracer, scene, inTheOpen), {1, 0, 0}, 2.0, kMirror, offsets);
        expectHits(lab, tracer.subject, "the back of one by photons that leave another's front",
                   fromFront, tracePhotons(lab, tracer, scene, fromFront), {1, 0, 0}, 2.0, kMirror,
                   offsets);
        expectHits(lab, tracer.subject, "the front of one by photons that leave another's back",
                   fromBack, tracePhotons(lab, tracer, scene, fromBack), {1, 0, 0}, -2.0, kMirror,
                   offsets);
    }
}

void twoSurfacesWithinEpsilon(Lab& lab) {
    const double gap = 0.002;
    const scene::Scene scene =
        makeScene({}, kLampAtTheEye + facingPlane("front", "grey", 60, {0, 0, -10}) +
                          facingPlane("back", "white", 60, {0, 0, -10 - gap}) +
                          facingPlane("behind", "grey", 60, {0, 0, -20}));
    std::vector<StagePhoton> forth;
    std::vector<StagePhoton> back;
    for (int i = 0; i < 100; ++i) {
        const double x = 0.11 * (i % 10) - 0.5;
        const double y = 0.13 * (i / 10) - 0.5;
        forth.push_back(photon({x, y, -4.0}, {0.3, 0.2, -1.0}));
        back.push_back(photon({x, y, -14.0}, {0.3, 0.2, 1.0}));
    }
    const Settings epsilon = {
        {"trace.test", "epsilon"}, {"trace.epsilon", "0.2"}, {"layers.count", "4"}};
    for (const Lab::Choice& tracer : lab.each<TraceStage>()) {
        expectHits(lab, tracer.subject, "the nearer of two walls 2 mm apart", forth,
                   tracePhotons(lab, tracer, scene, forth), {0, 0, 1}, -10.0, kGrey);
        if (lab.tracerReach(tracer) == TracerReach::lightFront) {
            // It has no thickness to be told of, and trace.test and epsilon are not its.
            expectHits(lab, tracer.subject,
                       "the farther of them from behind, which alone its light sees", back,
                       tracePhotons(lab, tracer, scene, back), {0, 0, 1}, -10.0, kGrey);
            continue;
        }
        expectHits(lab, tracer.subject, "the nearer of them from behind", back,
                   tracePhotons(lab, tracer, scene, back), {0, 0, 1}, -10.0 - gap, kWhite);
        // No step is longer than 0.2 m here, so that none can see the farther wall alone.
        const Traced there = tracePhotons(lab, tracer, scene, forth, epsilon, {512, 512});
        const Traced returned = tracePhotons(lab, tracer, scene, back, epsilon, {512, 512});
        std::size_t wrong = 0;
        std::size_t found = 0;
        for (std::size_t i = 0; i < forth.size(); ++i) {
            found += (there.hits[i].isHit() ? 1u : 0u) + (returned.hits[i].isHit() ? 1u : 0u);
            wrong += there.hits[i].isHit() && there.hits[i].material != kGrey ? 1 : 0;
            wrong += returned.hits[i].isHit() && returned.hits[i].material != kWhite ? 1 : 0;
        }
        lab.expect(tracer.subject, "hits of the farther of them by the paper's epsilon of 0.2 m",
                   0.0, static_cast<double>(wrong), kExactly);
        lab.expect(tracer.subject, "photons that hit either of them by it",
                   2.0 * static_cast<double>(forth.size()), static_cast<double>(found), kExactly);
    }
}

void edgeOnOrBelowAPixel(Lab& lab) {
    // Seen exactly edge-on, and a quarter of a pixel wide in the middle of a pixel's corner.
    const scene::Scene scene = makeScene(
        {},
        kSun + floorPlane("edge", "white", 2, {0, 0, -5}) +
            object("speck", "box", "white", {at(90.0, 90.0, 5.0)}, "size = [0.01, 0.01, 0.01]") +
            object("bounds", "plane", "grey", {0, -40, -5}, "size = [90, 10]"));
    std::vector<StagePhoton> edge;
    std::vector<StagePhoton> speck;
    for (int i = 0; i < 64; ++i) {
        edge.push_back(
            photon({0.1 * (i % 8) - 0.35, 1.0, -5.0 + 0.1 * (i / 8) - 0.35}, {0, -1, 0}));
        const glm::dvec3 target =
            at(90.0, 90.0, 5.0) + glm::dvec3(0.001 * (i % 8) - 0.0035, 0.001 * (i / 8) - 0.0035, 0);
        speck.push_back(photon(target + glm::dvec3(-0.5, 0.0, 0.0), {1, 0, 0}));
    }
    for (const Lab::Choice& tracer : lab.each<TraceStage>()) {
        const std::vector<unsigned> accounts = {kAccountEdgeOn, kAccountMissedByTracer,
                                                kAccountUnresolved, kAccountOffScreen};
        expectCounted(lab, tracer, "a sheet seen edge-on", edge,
                      tracePhotons(lab, tracer, scene, edge), accounts, "lost");
        if (lab.tracerReach(tracer) == TracerReach::lightFront) {
            // The sides of the speck, which the sun does not see.
            std::vector<unsigned> unseen = kUnseenByLight;
            unseen.push_back(kAccountMissedByTracer);
            expectNoHits(lab, tracer.subject, "a speck below a texel of its light's", speck,
                         tracePhotons(lab, tracer, scene, speck), unseen, "lost");
            continue;
        }
        if (lab.tracerReach(tracer) == TracerReach::around) {
            expectNoHits(lab, tracer.subject, "a speck below a texel of a face around", speck,
                         tracePhotons(lab, tracer, scene, speck), accounts, "lost");
            continue;
        }
        expectCounted(lab, tracer, "a speck below a pixel", speck,
                      tracePhotons(lab, tracer, scene, speck), accounts, "lost");
    }
}

}  // namespace

void addTracingCases(Suite& suite) {
    suite.add("A1", "", nearPlaneAndBehindTheEye);
    suite.add("A2", "", whollyBehindTheEye);
    suite.add("A3", "", alongTheViewDirection);
    suite.add("A6", "Rays along diagonals, pixel edges and ties hit like all others.",
              diagonalsEdgesAndTies);
    suite.add("A7", "", offScreenAndBeyondTheLastLayer);
    suite.add("A8", "A ray that passes behind a layer does not touch it.", passesBehind);
    suite.add("A9", "A steep ray does not step across a thin surface.", stepsAcrossAThinSurface);
    suite.add("A10",
              "A ray does not hit the surface that it starts on, near or far from the origin.",
              startsOnASurface);
    suite.add("A10", "", openMirrors);
    suite.add("A11", "Of two surfaces within epsilon the nearer one is hit.",
              twoSurfacesWithinEpsilon);
    suite.add("B17", "What is seen edge-on or is smaller than a pixel is missed and counted.",
              edgeOnOrBelowAPixel);
}

}  // namespace kaustik::numerics
