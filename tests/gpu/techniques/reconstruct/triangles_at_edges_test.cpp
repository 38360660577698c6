// SPDX-License-Identifier: MIT
// Triangles where a pixel shows more than one surface: through a sheet that bends nothing the sun
// shines on a box over a floor. What a pixel has to show is the mean over its area of the sun's
// irradiance by the cosine on each face and on the floor, and of none in the box's shadow: by rays
// through many places of each pixel, against the box in closed form.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "framework/transport/brdf.h"
#include "framework/transport/types.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

constexpr double kSun = 100.0;  // W/m²
const glm::dvec3 kDirection = glm::normalize(glm::dvec3(-0.35, -0.9, -0.2));
const glm::dvec3 kMiddle(0.0, 0.3, 0.0);  // of the box, m
const glm::dvec3 kHalf(0.3, 0.25, 0.2);
constexpr int kWidth = 64;
constexpr int kHeight = 48;

// Of kSun and kDirection, and what a sheet of no effect is made of.
const std::string kSunThroughAir = R"(
[[light]]
name = "sun"
type = "directional"
irradiance = 100
direction = [-0.35, -0.9, -0.2]
[[material]]
name = "grey"
type = "lambertian"
albedo = 0.5
[[material]]
name = "air"
type = "dielectric"
ior = 1
)";

// A lobe that is wide enough for every face to show it.
const glm::dvec3 kSpecular(0.4);
constexpr double kExponent = 3.0;

// `material`: of box and floor.
scene::Scene boxUnderAir(const std::string& material = "grey") {
    return sceneFromText(R"(
name = "box under air"
[camera]
position = [0.9, 1.0, 1.4]
target = [0, 0.2, 0]
vertical_fov_degrees = 45
)" + kSunThroughAir + R"(
[[material]]
name = "glossy"
type = "glossy"
albedo = 0.5
specular = 0.4
exponent = 3
[[object]]
name = "sheet"
shape = "plane"
material = "air"
size = [8, 8]
position = [0, 2, 0]
[[object]]
name = "floor"
shape = "plane"
size = [6, 6]
material = ")" + material +
                         R"("
[[object]]
name = "box"
shape = "box"
size = [0.6, 0.5, 0.4]
position = [0, 0.3, 0]
material = ")" + material +
                         R"("
)");
}

struct BoxHit {
    double distance = std::numeric_limits<double>::infinity();
    glm::dvec3 normal{0.0};
};

// Where a ray enters the box.
std::optional<BoxHit> hitBox(const glm::dvec3& origin, const glm::dvec3& direction) {
    BoxHit hit{-std::numeric_limits<double>::infinity(), glm::dvec3(0.0)};
    double leaves = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0) {
            if (std::abs(origin[axis] - kMiddle[axis]) > kHalf[axis]) return {};
            continue;
        }
        const double sign = direction[axis] > 0.0 ? 1.0 : -1.0;
        const double enters = (kMiddle[axis] - sign * kHalf[axis] - origin[axis]) / direction[axis];
        leaves =
            std::min(leaves, (kMiddle[axis] + sign * kHalf[axis] - origin[axis]) / direction[axis]);
        if (enters > hit.distance) {
            hit.distance = enters;
            hit.normal = glm::dvec3(0.0);
            hit.normal[axis] = -sign;
        }
    }
    if (hit.distance > leaves || hit.distance < 1e-9) return {};
    return hit;
}

struct Seen {
    int surface = -1;  // 0: floor; 1 to 3: a face of the box, by axis
    double irradiance = 0.0;
    glm::dvec3 normal{0.0};
};

Seen seenAlong(const glm::dvec3& origin, const glm::dvec3& direction) {
    const std::optional<BoxHit> box = hitBox(origin, direction);
    const double toFloor =
        direction.y < 0.0 ? -origin.y / direction.y : std::numeric_limits<double>::infinity();
    if (box && box->distance < toFloor) {
        const double cosine = -glm::dot(box->normal, kDirection);
        const int face = box->normal.x != 0.0 ? 1 : box->normal.y != 0.0 ? 2 : 3;
        return {face, kSun * std::max(cosine, 0.0), box->normal};
    }
    const glm::dvec3 there = origin + toFloor * direction;
    if (!std::isfinite(toFloor) || std::max(std::abs(there.x), std::abs(there.z)) > 3.0) return {};
    return {0, hitBox(there, -kDirection) ? 0.0 : -kSun * kDirection.y, {0.0, 1.0, 0.0}};
}

// What a pixel has to show: irradiance, W/m², or of what is glossy radiance, W/m²/sr.
double shown(const Seen& seen, const glm::dvec3& direction, bool isGlossy) {
    if (!isGlossy) return seen.irradiance;
    return seen.irradiance * transport::receiverBrdf(glm::dvec3(0.5), kSpecular, kExponent,
                                                     seen.normal, -kDirection, -direction)
                                 .g;
}

struct Errors {
    double atEdges = 0.0;  // mean, of what pixels show
    double elsewhere = 0.0;
    double energy = 0.0;  // of the pixels at edges, over what it should be
    int edges = 0;
};

struct Shown {
    std::string edges = "samples";  // reconstruct.triangles.coverage
    bool isGlossy = false;
    bool asOnGpu = false;
};

Errors errorsWith(const Shown& how) {
    const auto& [edges, isGlossy, asOnGpu] = how;
    std::vector<std::string> saved{"eye.receiver"};
    if (isGlossy) saved.emplace_back("caustic.radiance");
    const Frame frame(
        boxUnderAir(isGlossy ? "glossy" : "grey"),
        {.width = kWidth,
         .height = kHeight,
         .settings = {{"emit.photons", "512x512"}, {"reconstruct.triangles.coverage", edges}},
         .saved = saved,
         .asOnGpu = asOnGpu},
        "exact_rays");
    const Texels found = isGlossy ? frame.read("caustic.radiance") : frame.causticIrradiance();
    const Texels receiver = frame.read("eye.receiver");
    const glm::dvec3 eye(0.9, 1.0, 1.4);
    Errors errors;
    double sum = 0.0;
    double wanted = 0.0;
    int elsewhere = 0;
    for (int y = 1; y + 1 < kHeight; ++y) {
        for (int x = 1; x + 1 < kWidth; ++x) {
            if (receiver.at(x, y, 0) <= 0.0f) continue;
            // The picture's plane, by its pixels' middles at one depth.
            const glm::dvec3 middle = frame.worldAt(x, y, 1.0);
            const glm::dvec3 right =
                0.5 * (frame.worldAt(x + 1, y, 1.0) - frame.worldAt(x - 1, y, 1.0));
            const glm::dvec3 up =
                0.5 * (frame.worldAt(x, y + 1, 1.0) - frame.worldAt(x, y - 1, 1.0));
            constexpr int kSide = 16;
            double mean = 0.0;
            std::array<int, 5> counts{};
            double lowest = kSun;
            double highest = 0.0;
            for (int i = 0; i < kSide * kSide; ++i) {
                const double column = (i % kSide + 0.5) / kSide - 0.5;
                const double row = (i / kSide + 0.5) / kSide - 0.5;
                const glm::dvec3 direction =
                    glm::normalize(middle + column * right + row * up - eye);
                const Seen seen = seenAlong(eye, direction);
                mean += shown(seen, direction, isGlossy) / (kSide * kSide);
                ++counts[static_cast<std::size_t>(seen.surface + 1)];
                lowest = std::min(lowest, seen.irradiance);
                highest = std::max(highest, seen.irradiance);
            }
            const bool isOne =
                std::any_of(counts.begin(), counts.end(), [](int n) { return n == kSide * kSide; });
            if (counts[0] > 0) continue;  // next to the floor's end
            const double error = std::abs(static_cast<double>(found.rgb(x, y).g) - mean);
            if (!isOne) {
                ++errors.edges;
                errors.atEdges += error;
                sum += static_cast<double>(found.rgb(x, y).g);
                wanted += mean;
            } else if (highest - lowest < 1e-6) {
                ++elsewhere;
                errors.elsewhere += error;
            }
        }
    }
    errors.atEdges /= errors.edges;
    errors.elsewhere /= elsewhere;
    errors.energy = sum / wanted;
    return errors;
}

// By whom the places are looked at, and whether each of a pixel's parts has the lobe of its own
// face, which the sun and the eye meet alike there.
class TrianglesAtEdgesOf : public testing::TestWithParam<Shown> {};

TEST_P(TrianglesAtEdgesOf, ShowTheMeanOfWhatIsSeenThere) {
    const Shown& how = GetParam();
    const Errors middle = errorsWith({"middle", how.isGlossy, how.asOnGpu});
    const Errors samples = errorsWith(how);
    ASSERT_GT(samples.edges, 100);
    // Four places tell a quarter of the pixel from none.
    EXPECT_LT(samples.atEdges, 0.5 * middle.atEdges);
    EXPECT_NEAR(samples.energy, 1.0, 0.02);
    // The flux of what the edge's pixels did not show was on the pixels next to them.
    EXPECT_LT(samples.elsewhere, 0.5 * middle.elsewhere);
}

INSTANTIATE_TEST_SUITE_P(A, TrianglesAtEdgesOf,
                         testing::Values(Shown{"samples", false, false},
                                         Shown{"samples", false, true},
                                         Shown{"samples", true, false}),
                         [](const testing::TestParamInfo<Shown>& shown) {
                             return std::string(shown.param.isGlossy ? "Glossy" : "Grey") +
                                    (shown.param.asOnGpu ? "BoxAsOnAGpu" : "Box");
                         });

TEST(TrianglesAtEdges, KeepTheLedgerClosed) {
    const Frame frame(boxUnderAir(), kWidth, kHeight, {{"emit.photons", "256x256"}}, {}, false,
                      "exact_rays");
    const EnergyLedger ledger = frame.renderer().ledger();
    EXPECT_GT(ledger.watts[transport::kAccountDeposited], 0.0);
    EXPECT_LT(std::abs(ledger.balance()), 1e-6);
}

// So many small boxes that nearly every pixel sees two of their faces: more than there is room for.
TEST(TrianglesAtEdges, ShowTheirMiddlesWhereTheyAreTooMany) {
    std::string text = R"(
name = "many boxes"
[camera]
position = [0.0, 2.0, 1.2]
target = [0, 0, 0]
vertical_fov_degrees = 40
)" + kSunThroughAir + R"(
[[object]]
name = "sheet"
shape = "plane"
material = "air"
size = [4, 4]
position = [0, 1, 0]
)";
    for (int i = 0; i < 28 * 21; ++i) {
        text += fmt::format(
            "[[object]]\nname = \"box {}\"\nshape = \"box\"\nmaterial = \"grey\"\n"
            "size = [0.05, 0.05, 0.05]\nposition = [{}, 0, {}]\n",
            i, 0.08 * (i % 28 - 13.5), 0.08 * (i / 28 - 10));
    }
    const scene::Scene scene = sceneFromText(text);
    const auto irradianceWith = [&](const std::string& coverage) {
        std::vector<std::string> saved;
        if (coverage == "samples") saved.emplace_back("edges.receiver");
        const Frame frame(
            scene, kWidth, kHeight,
            {{"emit.photons", "128x128"}, {"reconstruct.triangles.coverage", coverage}}, saved,
            false, "exact_rays");
        if (!saved.empty()) {
            const Texels receiver = frame.read("edges.receiver");
            for (std::size_t i = 2; i < receiver.values.size(); i += 4)
                EXPECT_EQ(receiver.values[i], 0.0f);
        }
        return frame.causticIrradiance().values;
    };
    const std::vector<float> samples = irradianceWith("samples");
    EXPECT_GT(*std::max_element(samples.begin(), samples.end()), 50.0f);
    EXPECT_EQ(samples, irradianceWith("middle"));
}

}  // namespace
}  // namespace kaustik::test
