// SPDX-License-Identifier: MIT
// A lamp that lies exactly in a surface: the device and the reference emit the same watts.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "framework/reference/light_tracing.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

// A glass ball over a floor that catches its light, and between them a square plane, in which, or
// next to which in the same plane, the lamp lies.
scene::Scene ballOverPlaneOf(const std::string& material, double side) {
    return sceneFromText(fmt::format(R"(
[camera]
position = [0, 2, 4]
target = [0, 0.5, 0]
[[light]]
name = "lamp"
type = "point"
position = [1, 0, 1]
power_watts = 100
[[material]]
name = "ground"
{0}
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[object]]
name = "plane"
material = "ground"
shape = "plane"
size = [{1}, {1}]
[[material]]
name = "chalk"
type = "lambertian"
albedo = 0.5
[[object]]
name = "floor"
material = "chalk"
shape = "plane"
size = [8, 8]
position = [0, -1, 0]
[[object]]
name = "ball"
material = "glass"
shape = "sphere"
radius = 0.5
segments = 32
position = [0, 1, 0]
)",
                                     material, side));
}

double emittedByReference(const scene::Scene& scene) {
    const reference::EmbreeScene embree(scene);
    reference::LightTraceSettings settings;
    settings.width = settings.height = 2;
    settings.photonsPerBatch = 1u << 18;
    reference::PixelSums sums = reference::makeLightTraceSums(embree, settings);
    reference::RunOptions options;
    options.stop.batches = 4;
    reference::lightTrace(embree, settings, options, sums);
    return sums.energy().watts[transport::kAccountEmitted];
}

double emittedByDevice(const scene::Scene& scene, const std::string& photons) {
    const Frame frame(scene, 64, 48, {{"emit.photons", photons}});
    return frame.renderer().ledger().watts[transport::kAccountEmitted];
}

TEST(LightInAPlane, EmitsTheSameWattsOnTheDeviceAsInTheReference) {
    const scene::Scene scene = ballOverPlaneOf("type = \"lambertian\"\nalbedo = 0.5", 8.0);
    const double expected = emittedByReference(scene);
    // The ball's solid angle, 0.267 sr of 4 pi: 2.129 W of 100, less what 32 segments lack.
    EXPECT_NEAR(expected, 2.129, 0.024);
    // The grid fits the ball, which takes 51,000 of its cells: of the 800 on its rim each is right
    // or wrong by half a cell at most, all of them by the root of that, 3e-4. Four times that.
    EXPECT_NEAR(emittedByDevice(scene, "256x256"), expected, 1.2e-3 * expected);
}

TEST(LightInAPlane, EmitsTheSameWattsWhereThePlaneIsSpecular) {
    for (const char* material : {"type = \"mirror\"", "type = \"dielectric\"\nior = 1.33"}) {
        SCOPED_TRACE(material);
        const scene::Scene scene = ballOverPlaneOf(material, 1.0);
        const double expected = emittedByReference(scene);
        EXPECT_NEAR(expected, 2.129, 0.024);
        // The light's grid is over the plane, too, so that the ball has a fifth of its cells.
        EXPECT_NEAR(emittedByDevice(scene, "512x512"), expected, 1e-2 * expected);
    }
}

}  // namespace
}  // namespace kaustik::test
