// SPDX-License-Identifier: MIT
// D42 to D44: glass and water that take white light apart, against Snell's law at each wavelength
// and Descartes' rainbow; and where nothing parts, white is white.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtx/component_wise.hpp>

#include "framework/numerics/cases/common_cases.h"
#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/exact.h"
#include "framework/numerics/lab.h"
#include "framework/numerics/stage_harness.h"
#include "framework/scene/dispersion.h"
#include "framework/scene/spectrum.h"

namespace kaustik::numerics {
namespace {

constexpr std::uint32_t kDispersive = 6;  // the first material after those of makeScene

std::string material(const std::string& glass) {
    return fmt::format(
        "[[material]]\nname = \"dispersive\"\ntype = \"dielectric\"\nglass = \"{}\"\n", glass);
}

double indexOf(const std::string& glass, double nanometers) {
    const auto& all = scene::namedGlasses();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const auto& named) { return named.name == glass; });
    return scene::sellmeierIndex(found->sellmeier, nanometers);
}

// All light is of one wavelength.
void setWavelength(scene::Scene& scene, double nanometers) {
    scene::Band band;
    band.place = scene::dispersionPlace(nanometers);
    band.tint = glm::vec3(scene::primariesAt(nanometers));
    band.ofLight = glm::mat3(scene::fluxFromRec709());
    scene.bands = {band};
}

// By how much a prism of 60 degrees turns light that goes through it at the same angle to both
// faces: twice the angle of incidence less that of the prism, and n sin 30° = sin i.
double leastDeviation(double index) {
    return 2.0 * std::asin(0.5 * index) - glm::radians(60.0);
}

void prismByWavelength(Lab& lab) {
    scene::Scene scene = makeScene({}, material("N-SF11") + sun({0, -1, 0}) +
                                           object("prism", "prism", "dispersive", {0, 0, -4},
                                                  "apex_degrees = 60\nheight = 1\nlength = 1") +
                                           floorPlane("floor", "grey", 20, {0, -3, -4}));
    const double half = glm::radians(30.0);
    const glm::dvec3 left(-std::cos(half), std::sin(half), 0.0);
    const glm::dvec3 right(std::cos(half), std::sin(half), 0.0);
    for (const std::string node : {"interface", "split"}) {
        const Lab::Choice specular = lab.choose(SpecularStage::name, node);
        for (int nanometers = 400; nanometers <= 700; nanometers += 50) {
            setWavelength(scene, nanometers);
            const double index = indexOf("N-SF11", nanometers);
            const double incidence = std::asin(0.5 * index);
            StagePhoton photon;
            photon.position = {-0.2, 0.0, -4.0};
            photon.direction = {std::cos(incidence - half), std::sin(incidence - half), 0.0};
            photon.startNormal = left;
            photon.startMaterial = kDispersive;
            const Traced within = interactPhotons(lab, specular, scene, {photon});
            StagePhoton leaving;
            leaving.position = {0.2, 0.0, -4.0};
            leaving.direction = within.hits.front().normal;
            leaving.startNormal = right;
            leaving.startMaterial = kDispersive;
            leaving.media = {kDispersive};
            const Traced out = interactPhotons(lab, specular, scene, {leaving});
            const double cosine =
                std::clamp(glm::dot(out.hits.front().normal, photon.direction), -1.0, 1.0);
            lab.expect(
                specular.subject,
                fmt::format("least deviation by a prism of flint at {} nm, degrees", nanometers),
                glm::degrees(leastDeviation(index)), glm::degrees(std::acos(cosine)),
                {2e-3,
                 "the polynomial is off by 2e-5 at most, which the slant of the light "
                 "makes 4e-5 rad, and roundings"});
        }
    }
}

// The angle from where the sun is that light of one reflection inside of a ball comes back at, at
// most: 4 r - 2 i where cos² i = (n² - 1) / 3.
double rainbow(double index) {
    const double incidence = std::acos(std::sqrt((index * index - 1.0) / 3.0));
    return 4.0 * std::asin(std::sin(incidence) / index) - 2.0 * incidence;
}

void rainbowOfABall(Lab& lab) {
    // The sun shines down -z. Light that comes back at θ to the sun meets the wall x = 1 at
    // z = 1 / tan θ: before the bow's edge there is none of it, and behind it there is most.
    CameraText camera;
    camera.position = {-0.6, 0.0, 1.15};
    camera.target = {1.0, 0.0, 1.15};
    camera.fovDegrees = 25.0;
    scene::Scene scene = makeScene(
        camera,
        material("water") + sun({0, 0, -1}) +
            object("drop", "sphere", "dispersive", {0, 0, 0}, "radius = 0.004\nsegments = 512") +
            object("wall", "box", "white", {1.05, 0, 1.2}, "size = [0.1, 1, 1.2]"));
    Lab::Choice choice = lab.choose(TraceStage::name, "raytraced");
    for (const int nanometers : {400, 700}) {
        setWavelength(scene, nanometers);
        FrameRequest request{320,
                             240,
                             {{"emit.photons", "256x256"},
                              {"specular", "split"},
                              {"specular.bounces", "3"},
                              {"specular.split.levels", "3"}}};
        const Frame frame = lab.render(choice, scene, request);
        const Texels irradiance = frame.causticIrradiance();
        const Texels receiver = frame.read("eye.receiver");
        const int row = irradiance.height / 2;
        double brightest = 0.0;
        double z = 0.0;
        for (int x = 0; x < irradiance.width; ++x) {
            const glm::dvec3 rgb = irradiance.rgb(x, row);
            const double all = rgb.r + rgb.g + rgb.b;
            if (!(all > brightest)) continue;
            brightest = all;
            z = frame.worldAt(x, row, static_cast<double>(receiver.at(x, row, 0))).z;
        }
        lab.expect(
            choice.subject, fmt::format("angle of the rainbow at {} nm, degrees", nanometers),
            glm::degrees(rainbow(indexOf("water", nanometers))), glm::degrees(std::atan2(1.0, z)),
            {0.3,
             "a pixel is 0.13 degrees wide, the drop 0.4 percent of the distance, which is 0.2, "
             "and the bow is brightest within its edge"});
    }
}

// Parallel light that goes through a slab goes on as it came: every wavelength elsewhere, and all
// of them the same way. Away from the border of the slab's light it has no color but what its faces
// reflect.
void slabStaysWhite(Lab& lab) {
    CameraText camera;
    camera.position = {0.0, 4.0, 0.01};
    camera.fovDegrees = 20.0;
    camera.target = {0.0, 0.0, 0.0};
    scene::Scene scene = makeScene(
        camera, material("N-SF11") + sun({0.5, -1.0, 0.2}) +
                    object("slab", "box", "dispersive", {-0.6, 1.2, -0.2}, "size = [3, 0.3, 3]") +
                    floorPlane("floor", "white", 12, {0, 0, 0}));
    scene::placeBands(scene, 8, 120, 0.0);
    // What both faces let through, which is some less of blue than of red.
    const glm::dvec3 direction = scene.lights.front().direction;
    glm::dvec3 expected(0.0);
    for (const scene::Band& band : scene.bands) {
        const double index = scene::indexAt(scene.materials[kDispersive - 1], band.place);
        const double left = 1.0 - exactInterface(direction, {0, 1, 0}, 1.0, index).reflectance;
        expected += scene::rec709FromFlux() * glm::dmat3(band.ofLight) * glm::dvec3(1000.0) *
                    (left * left * -direction.y);
    }
    for (const Lab::Choice& choice : lab.each<ReconstructStage>()) {
        const Frame frame = lab.render(
            choice, scene, {160, 120, {{"emit.photons", "272x272"}, {"trace", "raytraced"}}});
        const Texels irradiance = frame.causticIrradiance();
        glm::dvec3 sum(0.0);
        for (int y = 40; y < 80; ++y) {
            for (int x = 60; x < 100; ++x)
                sum += irradiance.rgb(x, y);
        }
        const auto color = [](const glm::dvec3& rgb) { return rgb / (rgb.r + rgb.g + rgb.b); };
        lab.expectDeviation(choice.subject, "color behind a slab of flint, by channel, relative",
                            glm::compMax(glm::abs(color(sum) / color(expected) - 1.0)),
                            {1e-3,
                             "of splats that overlap unevenly, a little elsewhere for each "
                             "wavelength; 2e-7 where they are joined"});
        lab.expectAtLeast(choice.subject, "irradiance there, W/m²", 600.0,
                          (sum.r + sum.g + sum.b) / (3.0 * 1600.0), "darkness has no color");
    }
}

}  // namespace

void addDispersionCases(Suite& suite) {
    suite.add("D42", "A prism turns light of every wavelength by its own least deviation.",
              prismByWavelength);
    suite.add("D43", "The bow of a ball of water is at 42.4 degrees in red and 40.5 in violet.",
              rainbowOfABall);
    suite.add("D44", "Parallel light through a slab has no color, however its glass disperses.",
              slabStaysWhite);
}

}  // namespace kaustik::numerics
