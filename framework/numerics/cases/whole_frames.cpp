// SPDX-License-Identifier: MIT
// Whole frames of every technique: the same image far from the origin, at another scale, rotated
// and with another near plane (A10, B18); scenes that lack something or hold what makes no sense
// (E).
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "framework/numerics/cases/common_cases.h"
#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/lab.h"
#include "framework/scene/needs.h"

namespace kaustik::numerics {
namespace {

using namespace transport;

// A scene moved, scaled and turned as a whole.
struct Placement {
    double shift = 0.0;
    double scale = 1.0;
    double turnDegrees = 0.0;  // about y
    double nearMeters = 0.01;  // before the scale
};

scene::Scene wavyWater(const Placement& p) {
    const glm::dmat3 turn(
        glm::rotate(glm::dmat4(1.0), glm::radians(p.turnDegrees), glm::dvec3(0, 1, 0)));
    const auto place = [&](const glm::dvec3& v) {
        return glm::dvec3(p.shift, 0.0, p.shift) + p.scale * (turn * v);
    };
    const auto length = [&](double v) { return number(v * p.scale); };
    const std::string turned = fmt::format("rotation_degrees = [0, {}, 0]", number(p.turnDegrees));
    CameraText camera;
    camera.position = place({0.4, 2.6, 2.4});
    camera.target = place({0.0, -0.4, 0.0});
    camera.nearMeters = p.nearMeters * p.scale;
    return makeScene(
        camera,
        sun(turn * glm::dvec3(0.2, -1.0, -0.1)) +
            object("floor", "plane", "grey", place({0, -1, 0}),
                   fmt::format("size = [{0}, {0}]\n{1}", length(3), turned)) +
            object("water", "water", "water", place({0, 0, 0}),
                   fmt::format("size = [{0}, {0}]\ncells = [48, 48]\n{1}\nwaves = [{{amplitude = "
                               "{2}, wavelength = {3}, direction_degrees = 20}}]",
                               length(2), turned, length(0.015), length(0.7))));
}

void expectSameImage(Lab& lab, const std::string& what, const Placement& placement,
                     double tolerance, const std::string& reason) {
    const scene::Scene here = wavyWater({});
    const scene::Scene there = wavyWater(placement);
    for (const Technique& technique : lab.registry().techniques()) {
        const FrameRequest request{160, 120, {{"emit.photons", "96x96"}}};
        const Texels expected = lab.render(technique, here, request).causticIrradiance();
        const Texels found = lab.render(technique, there, request).causticIrradiance();
        double total = 0.0;
        double difference = 0.0;
        for (int i = 0; i < 160 * 120; ++i) {
            const double e = expected.rgb(i % 160, i / 160).g;
            total += e;
            difference += std::abs(found.rgb(i % 160, i / 160).g - e);
        }
        lab.expectDeviation(
            technique.name, "irradiance that differs " + what + ", share of all",
            total > 0.0 ? difference / total : std::numeric_limits<double>::quiet_NaN(),
            {tolerance, reason});
    }
}

const std::string kRounding =
    "rounding moves single photons and their splats across pixel edges: less than 0.1 % of the "
    "light together";

void farFromTheOrigin(Lab& lab) {
    expectSameImage(lab, "1e5 m from the origin", {.shift = 1e5}, 1e-3, kRounding);
}

void atEveryScale(Lab& lab) {
    expectSameImage(lab, "at 1e4 times the size", {.scale = 1e4}, 1e-3, kRounding);
    expectSameImage(lab, "at 1e-4 of the size", {.scale = 1e-4}, 1e-3, kRounding);
    expectSameImage(lab, "with the near plane at 1 mm", {.nearMeters = 1e-3}, 1e-3, kRounding);
    expectSameImage(lab, "with the near plane at 1 m", {.nearMeters = 1.0}, 1e-3, kRounding);
    expectSameImage(lab, "turned by 90 degrees", {.turnDegrees = 90.0}, 1e-3, kRounding);
}

// Scenes of section E: the parts, by name.
const std::string kSun = sun({0.1, -1.0, 0.2});
const std::string kFloor = floorPlane("floor", "grey", 4, {0, 0, 0});
const std::string kWaterPlane = floorPlane("water", "water", 2, {0, 0.5, 0});
const CameraText kAbove{{0.0, 2.0, 3.0}, {0.0, 0.0, 0.0}, 45.0, 0.01};

const Tolerance kBalance{1e-5, "sums of 32-bit fluxes and areas in fixed point"};

// Whether its tracer is handed photons inside of bodies, for which a sheet whose normals are
// missing counts, and finds no way out of them.
bool isRefused(const Lab& lab, const Technique& technique, const scene::Scene& scene) {
    const params::ParamSet params = lab.registry().makeParams(technique);
    const Registry& registry = lab.registry();
    const scene::SceneNeeds needs = sceneNeeds(scene);
    const bool hasCaustic = needs.closedDielectrics && needs.lights > 0 && needs.receivers;
    return hasCaustic &&
           registry.traits<TraceStage>(params.choice(TraceStage::name)).onlyReceivers &&
           !registry.traits<SpecularStage>(params.choice(SpecularStage::name)).throughBodies;
}

// Renders with every technique: what is not finite is counted by the lab, the balance here.
template <class Look>
void renderAll(Lab& lab, const std::string& what, const scene::Scene& scene,
               const FrameRequest& request, Look&& look) {
    for (const Technique& technique : lab.registry().techniques()) {
        if (isRefused(lab, technique, scene)) {
            lab.expectRefused(technique.name, "what is inside of bodies: " + what,
                              [&] { (void)lab.render(technique, scene, request); });
            continue;
        }
        const Frame frame = lab.render(technique, scene, request);
        lab.expect(technique.name, "balance of the ledger: " + what, 0.0,
                   frame.renderer().ledger().balance(), kBalance);
        look(technique, frame);
    }
}

const FrameRequest kSmall{64, 48, {{"emit.photons", "16x16"}}};

void expectDark(Lab& lab, const std::string& what, const scene::Scene& scene) {
    renderAll(lab, what, scene, kSmall, [&](const Technique& technique, const Frame& frame) {
        lab.expect(technique.name, "caustic irradiance: " + what, 0.0,
                   frame.causticIrradiance().sum(), kExactly);
        lab.expect(technique.name, "deposited, W: " + what, 0.0,
                   frame.renderer().ledger().watts[kAccountDeposited], kExactly);
    });
}

void expectLit(Lab& lab, const std::string& what, const scene::Scene& scene,
               const FrameRequest& request) {
    renderAll(lab, what, scene, request, [&](const Technique& technique, const Frame& frame) {
        lab.expectAtLeast(technique.name, "sum of the caustic irradiance, W/m²: " + what, 1000.0,
                          frame.causticIrradiance().sum(),
                          "what a few pixels in the sun hold; a dark picture holds none");
    });
}

void photonCounts(Lab& lab) {
    const scene::Scene scene = makeScene(kAbove, kSun + kFloor + kWaterPlane);
    expectLit(lab, "one photon", scene, {64, 48, {{"emit.photons", "1x1"}}});
    // Every texel of the light's grid hits the floor first.
    expectDark(lab, "no photon",
               makeScene(kAbove, kSun + kFloor + floorPlane("water", "water", 2, {0, -0.5, 0})));
}

void lackingScenes(Lab& lab) {
    expectDark(lab, "an empty scene", makeScene(kAbove, ""));
    expectDark(lab, "no light", makeScene(kAbove, kFloor + kWaterPlane));
    expectDark(lab, "no specular object", makeScene(kAbove, kSun + kFloor));
    expectDark(lab, "no receiver", makeScene(kAbove, kSun + kWaterPlane));
    const scene::Scene empty = makeScene(kAbove, "");
    for (const Technique& technique : lab.registry().techniques()) {
        const Frame frame = lab.render(technique, empty, kSmall);
        const Texels radiance = frame.read(frame.renderer().outputs().picture.radiance);
        lab.expect(technique.name, "radiance of an empty scene: its background", 2.0,
                   static_cast<double>(radiance.at(20, 20, 1)), kExactly);
    }
}

void viewports(Lab& lab) {
    const scene::Scene scene = makeScene(kAbove, kSun + kFloor + kWaterPlane);
    const Settings few = {{"emit.photons", "16x16"}};
    renderAll(lab, "1 x 1 pixels", scene, {1, 1, few}, [](const auto&, const Frame&) {});
    renderAll(lab, "1 x 64 pixels", scene, {1, 64, few}, [](const auto&, const Frame&) {});
    renderAll(lab, "one layer", scene, {64, 48, {{"emit.photons", "16x16"}, {"layers.count", "1"}}},
              [](const auto&, const Frame&) {});
    // The widest that textures go; rows of photons are as long.
    const int widest = std::min(lab.context().info().maxTextureSize, 16384);
    renderAll(lab, "the widest picture", scene, {widest, 2, {{"emit.photons", "4x4"}}},
              [](const auto&, const Frame&) {});
}

void badGeometry(Lab& lab) {
    scene::Scene degenerate = makeScene(kAbove, kSun + kFloor + kWaterPlane);
    for (scene::Mesh& mesh : degenerate.meshes) {
        // A triangle of no area, one of no extent at all, and a normal of no length.
        const auto last = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.triangles.push_back({0, 1, 1});
        mesh.triangles.push_back({last, last, last});
        mesh.positions.push_back(mesh.positions.front());
        mesh.normals.emplace_back(0.0f);
        mesh.uvs.emplace_back(0.0f);
    }
    expectLit(lab, "degenerate triangles", degenerate, kSmall);
    scene::Scene noNormals = makeScene(kAbove, kSun + kFloor + kWaterPlane);
    for (scene::Mesh& mesh : noNormals.meshes)
        std::fill(mesh.normals.begin(), mesh.normals.end(), glm::vec3(0.0f));
    expectLit(lab, "missing normals", noNormals, kSmall);
    scene::Scene thin = makeScene(kAbove, kSun + kFloor + kWaterPlane);
    thin.materials[kWater - 1].ior = 1.0f;
    expectLit(lab, "an index of refraction of 1", thin, kSmall);
    scene::Scene black = makeScene(kAbove, kSun + kFloor + kWaterPlane);
    black.materials[kWater - 1].absorptionPerMeter =
        glm::vec3(std::numeric_limits<float>::infinity());
    renderAll(lab, "a black tint", black, kSmall,
              [&](const Technique& technique, const Frame& frame) {
                  lab.expect(technique.name, "deposited through a black tint, W", 0.0,
                             frame.renderer().ledger().watts[kAccountDeposited], kExactly);
              });
}

// What is no number in a mesh must not reach the map, though importers refuse it before.
void vertexThatIsNoNumber(Lab& lab) {
    const scene::Scene scene = makeScene(
        kAbove, kSun + kFloor +
                    object("ball", "sphere", "glass", {0, 0.6, 0}, "radius = 0.4\nsegments = 24"));
    const glm::vec3 noNumber(std::numeric_limits<float>::quiet_NaN());
    scene::Scene badNormal = scene;
    std::vector<glm::vec3>& normals = badNormal.meshes[1].normals;
    normals[normals.size() / 2] = noNumber;
    expectLit(lab, "a normal that is no number", badNormal, kSmall);
    scene::Scene badPosition = scene;
    std::vector<glm::vec3>& positions = badPosition.meshes[1].positions;
    positions[positions.size() / 2] = noNumber;
    expectLit(lab, "a position that is no number", badPosition, kSmall);
}

}  // namespace

void addWholeFrameCases(Suite& suite) {
    suite.add("A10", "", farFromTheOrigin);
    suite.add("B18", "The image is the same at every scale, near plane and turn of the scene.",
              atEveryScale);
    suite.add("E.photons", "No photon and one photon give a defined result.", photonCounts);
    suite.add("E.lacking", "Scenes without light, specular object or receiver are dark.",
              lackingScenes);
    suite.add("E.viewports", "One pixel, one column, one layer and the widest picture work.",
              viewports);
    suite.add("E.geometry", "Degenerate triangles, missing normals and extreme media stay finite.",
              badGeometry);
    suite.add("E.not_a_number", "What is no number in a mesh does not spread.",
              vertexThatIsNoNumber);
}

}  // namespace kaustik::numerics
