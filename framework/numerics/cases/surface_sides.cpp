// SPDX-License-Identifier: MIT
// C26 on nodes, and A9 inside a ball: the side of a surface is the triangle's, whatever the shading
// normal says, against optics in double (framework/numerics/exact.h).
#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/numerics/cases/common_cases.h"
#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/exact.h"
#include "framework/numerics/probe.h"
#include "framework/numerics/stage_harness.h"

namespace kaustik::numerics {
namespace {

using namespace transport;

// The bend that the rules ask for: by the shading normal on the triangle's side; by the triangle's
// own where that would send light to the wrong side.
struct Bend {
    glm::dvec3 direction{0.0};
    bool isFallback = false;
    double margin = 1.0;  // the cosine by which it was decided
};
Bend exactBend(const glm::dvec3& direction, const SurfacePoint& surface, bool isMirror, double from,
               double to) {
    const double side = glm::dot(direction, surface.triangleNormal) < 0.0 ? 1.0 : -1.0;
    const glm::dvec3 outer = side * surface.triangleNormal;
    Bend bend;
    for (const bool isFallback : {false, true}) {
        const glm::dvec3 normal = isFallback ? outer : side * surface.shadingNormal;
        const double incidence = glm::dot(direction, normal);
        if (!isFallback) bend.margin = std::abs(incidence);
        if (incidence >= 0.0) continue;
        const ExactInterface interaction = exactInterface(direction, normal, from, to);
        const bool isReflected = isMirror || interaction.refracted == glm::dvec3(0.0);
        bend.direction = isReflected ? interaction.reflected : interaction.refracted;
        bend.isFallback = isFallback;
        const double above = glm::dot(interaction.reflected, outer);
        const double onward = glm::dot(bend.direction, outer);
        if (!isFallback) bend.margin = std::min({bend.margin, std::abs(above), std::abs(onward)});
        if (above > 0.0 && (onward > 0.0) == isReflected) return bend;
    }
    return bend;
}

// The mean normal, by area, of the triangles around a vertex that face the light; 0 where none
// does.
glm::dvec3 litNormalAt(const scene::Scene& scene, const scene::Object& object, std::size_t vertex,
                       const glm::dvec3& direction) {
    const scene::Mesh& mesh = scene.meshes[object.mesh];
    glm::dvec3 sum(0.0);
    for (const glm::uvec3& t : mesh.triangles) {
        if (t.x != vertex && t.y != vertex && t.z != vertex) continue;
        const glm::dvec3 a(mesh.positions[t.x]);
        const glm::dvec3 area =
            glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a);
        if (glm::dot(area, direction) < 0.0) sum += area;
    }
    return glm::length(sum) > 0.0 ? glm::normalize(sum) : sum;
}

// Photons at the vertices of the scene's first object, by their cells: there is no one triangle
// whose side counts, but their mean.
void expectRightSideAtVertices(Lab& lab, const std::string& subject, const std::string& what,
                               const scene::Scene& scene, const Bent& bent, bool isMirror) {
    int wrongSide = 0;
    int compared = 0;
    for (std::size_t i = 0; i < bent.before.hits.size(); ++i) {
        if (bent.before.hits[i].fate != kFateSpecular) continue;
        const glm::dvec3 normal =
            litNormalAt(scene, scene.objects[0], i, bent.before.directions[i]);
        ++compared;
        wrongSide += (glm::dot(bent.after.directions[i], normal) > 0.0) == isMirror ? 0 : 1;
    }
    lab.expect(subject, "photons at vertices" + what + " that go to the wrong side", 0, wrongSide,
               kExactly);
    lab.expect(subject, "are there enough of them", 1.0, compared > 20 ? 1.0 : 0.0, kExactly);
}

// A ball of so few triangles that its smooth normals point to the wrong side for much of the light.
void shadingNormalOnTheWrongSide(Lab& lab) {
    for (const bool isMirror : {false, true}) {
        const std::string material = isMirror ? "mirror" : "glass";
        const scene::Scene scene = makeScene(
            {}, sun({0.3, -1.0, -0.2}) +
                    object("ball", "sphere", material, {0, 0, -4}, "radius = 1\nsegments = 6") +
                    floorPlane("floor", "grey", 20, {0, -2, -4}));
        for (const Lab::Choice& emitter : lab.each<EmitStage>()) {
            // Of some techniques an interaction is the way through a whole body.
            const Bent bent = emitAndInteract(
                lab, emitter, scene, {{"emit.photons", "64x64"}, {"specular", "interface"}});
            double worst = 0.0;
            int wrongSide = 0;
            int compared = 0;
            int fallBacks = 0;
            int photons = 0;
            int onEdges = 0;
            for (std::size_t i = 0; i < bent.before.hits.size(); ++i) {
                if (bent.before.hits[i].fate != kFateSpecular) continue;
                ++photons;
                const auto surface =
                    surfaceAt(scene, scene.objects[0], bent.before.hits[i].position);
                // Near an edge rounding decides which triangle it is; at the outline the light is
                // along the triangle.
                onEdges += surface && surface->edgeDistance < 1e-3 ? 1 : 0;
                if (!surface || surface->edgeDistance < 1e-3) continue;
                const glm::dvec3& direction = bent.before.directions[i];
                const double incidence = glm::dot(direction, surface->triangleNormal);
                if (incidence > -1e-3) continue;
                const Bend exact = exactBend(direction, *surface, isMirror, 1.0, kGlassIndex);
                ++compared;
                fallBacks += exact.isFallback ? 1 : 0;
                const glm::dvec3& measured = bent.after.directions[i];
                const bool isOutside = glm::dot(measured, surface->triangleNormal) > 0.0;
                wrongSide += isOutside == isMirror ? 0 : 1;
                worst = std::max(worst, glm::length(measured - exact.direction));
            }
            const std::string what = " of a coarse ball of " + material;
            if (onEdges == photons) {
                expectRightSideAtVertices(lab, emitter.subject, what, scene, bent, isMirror);
                continue;
            }
            lab.expect(emitter.subject, "photons" + what + " that go to the wrong side", 0,
                       wrongSide, kExactly);
            lab.expectDeviation(emitter.subject, "worst error of direction" + what, worst,
                                {2e-5,
                                 "normals interpolate to 1e-6 over triangles of 1 m that are "
                                 "32 texels wide, more where light grazes by 1e-3"});
            lab.expectAtLeast(emitter.subject, "photons" + what + " that are compared", 500,
                              compared, kTooFewReason);
            lab.expectAtLeast(
                emitter.subject, "photons" + what + " that need the triangle's own normal",
                isMirror ? 10 : 1, fallBacks, "without them the case would not try the rule");
        }
    }
}

// Photons that have entered a ball of glass hit it from within.
void insideABall(Lab& lab) {
    CameraText camera;
    camera.position = {1.9, 1.7, 2.9};
    camera.target = {0.25, 0.3, -0.05};
    camera.fovDegrees = 38.0;
    const scene::Scene scene = makeScene(
        camera, sun({0, -1, 0}) +
                    object("ball", "sphere", "glass", {0, 0.7, 0}, "radius = 0.5\nsegments = 96") +
                    floorPlane("floor", "grey", 12, {0, 0, 0}));
    const glm::dvec3 light = glm::normalize(glm::dvec3(1.8, -2.3, -0.7));
    const glm::dvec3 center(0, 0.7, 0);
    const glm::dvec3 side = glm::normalize(glm::cross(light, glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = glm::cross(side, light);
    std::vector<StagePhoton> photons;
    std::vector<double> exact;
    for (int i = 0; i < 1600; ++i) {
        const double x = (i % 40 - 19.5) / 41.0;
        const double y = (i / 40 - 19.5) / 41.0;
        const glm::dvec3 from = center + x * side + y * up - 2.0 * light;
        const auto entry = firstCrossing(scene, scene.objects[0], from, light, false, 0.0);
        if (!entry) continue;
        StagePhoton p;
        p.position = from + *entry * light;
        const auto surface = surfaceAt(scene, scene.objects[0], p.position);
        if (!surface) continue;
        p.direction = exactInterface(light, surface->shadingNormal, 1.0, kGlassIndex).refracted;
        p.media = {kGlass};
        const auto exit =
            firstCrossing(scene, scene.objects[0], p.position, p.direction, true, 1e-9);
        if (!exit) continue;
        photons.push_back(p);
        exact.push_back(*exit);
    }
    for (const Lab::Choice& tracer : lab.each<TraceStage>()) {
        const Traced traced = tracePhotons(lab, tracer, scene, photons, {}, {400, 300});
        if (lab.seesReceiversOnly(tracer)) {
            lab.expect(tracer.subject,
                       "hits of photons inside a ball of glass, whose far side it does not see", 0,
                       static_cast<double>(traced.hitCount()), kExactly);
            lab.expect(
                tracer.subject, "their flux that counts as missed by it, share", 1.0,
                traced.ledger.watts[kAccountMissedByTracer] / static_cast<double>(photons.size()),
                {1e-5, "photons of 1 W, by the ledger's quantum"});
            continue;
        }
        int wrong = 0;
        double worst = 0.0;
        for (std::size_t i = 0; i < photons.size(); ++i) {
            const StageHit& hit = traced.hits[i];
            const double error = std::abs(hit.distanceMeters - exact[i]);
            // A footprint is 6 mm here, and the ball is hit at up to a tenth of it edge-on.
            if (hit.material != kGlass || error > 0.06) {
                ++wrong;
            } else {
                worst = std::max(worst, error);
            }
        }
        lab.expect(tracer.subject, "photons inside a ball of glass that do not hit it from within",
                   0, wrong,
                   {static_cast<double>(photons.size()) / 500.0,
                    "where the eye sees the ball edge-on a pixel holds one of several triangles: "
                    "2 in a thousand"});
        lab.expectDeviation(tracer.subject, "worst error of t of the others, m", worst,
                            {0.012, "two footprints of 6 mm where the ball is seen at a slant"});
    }
}

// Photons that a tracer finds on a coarse ball are hit on the triangle's side too.
void shadingNormalOfATracedHit(Lab& lab) {
    const scene::Scene scene = makeScene(
        {}, sun({0.1, -0.2, -1}) +
                object("ball", "sphere", "mirror", {0, 0, -4}, "radius = 1\nsegments = 6") +
                facingPlane("wall", "grey", 30, {0, 0, -12}));
    std::vector<StagePhoton> photons;
    std::vector<bool> meetsBall;  // by exact rays
    for (int i = 0; i < 900; ++i) {
        StagePhoton p;
        p.position = {0.06 * (i % 30) - 0.87, 0.06 * (i / 30) - 0.87, -1.5};
        p.direction = glm::normalize(glm::dvec3(0.1, -0.05, -1.0));
        photons.push_back(p);
        meetsBall.push_back(
            firstCrossing(scene, scene.objects[0], p.position, p.direction, false, 0.0)
                .has_value());
    }
    for (const Lab::Choice& tracer : lab.each<TraceStage>()) {
        const Traced traced = tracePhotons(lab, tracer, scene, photons, {}, {512, 512});
        int wrong = 0;
        int found = 0;
        int otherwise = 0;
        double worst = 0.0;
        for (std::size_t i = 0; i < photons.size(); ++i) {
            const StageHit& hit = traced.hits[i];
            const bool isOnWall = hit.material == kGrey;
            otherwise += isOnWall == meetsBall[i] ? 1 : 0;
            if (hit.material != kMirror) continue;
            const auto surface = surfaceAt(scene, scene.objects[0], hit.position);
            // Near an edge the pixel may see the other triangle.
            if (!surface || surface->edgeDistance < 0.1) continue;
            ++found;
            const glm::dvec3 bent =
                exactInterface(photons[i].direction, hit.normal, 1.0, 1.0).reflected;
            wrong += glm::dot(bent, surface->triangleNormal) > 0.0 ? 0 : 1;
            const Bend exact = exactBend(photons[i].direction, *surface, true, 1.0, 1.0);
            // Where the rule just decides, a normal that is off by a little decides otherwise.
            if (exact.margin < 0.05) continue;
            worst = std::max(worst, glm::length(bent - exact.direction));
        }
        if (lab.seesReceiversOnly(tracer)) {
            lab.expect(tracer.subject,
                       "photons that come to the wall behind a mirrored ball or do not, otherwise "
                       "than exact rays",
                       0, otherwise,
                       {9,
                        "of 900, those that pass the ball's outline within a texel of where its "
                        "light sees it"});
            continue;
        }
        lab.expect(tracer.subject, "hits of a coarse mirrored ball that reflect into it", 0, wrong,
                   kExactly);
        lab.expectDeviation(tracer.subject, "worst error of their reflected direction", worst,
                            {0.05,
                             "the normal is bilinear between pixels of 0.01 m, on triangles across "
                             "which it turns by 1 rad/m, and reflection doubles that"});
        lab.expectAtLeast(tracer.subject, "hits of a coarse mirrored ball that are compared", 100,
                          found, kTooFewReason);
    }
}

}  // namespace

void addSurfaceSideCases(Suite& suite) {
    suite.add("C26", "The side of a surface is the triangle's, whatever the shading normal says.",
              shadingNormalOnTheWrongSide);
    suite.add("C26", "", shadingNormalOfATracedHit);
    suite.add("A9", "", insideABall);
}

}  // namespace kaustik::numerics
