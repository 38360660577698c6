// SPDX-License-Identifier: MIT
// D39 and D41: parallel light in a ball of glass, for every tracer and every node of interaction.
// The angle inside is the same at every hit, so what is still inside after so many of them is known
// in closed form; a ball whose mesh has a hole in it is a ball all the same.
#include <cmath>

#include "framework/numerics/cases/common_cases.h"
#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/exact.h"
#include "framework/numerics/lab.h"

namespace kaustik::numerics {
namespace {

using namespace transport;

// The share of the disc's flux that is still inside after `hits` of them, of which the first k = 0
// has just entered: the integral of 2b T(b) R(b)^k over b, in radii, by Simpson's rule. With the
// sine of the angle as the variable its integrand is smooth at the rim, too.
double shareInside(double index, int hits) {
    const int steps = 20000;
    double sum = 0.0;
    for (int i = 0; i <= steps; ++i) {
        const double angle = 0.5 * 3.14159265358979323846 * i / steps;
        const double b = std::sin(angle);
        const double reflectance =
            i == steps
                ? 1.0
                : exactInterface({b, -std::cos(angle), 0.0}, {0, 1, 0}, 1.0, index).reflectance;
        const double value =
            2.0 * b * std::cos(angle) * (1.0 - reflectance) * std::pow(reflectance, hits);
        sum += value * (i == 0 || i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0);
    }
    return sum * 0.5 * 3.14159265358979323846 / steps / 3.0;
}

scene::Scene ballOfGlass() {
    CameraText camera;
    camera.position = {1.9, 1.7, 2.9};
    camera.target = {0.0, 0.5, 0.0};
    camera.fovDegrees = 38.0;
    return makeScene(
        camera, sun({0.5, -1.0, -0.2}) +
                    object("ball", "sphere", "glass", {0, 0.7, 0}, "radius = 0.5\nsegments = 192") +
                    floorPlane("floor", "grey", 12, {0, 0, 0}));
}

const Tolerance kShare{
    3e-3,
    "of 128 x 128 photons some 7,000 fall on the disc, give or take 25 at its rim, "
    "which count as whole ones and of which most is reflected"};
const Tolerance kNoMiss{5e-4,
                        "normals of a mesh of 192 segments stand for the ball's to 1e-3 rad; "
                        "nothing but what enters within a thousandth of the rim comes so near to "
                        "the critical angle, half of it reflected"};

// An account's share of what has hit the ball when the interactions end: what is still on its way
// in it, say.
double shareOf(Lab& lab, unsigned account, const Lab::Choice& choice, const scene::Scene& scene,
               int bounces, const Settings& more) {
    FrameRequest request{
        160, 120, {{"emit.photons", "128x128"}, {"specular.bounces", std::to_string(bounces)}}};
    request.settings.insert(request.settings.end(), more.begin(), more.end());
    const Frame frame = lab.render(choice, scene, request);
    const EnergyLedger ledger = frame.renderer().ledger();
    return ledger.watts[account] / ledger.watts[kAccountEmitted];
}

void expectNothingTrapped(Lab& lab, const Lab::Choice& tracer, const scene::Scene& scene,
                          const std::string& what) {
    const Settings interface = {{"specular", "interface"}};
    if (lab.seesReceiversOnly(tracer)) {
        lab.expectRefused(
            tracer.subject, fmt::format("light inside of {}, whose far side it does not see", what),
            [&] { (void)shareOf(lab, kAccountBounceLimit, tracer, scene, 1, interface); });
        return;
    }
    for (const int bounces : {1, 2, 16}) {
        const bool isIn = bounces == 1;
        lab.expect(tracer.subject,
                   fmt::format("share inside of {} after {} interactions, transmitted alone", what,
                               bounces),
                   isIn ? shareInside(kGlassIndex, 0) : 0.0,
                   shareOf(lab, kAccountBounceLimit, tracer, scene, bounces, interface),
                   isIn ? kShare : kNoMiss);
    }
}

void nothingIsTrapped(Lab& lab) {
    const scene::Scene scene = ballOfGlass();
    for (const Lab::Choice& tracer : lab.each<TraceStage>())
        expectNothingTrapped(lab, tracer, scene, "a ball");
}

// Both branches at every interaction: each hit within leaves R of what there was.
void everyHitLeavesItsShare(Lab& lab) {
    const scene::Scene scene = ballOfGlass();
    const Lab::Choice split = lab.choose(SpecularStage::name, "split");
    // From the fourth on what is left inside is too weak for a room of its own.
    for (int bounces = 1; bounces <= 3; ++bounces) {
        lab.expect(split.subject,
                   fmt::format("share inside of a ball after {} interactions", bounces),
                   shareInside(kGlassIndex, bounces - 1),
                   shareOf(lab, kAccountBounceLimit, split, scene, bounces,
                           {{"specular.split.levels", "6"}}),
                   kShare);
    }
}

// A ball with a triangle missing where neither light nor eye come by.
void anOpenMeshWithAnInside(Lab& lab) {
    scene::Scene scene = ballOfGlass();
    scene::Mesh& ball = scene.meshes[scene.objects[0].mesh];
    ball.triangles.pop_back();
    ball.closed = false;
    for (const Lab::Choice& tracer : lab.each<TraceStage>())
        expectNothingTrapped(lab, tracer, scene, "a ball with a hole");
}

}  // namespace

void addBallCases(Suite& suite) {
    suite.add("D39", "Photons go on inside of a mesh with a hole that has an inside all the same.",
              anOpenMeshWithAnInside);
    suite.add("D41",
              "Light that enters a ball cannot be trapped; each hit within leaves its share R.",
              nothingIsTrapped);
    suite.add("D41", "", everyHitLeavesItsShare);
}

}  // namespace kaustik::numerics
