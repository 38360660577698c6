// SPDX-License-Identifier: MIT
// C27 to C28a on nodes: absorption, nested dielectrics and what the eye sees through water, against
// optics in double (framework/numerics/exact.h).
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

using Media = std::vector<std::uint32_t>;

// Places in which two stacks differ; one that only one of them has is such a place.
int countDifferent(const Media& a, const Media& b) {
    int count = 0;
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i)
        count += i < a.size() && i < b.size() && a[i] == b[i] ? 0 : 1;
    return count;
}

const Tolerance kDirection{1e-6,
                           "roundings of a unit vector of 6e-8, through a normal that is "
                           "interpolated and a refraction"};

std::string lamp(const glm::dvec3& position, double intensity = 100.0) {
    return fmt::format(
        "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = {}\nintensity = {}\n",
        numbers(position), number(intensity));
}

void transmittance(Lab& lab) {
    const double infinite = std::numeric_limits<double>::infinity();
    struct Path {
        const char* what;
        double perMeter;
        double meters;
        double expected;
    };
    const std::vector<Path> paths = {
        {"zero length", 3.0, 0.0, 1.0},
        {"infinite attenuation distance over 1e30 m", 0.0, 1e30, 1.0},
        {"infinite attenuation distance without end", 0.0, infinite, 1.0},
        {"black tint over 1 m", infinite, 1.0, 0.0},
        {"black tint over zero length", infinite, 0.0, 1.0},
        {"2 m of 0.5/m", 0.5, 2.0, std::exp(-1.0)}};
    std::vector<MaterialData> materials;
    std::vector<glm::vec4> inputs;
    for (const Path& path : paths) {
        MaterialData data{};
        data.absorption = glm::vec4(static_cast<float>(path.perMeter));
        materials.push_back(data);
        inputs.emplace_back(static_cast<float>(materials.size()), static_cast<float>(path.meters),
                            0.0f, 0.0f);
    }
    const gl::Buffer buffer(materials, "materials");
    const std::vector<glm::vec4> out =
        probe(lab.context(), "numerics/transmittance.comp", inputs, static_cast<int>(paths.size()),
              1, [&](gl::Command& command) { command.storage("Materials", buffer); });
    for (std::size_t i = 0; i < paths.size(); ++i) {
        lab.expect("include/surfaces/surface_data.glsl",
                   std::string("transmittance: ") + paths[i].what, paths[i].expected,
                   static_cast<double>(out[i].g),
                   paths[i].expected == 1.0 || paths[i].expected == 0.0
                       ? kExactly
                       : Tolerance{1e-6, "some steps of a 32-bit exp"});
    }
}

// A lamp 0.5 m below open water that absorbs.
void lampUnderWater(Lab& lab) {
    const glm::dvec3 position(0.0, -0.5, -4.0);
    const double perMeter = 1.2;
    const auto sceneOf = [&](double absorption) {
        scene::Scene scene =
            makeScene({}, lamp(position) + floorPlane("water", "water", 1.5, {0, 0, -4}) +
                              object("ceiling", "plane", "grey", {0, 1.5, -4},
                                     "size = [20, 20]\nrotation_degrees = [180, 0, 0]"));
        scene.materials[kWater - 1].absorptionPerMeter = glm::vec3(static_cast<float>(absorption));
        return scene;
    };
    const scene::Scene clear = sceneOf(0.0);
    const scene::Scene dark = sceneOf(perMeter);
    const Settings settings = {{"emit.photons", "24x24"}};
    for (const Lab::Choice& emitter : lab.each<EmitStage>()) {
        const Bent without = emitAndInteract(lab, emitter, clear, settings);
        const Bent with = emitAndInteract(lab, emitter, dark, settings);
        double worst = 0.0;
        double worstDirection = 0.0;
        int photons = 0;
        int inWater = 0;
        int outside = 0;
        int leaving = 0;
        for (std::size_t i = 0; i < with.before.hits.size(); ++i) {
            if (with.before.hits[i].fate != kFateSpecular) continue;
            ++photons;
            inWater += with.before.media[i] == Media{kWater} ? 1 : 0;
            const double pathMeters = glm::length(with.before.hits[i].position - position);
            const double left =
                with.before.hits[i].fluxWatts.g / without.before.hits[i].fluxWatts.g;
            worst = std::max(worst, std::abs(left - std::exp(-perMeter * pathMeters)));
            const ExactInterface exact =
                exactInterface(with.before.directions[i], {0.0, -1.0, 0.0}, kWaterIndex, 1.0);
            const bool leaves = exact.refracted != glm::dvec3(0.0);
            leaving += leaves ? 1 : 0;
            outside += leaves && with.after.media[i].empty() ? 1 : 0;
            worstDirection =
                std::max(worstDirection, glm::length(with.after.directions[i] -
                                                     (leaves ? exact.refracted : exact.reflected)));
        }
        lab.expect(emitter.subject, "photons of a lamp under water that are in it", photons,
                   inWater, kExactly);
        lab.expectDeviation(emitter.subject, "worst error of the share that the water leaves them",
                            worst, {1e-6, "a 32-bit exp of 1 m known to 1e-7"});
        lab.expect(emitter.subject, "of those that refract, are outside then", leaving, outside,
                   kExactly);
        lab.expectDeviation(emitter.subject, "worst error of their direction", worstDirection,
                            {2e-3,
                             "near the critical angle a direction changes by 1/cos of it: "
                             "1e-6 of the sine is 1.4e-3"});
    }
}

void lookingOutOfWater(Lab& lab) {
    CameraText above;
    above.position = {0.0, 3.0, 0.001};  // up must not be along the view
    above.target = {0.0, 0.0, 0.0};
    above.fovDegrees = 4.0;
    const scene::Scene scene =
        makeScene(above, sun({0, -1, 0}, 500.0) + floorPlane("water", "water", 0.6, {0, 0, 0}) +
                             floorPlane("floor", "white", 10, {0, -1, 0}));
    const double r0 = std::pow((kWaterIndex - 1.0) / (kWaterIndex + 1.0), 2.0);
    const double background = 2.0;
    for (const Lab::Choice& node : lab.each<ViewStage>()) {
        // Where a technique stores light in a map, splats of some texels leave no gaps.
        const Frame frame = lab.render(
            node, scene, {65, 65, {{"emit.photons", "64x64"}, {"reconstruct.map_size", "64"}}});
        const Texels seen = frame.read(frame.renderer().outputs().picture.radiance);
        const Texels below = frame.read("compose.receiver_radiance");
        const double inside = below.rgb(32, 32).g;
        lab.expect(node.subject, "radiance out of water over that inside, at the normal",
                   (1.0 - r0) / (kWaterIndex * kWaterIndex),
                   (seen.rgb(32, 32).g - r0 * background) / inside,
                   {2e-4,
                    "less the reflection of the background; bent rays look between pixels, on a "
                    "caustic that is even to a few percent, a hundredth of a pixel aside"});
        lab.expectAtLeast(node.subject, "radiance of the water's floor, W/m²/sr", 1.0, inside,
                          "a dark floor would prove nothing");
    }
    for (const Lab::Choice& specular : lab.each<SpecularStage>()) {
        StagePhoton photon;
        photon.position = {0.0, 0.0, 0.0};
        photon.direction = {0.0, 1.0, 0.0};
        photon.media = {kWater};
        photon.startNormal = {0.0, 1.0, 0.0};
        photon.startMaterial = kWater;
        const Traced out = interactPhotons(lab, specular, scene, {photon});
        lab.expect(specular.subject, "flux that leaves water at the normal, of 1 W", 1.0 - r0,
                   out.hits.front().fluxWatts.g, {1e-6, "roundings of 6e-8"});
    }
}

void nestedDielectrics(Lab& lab) {
    const scene::Scene scene =
        makeScene({}, sun({0, -1, 0}) + floorPlane("water", "water", 2, {0, 0, -4}) +
                          object("cube", "box", "glass", {0, -1, -4}, "size = [1, 1, 1]") +
                          floorPlane("floor", "grey", 20, {0, -3, -4}));
    const auto arriving = [&](double radians, bool enters, const Media& media) {
        StagePhoton photon;
        photon.position = {0.0, -0.5, -4.0};
        photon.direction = {std::sin(radians), enters ? -std::cos(radians) : std::cos(radians),
                            0.0};
        photon.startNormal = {0.0, 1.0, 0.0};
        photon.startMaterial = kGlass;
        photon.media = media;
        return photon;
    };
    const Media glassInWater = {kGlass, kWater};
    const std::vector<StagePhoton> photons = {arriving(0.6, true, {kWater}),
                                              arriving(0.6, false, glassInWater),
                                              arriving(1.2, false, glassInWater)};
    for (const Lab::Choice& specular : lab.each<SpecularStage>()) {
        std::vector<Media> media;
        const Traced result = interactPhotons(lab, specular, scene, photons, &media);
        const ExactInterface in =
            exactInterface(photons[0].direction, {0, 1, 0}, kWaterIndex, kGlassIndex);
        const ExactInterface out =
            exactInterface(photons[1].direction, {0, -1, 0}, kGlassIndex, kWaterIndex);
        const ExactInterface total =
            exactInterface(photons[2].direction, {0, -1, 0}, kGlassIndex, kWaterIndex);
        // A result's direction is read as its normal.
        if (lab.goesThroughBodies(specular)) {
            // Through the glass, whose faces are parallel, and back in water.
            lab.expectDeviation(specular.subject, "error of direction through glass in water",
                                glm::length(result.hits[0].normal - photons[0].direction),
                                kDirection);
            lab.expect(specular.subject, "flux through glass in water, W",
                       (1.0 - in.reflectance) * (1.0 - in.reflectance), result.hits[0].fluxWatts.g,
                       {1e-6, "roundings of 6e-8"});
        } else {
            lab.expectDeviation(specular.subject, "error of direction from water into glass",
                                glm::length(result.hits[0].normal - in.refracted), kDirection);
            lab.expect(specular.subject, "flux from water into glass, W", 1.0 - in.reflectance,
                       result.hits[0].fluxWatts.g, {1e-6, "roundings of 6e-8"});
        }
        lab.expectDeviation(specular.subject, "error of direction from glass into water",
                            glm::length(result.hits[1].normal - out.refracted), kDirection);
        lab.expectDeviation(specular.subject, "error of direction of total internal reflection",
                            glm::length(result.hits[2].normal - total.reflected), kDirection);
        const Media entered = lab.goesThroughBodies(specular) ? Media{kWater} : glassInWater;
        const std::vector<std::pair<const char*, Media>> expected = {
            {lab.goesThroughBodies(specular) ? "through glass in water" : "in glass in water",
             entered},
            {"back in water", {kWater}},
            {"in glass in water after total internal reflection", glassInWater}};
        for (std::size_t i = 0; i < expected.size(); ++i) {
            lab.expect(specular.subject,
                       fmt::format("wrong places in the stack of a photon {}", expected[i].first),
                       0, countDifferent(media[i], expected[i].second), kExactly);
        }
    }
}

// A glass cube that light enters at a slant and is reflected in; all of it is on the screen.
void cubeWithInternalReflections(Lab& lab) {
    CameraText camera;
    camera.position = {2.5, 3.0, 5.0};
    camera.target = {0.0, 0.0, 0.0};
    const scene::Scene scene =
        makeScene(camera, sun({0.8, -1.0, 0.1}) +
                              object("cube", "box", "glass", {0, 0.6, 0}, "size = [1, 1, 1]") +
                              floorPlane("floor", "grey", 30, {0, 0, 0}));
    for (const Lab::Choice& tracer : lab.each<TraceStage>()) {
        if (lab.seesReceiversOnly(tracer)) {
            // What its technique may choose leads photons through the cube by itself.
            lab.expectRefused(tracer.subject, "light inside of a cube that it cannot leave", [&] {
                (void)lab.render(
                    tracer, scene,
                    {160, 120, {{"emit.photons", "48x48"}, {"specular", "interface"}}});
            });
            continue;
        }
        double limited = 0.0;
        for (const int bounces : {1, 2, 8}) {
            const FrameRequest request{
                160,
                120,
                {{"emit.photons", "48x48"}, {"specular.bounces", std::to_string(bounces)}}};
            const Frame frame = lab.render(tracer, scene, request);
            const EnergyLedger ledger = frame.renderer().ledger();
            lab.expect(tracer.subject, fmt::format("balance of {} interactions", bounces), 0.0,
                       ledger.balance(), {2e-6, "sums of 32-bit fluxes and areas in fixed point"});
            const double share = ledger.watts[kAccountBounceLimit] / ledger.watts[kAccountEmitted];
            if (bounces > 1) {
                lab.expectAtMost(tracer.subject,
                                 fmt::format("flux at the limit of {} interactions over that at "
                                             "the limit of fewer",
                                             bounces),
                                 0.9, share / limited,
                                 "at every interaction some of the light leaves the cube");
            }
            limited = share;
        }
    }
}

}  // namespace

void addOpticsCases(Suite& suite) {
    suite.add("C27", "Absorption is right at zero length, without absorption and for a black tint.",
              transmittance);
    suite.add("C27", "", lampUnderWater);
    suite.add("C28", "Nested dielectrics and every bounce until the limit; the rest is counted.",
              nestedDielectrics);
    suite.add("C28", "", cubeWithInternalReflections);
    suite.add("C28a", "Radiance out of water is T/n² of that inside; flux has no n².",
              lookingOutOfWater);
}

}  // namespace kaustik::numerics
