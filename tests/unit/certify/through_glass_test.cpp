// SPDX-License-Identifier: MIT
// Two interactions through glass: what a plate lets through, in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/certify/certificate.h"
#include "framework/scene/files/scene_file.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::certify {
namespace {

namespace fs = std::filesystem;

constexpr double kIndex = 1.5;
constexpr int kWidth = 32;
constexpr int kHeight = 24;

Certificate certify(const scene::Scene& scene) {
    CertificateRequest request;
    request.width = kWidth;
    request.height = kHeight;
    request.beams.bandPixels = 0.02;
    request.beams.interactions = 2;
    return makeCertificate(scene, {certifyPart(scene, request, {})});
}

// A plate of 2 m by 2 m, 0.3 m to 0.5 m above a table.
const std::string kPlate = R"(
name = "plate"
[camera]
position = [0.3, 2.5, 1.5]
target = [0.1, 0, 0]
vertical_fov_degrees = 40
[[light]]
name = "sun"
type = "directional"
direction = [0, -1, 0]
irradiance = 1000
[[material]]
name = "chalk"
type = "lambertian"
albedo = 0.5
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[object]]
name = "table"
shape = "plane"
material = "chalk"
size = [6, 6]
[[object]]
name = "plate"
shape = "box"
material = "glass"
size = [2, 0.2, 2]
position = [0, 0.4, 0]
)";

scene::Scene plate(const glm::dvec3& sun) {
    const test::TemporaryFolder folder;
    scene::Scene scene = scene::loadScene(folder.file("plate.toml", kPlate).string());
    scene.lights[0].direction = glm::normalize(sun);
    return scene;
}

// The share that one face lets through, of light that is not polarised.
double through(double cosine) {
    const double exit = std::sqrt(1.0 - (1.0 - cosine * cosine) / (kIndex * kIndex));
    const double s = (cosine - kIndex * exit) / (cosine + kIndex * exit);
    const double p = (kIndex * cosine - exit) / (kIndex * cosine + exit);
    return 1.0 - 0.5 * (s * s + p * p);
}

// Whether all of the pixel shows the table within 0.5 m of its middle.
bool seesTheMiddle(const Geometry& geometry, std::size_t pixel) {
    const EyeView eye(geometry, 1, 1);
    const glm::dvec3 from = eye.position() + geometry.center();
    const double perPixel = 2.0 * eye.tangents().y / kHeight;
    for (const std::size_t corner : {0u, 1u, 2u, 3u}) {
        const auto u = static_cast<double>(pixel % kWidth + corner % 2);
        const auto v = static_cast<double>(pixel / kWidth + corner / 2);
        const glm::dvec3 ray = (u - 0.5 * kWidth) * perPixel * eye.right() +
                               (0.5 * kHeight - v) * perPixel * eye.up() - eye.backward();
        const glm::dvec3 hit = from - from.y / ray.y * ray;
        if (!(ray.y < 0.0) || std::abs(hit.x) > 0.5 || std::abs(hit.z) > 0.5) return false;
    }
    return true;
}

// The diagonals of both faces run through the middle, across the light's way askew: at an edge that
// triangles share nothing may be left open.
TEST(CertificateThroughGlass, HoldsTheIrradianceUnderAPlate) {
    for (const glm::dvec3& sun : {glm::dvec3(0.0, -1.0, 0.0), glm::dvec3(0.3, -0.9, 0.17)}) {
        const scene::Scene scene = plate(sun);
        const double cosine = -glm::normalize(sun).y;
        const double truth = 1000.0 * cosine * through(cosine) * through(cosine);
        const Certificate found = certify(scene);
        const Geometry geometry(scene);
        std::size_t middle = 0;
        for (std::size_t i = 0; 3 * i < found.lower.values.size(); ++i) {
            if (!seesTheMiddle(geometry, i)) continue;
            ++middle;
            const auto low = static_cast<double>(found.lower.values[3 * i]);
            const auto high = static_cast<double>(found.upper.values[3 * i]);
            EXPECT_LE(low, truth);
            EXPECT_GE(high, truth);
            // A band of 0.02 pixels on each of four sides.
            EXPECT_LT(high - low, 0.1 * truth);
        }
        EXPECT_GT(middle, 50u);
    }
}

}  // namespace
}  // namespace kaustik::certify
