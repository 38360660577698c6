// SPDX-License-Identifier: MIT
// B12 to B16 for every node that answers `layers`: shapes whose layers are known, in front of a
// camera at the origin that looks down -Z.
#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/numerics/cases/common_cases.h"
#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/lab.h"

namespace kaustik::numerics {
namespace {

// Light, and water behind the camera, give the scene a need for layers.
scene::Scene sceneOf(const std::string& objects) {
    CameraText camera;
    camera.fovDegrees = 40.0;
    return makeScene(camera,
                     sun({0, -1, 0}) + floorPlane("water", "water", 1, {0, 0, 9}) + objects);
}

struct Peeled {
    Frame frame;
    std::vector<Texels> layers;  // depths
    std::vector<Texels> surfaces;
    [[nodiscard]] int countAt(int x, int y) const {
        int count = 0;
        for (const Texels& layer : layers)
            count += layer.at(x, y, 0) > 0.0f ? 1 : 0;
        return count;
    }
};

Peeled peel(Lab& lab, const Lab::Choice& node, const scene::Scene& scene, int width, int height,
            const Settings& settings = {{"emit.photons", "8x8"}}) {
    Peeled peeled{lab.render(node, scene, {width, height, settings}), {}, {}};
    const LayeredDepth& handles = peeled.frame.renderer().outputs().layers;
    for (int layer = 0; layer < handles.layers; ++layer) {
        peeled.layers.push_back(peeled.frame.read(handles.depth, layer));
        peeled.surfaces.push_back(peeled.frame.read(handles.surface, layer));
    }
    return peeled;
}

std::size_t differences(const std::vector<Texels>& a, const std::vector<Texels>& b) {
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t k = 0; k < a[i].values.size(); ++k)
            different += a[i].values[k] != b[i].values[k] ? 1 : 0;
    }
    return different;
}

void coplanarDuplicates(Lab& lab) {
    const scene::Scene scene = sceneOf(
        facingPlane("1", "grey", 200, {0, 0, -3}) + facingPlane("2", "white", 200, {0, 0, -3}) +
        facingPlane("3", "grey", 200, {0, 0, -3}) + facingPlane("4", "grey", 200, {0, 0, -4}));
    for (const Lab::Choice& node : lab.each<LayersStage>()) {
        const Peeled first = peel(lab, node, scene, 32, 24);
        const Peeled second = peel(lab, node, scene, 32, 24);
        int minimum = 99;
        int maximum = 0;
        for (int i = 0; i < 32 * 24; ++i) {
            minimum = std::min(minimum, first.countAt(i % 32, i / 32));
            maximum = std::max(maximum, first.countAt(i % 32, i / 32));
        }
        lab.expect(node.subject, "fewest layers of three equal planes and one behind", 2, minimum,
                   kExactly);
        lab.expect(node.subject, "most layers of them", 2, maximum, kExactly);
        lab.expectDeviation(node.subject, "texels that differ in a second run",
                            static_cast<double>(differences(first.layers, second.layers) +
                                                differences(first.surfaces, second.surfaces)),
                            kExactly);
    }
}

void planesApart(Lab& lab) {
    // A float at 100 m steps by 2^-17 m; the depth of a pixel is interpolated, which costs some
    // steps more: the distance that every pixel resolves is what the row states.
    const double step = std::exp2(-17.0);
    for (const Lab::Choice& node : lab.each<LayersStage>()) {
        double resolved = std::numeric_limits<double>::infinity();
        double worst = 0.0;
        for (const int steps : {64, 32, 16, 8, 4}) {
            const scene::Scene scene =
                sceneOf(facingPlane("1", "grey", 300, {0, 0, -100.0}) +
                        facingPlane("2", "grey", 300, {0, 0, -100.0 - steps * step}));
            const Peeled peeled = peel(lab, node, scene, 64, 48);
            double deviation = 0.0;
            bool all = true;
            for (int i = 0; i < 64 * 48; ++i) {
                all = all && peeled.countAt(i % 64, i / 64) == 2;
                const double apart = static_cast<double>(peeled.layers[1].at(i % 64, i / 64, 0)) -
                                     static_cast<double>(peeled.layers[0].at(i % 64, i / 64, 0));
                deviation = std::max(deviation, std::abs(apart - steps * step));
            }
            if (!all) break;
            resolved = steps * step;
            worst = std::max(worst, deviation);
        }
        lab.expect(node.subject, "least distance told apart at 100 m, near at 0.01 m, m", 4 * step,
                   resolved,
                   {28 * step,
                    "4 steps of a float at 100 m, up to 32 where a device interpolates "
                    "with fewer bits"});
        lab.expectDeviation(
            node.subject, "worst error of that distance, m", worst,
            {6 * step, "three roundings of each plane's depth to a float at 100 m"});
    }
}

void sphereAndTorus(Lab& lab) {
    const scene::Scene ball = sceneOf(object("ball", "sphere", "grey", {0, 0, -5}, "radius = 1"));
    const scene::Scene torus =
        sceneOf(object("torus", "torus", "grey", {0, 0, -5},
                       "radius = 1\ntube_radius = 0.3\nrotation_degrees = [10, 0, 0]"));
    for (const Lab::Choice& node : lab.each<LayersStage>()) {
        for (const bool isTorus : {false, true}) {
            const std::string name = isTorus ? "torus" : "sphere";
            const Peeled peeled = peel(lab, node, isTorus ? torus : ball, 96, 72);
            int maximum = 0;
            int odd = 0;
            int pixels = 0;
            for (int i = 0; i < 96 * 72; ++i) {
                const int count = peeled.countAt(i % 96, i / 96);
                maximum = std::max(maximum, count);
                odd += count % 2;
                pixels += count > 0 ? 1 : 0;
            }
            lab.expect(node.subject, "most layers of a " + name, isTorus ? 4 : 2, maximum,
                       kExactly);
            lab.expect(node.subject, "pixels of a " + name + " with an odd number", 0, odd,
                       {pixels / 1000.0,
                        "a pixel centre on the outline may belong to one of its two "
                        "triangles: one pixel in a thousand"});
        }
        const Peeled peeled = peel(lab, node, ball, 97, 73);
        const Tolerance facets{
            1.5e-3, "128 segments and their rings lie up to R (π/128)²/2 twice inside the sphere"};
        lab.expect(node.subject, "depth of a sphere's front in its middle, m", 4.0,
                   peeled.layers[0].at(48, 36, 0), facets);
        lab.expect(node.subject, "depth of its back there, m", 6.0, peeled.layers[1].at(48, 36, 0),
                   facets);
    }
}

void moreThanTheCap(Lab& lab) {
    std::string planes;
    for (int i = 0; i < 5; ++i)
        planes += facingPlane(std::to_string(i), "grey", 200, {0, 0, -3.0 - i});
    const scene::Scene scene = sceneOf(planes);
    const Settings three = {{"layers.count", "3"}, {"emit.photons", "8x8"}};
    for (const Lab::Choice& node : lab.each<LayersStage>()) {
        const Peeled peeled = peel(lab, node, scene, 32, 24, three);
        const transport::LayerStatistics statistics = peeled.frame.renderer().layerStatistics();
        lab.expect(node.subject, "layers in a pixel, of 5 with room for 3", 3, peeled.countAt(7, 9),
                   kExactly);
        lab.expect(node.subject, "measured depth complexity", 5, statistics.complexity, kExactly);
        lab.expect(node.subject, "fragments counted as skipped", 2 * 32 * 24, statistics.skipped,
                   kExactly);
        lab.expect(node.subject, "pixels counted with them", 32 * 24, statistics.pixelsSkipped,
                   kExactly);
    }
}

void twoPasses(Lab& lab) {
    const scene::Scene scene =
        sceneOf(object("torus", "torus", "grey", {0, 0, -5},
                       "radius = 1\ntube_radius = 0.3\nrotation_degrees = [50, 20, 0]") +
                facingPlane("wall", "grey", 200, {0, 0, -7.5}));
    for (const Lab::Choice& node : lab.each<LayersStage>()) {
        const Peeled peeled = peel(lab, node, scene, 96, 72);
        const Texels eye = peeled.frame.read(peeled.frame.renderer().outputs().eye.receiver);
        int different = 0;
        for (int i = 0; i < 96 * 72; ++i) {
            different +=
                peeled.layers[0].at(i % 96, i / 96, 0) != eye.at(i % 96, i / 96, 0) ? 1 : 0;
        }
        lab.expectDeviation(node.subject, "pixels whose first depth is not the eye's, bit for bit",
                            different, kExactly);
    }
}

}  // namespace

void addLayerCases(Suite& suite) {
    suite.add("B12", "Coplanar duplicates make one layer, the same every run.", coplanarDuplicates);
    suite.add("B13", "Planes are told apart down to what 32-bit view depth allows.", planesApart);
    suite.add("B14", "A sphere has two layers; a torus at most four, and an even number.",
              sphereAndTorus);
    suite.add("B15", "What lies beyond the last layer is counted.", moreThanTheCap);
    suite.add("B16", "The same geometry in two passes has the same depth, bit for bit.", twoPasses);
}

}  // namespace kaustik::numerics
