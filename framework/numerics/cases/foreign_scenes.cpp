// SPDX-License-Identifier: MIT
// D45 to D47: what scenes of others bring: panes with slivers that face against the rest, lamps
// that have a size, and normal maps.
#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/gtc/constants.hpp>

#include "framework/image/image.h"
#include "framework/image/pfm.h"
#include "framework/numerics/cases/common_cases.h"
#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/exact.h"
#include "framework/numerics/lab.h"
#include "framework/numerics/stage_harness.h"
#include "framework/scene/emitters.h"
#include "framework/scene/meshes/winding_number.h"

namespace kaustik::numerics {
namespace {

using namespace transport;

// A sheet that has two triangles more of 4e-11 m², which face the other way.
void addSlivers(scene::Mesh& sheet) {
    const auto corner = [&](double x, double z) {
        sheet.positions.push_back(glm::vec3(glm::dvec3(x, 0.0, z) - sheet.origin));
        sheet.normals.emplace_back(0, 1, 0);
        sheet.uvs.emplace_back(0, 0);
        return static_cast<std::uint32_t>(sheet.positions.size() - 1);
    };
    for (const double x : {0.1, -0.2}) {
        const std::uint32_t a = corner(x, 0.1);
        const std::uint32_t b = corner(x + 1e-5, 0.1);
        const std::uint32_t c = corner(x, 0.1 + 8e-6);
        sheet.triangles.emplace_back(a, b, c);
    }
    sheet.hasInside = scene::boundsVolume(scene::meanWindingBehind(sheet));
}

void paneWithSlivers(Lab& lab) {
    CameraText camera;
    camera.position = {0.0, 2.5, 2.5};
    camera.target = {0.0, 0.0, 0.0};
    scene::Scene scene = makeScene(
        camera, sun({0.2, -1, 0.1}) +
                    object("pane", "plane", "water", {0, 0.6, 0}, "size = [1, 1]\ncells = 8") +
                    floorPlane("floor", "grey", 8, {0, 0, 0}));
    addSlivers(scene.meshes[scene.objects[0].mesh]);
    lab.expect("scene.winding_number", "a pane with slivers has an inside", 0.0,
               scene.meshes[scene.objects[0].mesh].hasInside ? 1.0 : 0.0, kExactly);
    const double left =
        1.0 - exactInterface(scene.lights[0].direction, {0, 1, 0}, 1.0, kWaterIndex).reflectance;
    for (const Lab::Choice& tracer : lab.each<TraceStage>()) {
        const Frame frame = lab.render(
            tracer, scene, {160, 120, {{"emit.photons", "64x64"}, {"specular", "interface"}}});
        const EnergyLedger ledger = frame.renderer().ledger();
        lab.expect(tracer.subject, "share of the light on a pane with slivers that arrives", left,
                   ledger.watts[kAccountDeposited] / ledger.watts[kAccountEmitted],
                   {2e-3, "photons at the border of the picture or a map, of 64 x 64"});
    }
}

// The share of what a square of this side sends out at one place before its middle that faces it,
// at this distance (the view factor of a rectangle's corner, four of them).
double factorOfSquare(double side, double distance) {
    const double x = 0.5 * side / distance;
    const double root = std::sqrt(1.0 + x * x);
    return 4.0 * (x / root * std::atan(x / root)) / glm::pi<double>();
}

// Light of a panel through a pane that does not bend it.
void panelThroughAPane(Lab& lab) {
    CameraText camera;
    camera.position = {0.0, 0.45, 0.9};
    camera.target = {0.0, 0.0, 0.0};
    camera.fovDegrees = 30.0;
    constexpr double kSide = 0.5;
    constexpr double kHeight = 1.5;
    scene::Scene scene = makeScene(
        camera,
        "[[material]]\nname = \"lamp\"\ntype = \"lambertian\"\nalbedo = 0\nemission = 10\n"
        "[[material]]\nname = \"air\"\ntype = \"dielectric\"\nior = 1\n" +
            object("panel", "plane", "lamp", {0, kHeight, 0},
                   fmt::format("size = [{0}, {0}]\nrotation_degrees = [180, 0, 0]", kSide)) +
            floorPlane("pane", "air", 1.2, {0, 0.5, 0}) +
            floorPlane("floor", "grey", 4, {0, 0, 0}));
    scene::placeLightPoints(scene, 16, 120);
    const double expected = 10.0 * glm::pi<double>() * factorOfSquare(kSide, kHeight);
    // Their number and their grids are the same for every emitter of photons; vertices are too far
    // apart on a pane.
    const Lab::Choice emitter = lab.choose(EmitStage::name, "grid");
    const Frame frame = lab.render(
        emitter, scene,
        {80, 60, {{"emit.photons", "256x256"}, {"trace", "raytraced"}, {"specular", "interface"}}});
    const Texels irradiance = frame.causticIrradiance();
    double sum = 0.0;
    for (int y = 27; y < 33; ++y) {
        for (int x = 37; x < 43; ++x)
            sum += irradiance.rgb(x, y).g;
    }
    lab.expect(emitter.subject, "irradiance below a panel, through a pane, relative", 1.0,
               sum / (36.0 * expected),
               {0.02,
                "of 16 points the nearest to the closed form are 1e-3 off, and cells of 64 x "
                "64 at the border of the pane more"});
}

// A file of one normal, which leans along u.
class TiltedMap {
  public:
    explicit TiltedMap(double radians)
        : file_(std::filesystem::temp_directory_path() /
                fmt::format("kaustik-tilt-{}.pfm", ::getpid())) {
        Image image(4, 4, 3);
        for (int i = 0; i < 16; ++i) {
            image.at(i % 4, i / 4, 0) = static_cast<float>(0.5 + 0.5 * std::sin(radians));
            image.at(i % 4, i / 4, 1) = 0.5f;
            image.at(i % 4, i / 4, 2) = static_cast<float>(0.5 + 0.5 * std::cos(radians));
        }
        writeImage(file_, image);
    }
    ~TiltedMap() {
        std::error_code ignored;
        std::filesystem::remove(file_, ignored);
    }
    TiltedMap(const TiltedMap&) = delete;
    TiltedMap& operator=(const TiltedMap&) = delete;
    [[nodiscard]] std::string name() const { return file_.filename().string(); }

  private:
    std::filesystem::path file_;
};

void mapOfOneTilt(Lab& lab) {
    constexpr double kTilt = 0.3;
    const TiltedMap map(kTilt);
    const scene::Scene scene = makeScene(
        {}, fmt::format("[[material]]\nname = \"mapped\"\ntype = \"dielectric\"\nior = 1.333\n"
                        "normal_map = \"{}\"\n",
                        map.name()) +
                sun({0, -1, 0}) + floorPlane("water", "mapped", 2, {0, -1, -4}) +
                floorPlane("floor", "grey", 20, {0, -3, -4}));
    const ExactInterface exact =
        exactInterface({0, -1, 0}, {std::sin(kTilt), std::cos(kTilt), 0}, 1.0, kWaterIndex);
    for (const Lab::Choice& emitter : lab.each<EmitStage>()) {
        const Settings settings = {{"emit.photons", "16x16"}, {"specular", "interface"}};
        if (emitter.subject == "emit.vertices") {
            lab.expectRefused(emitter.subject, "a surface with a normal map",
                              [&] { (void)emitAndInteract(lab, emitter, scene, settings); });
            continue;
        }
        const Bent bent = emitAndInteract(lab, emitter, scene, settings);
        double worst = 0.0;
        std::size_t count = 0;
        for (std::size_t i = 0; i < bent.after.hits.size(); ++i) {
            if (bent.after.hits[i].fate != kFateInFlight) continue;
            worst = std::max(worst, glm::length(bent.after.directions[i] - exact.refracted));
            ++count;
        }
        lab.expectAtLeast(emitter.subject, "photons that are bent", 100.0,
                          static_cast<double>(count), kTooFewReason);
        lab.expectDeviation(emitter.subject, "direction below a map of one tilt", worst,
                            {2e-5,
                             "the map is in 16-bit floats on the device: 3e-5 of the normal, of "
                             "which water shows a quarter"});
    }
}

}  // namespace

void addForeignSceneCases(Suite& suite) {
    suite.add("D45", "A pane with slivers that face against it is a pane.", paneWithSlivers);
    suite.add("D46", "A lamp with a size gives what its view factor says.", panelThroughAPane);
    suite.add("D47", "A normal map bends light as a surface that is turned.", mapOfOneTilt);
}

}  // namespace kaustik::numerics
