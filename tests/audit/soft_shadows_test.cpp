// SPDX-License-Identifier: MIT
// Soft shadows of a post under a panel and under a wide sun, by points of the light, against rays
// to a thousand places all over it.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "framework/reference/eye.h"
#include "framework/reference/shadow_rays.h"
#include "framework/scene/emitters.h"
#include "tests/audit/shipped_scenes.h"

namespace kaustik::test {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;

struct Lamp {
    const char* name;
    const char* text;
};
constexpr Lamp kPanel{"Panel", R"(
[[material]]
name = "lamp"
type = "lambertian"
albedo = 0
emission = 10
[[object]]
name = "panel"
shape = "plane"
material = "lamp"
size = [0.6, 0.6]
position = [-0.8, 2, 0.3]
rotation_degrees = [180, 0, 0]
)"};
constexpr Lamp kSun{"Sun", R"(
[[light]]
name = "sun"
type = "directional"
irradiance = 10
direction = [0.5, -1, -0.2]
angular_diameter_degrees = 8
)"};

class SoftShadows : public testing::TestWithParam<Lamp> {
  protected:
    scene::Scene scene_ = sceneFromText(std::string(R"(
name = "post"
[camera]
position = [0.4, 1.3, 2.2]
target = [0.3, 0.1, 0]
vertical_fov_degrees = 40
[[material]]
name = "grey"
type = "lambertian"
albedo = 0.5
[[object]]
name = "floor"
shape = "plane"
material = "grey"
size = [6, 6]
[[object]]
name = "post"
shape = "box"
material = "grey"
size = [0.15, 0.8, 0.15]
position = [0, 0.4, 0]
)") + GetParam().text);

    // What a place on the floor gets from one of the light's, if nothing is in the way.
    [[nodiscard]] static double irradianceOf(const scene::Light& light, const glm::dvec3& at) {
        if (light.kind == scene::LightKind::directional)
            return static_cast<double>(light.power.g) * std::max(-light.direction.y, 0.0);
        const glm::dvec3 offset = at - light.position;
        const double distance = glm::length(offset);
        const double leaving = std::max(glm::dot(offset / distance, light.direction), 0.0);
        return static_cast<double>(light.power.g) * leaving * std::max(-offset.y / distance, 0.0) /
               (distance * distance);
    }

    // W/m² at each pixel's middle that sees the floor; -1 at others.
    [[nodiscard]] std::vector<double> byPoints(int points) {
        scene::placeLightPoints(scene_, points, kHeight);
        const auto renderer =
            rendered(registry_, scene_, kWidth, kHeight, Purpose::audit, {{"shadow", "bvh"}});
        const std::vector<float> texels =
            renderer->texture(renderer->outputs().shadows.visibility).read();
        const std::size_t layer = static_cast<std::size_t>(kWidth) * kHeight;
        const std::size_t channels = texels.size() / layer / scene_.lights.size();
        return onTheFloor([&](int x, int y, const reference::SurfaceHit&, const glm::dvec3& at) {
            const auto texel = static_cast<std::size_t>((kHeight - 1 - y) * kWidth + x);
            double sum = 0.0;
            for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
                sum += static_cast<double>(texels[(i * layer + texel) * channels]) *
                       irradianceOf(scene_.lights[i], at);
            }
            return sum;
        });
    }

    [[nodiscard]] std::vector<double> byRays() {
        constexpr int kSide = 32;
        scene::Scene many = scene_;
        scene::placeLightPoints(many, kSide * kSide, kHeight);
        const reference::ShadowRays rays(embree_);
        return onTheFloor([&](int, int, const reference::SurfaceHit& hit, const glm::dvec3& at) {
            double sum = 0.0;
            for (const scene::Light& light : many.lights) {
                const bool isFar = light.kind == scene::LightKind::directional;
                const glm::dvec3 offset = isFar ? -light.direction : light.position - at;
                const double meters =
                    isFar ? std::numeric_limits<double>::infinity() : glm::length(offset);
                if (!rays.isBlocked(hit, {0, 1, 0}, glm::normalize(offset), meters))
                    sum += irradianceOf(light, at);
            }
            return sum;
        });
    }

    template <class F>
    [[nodiscard]] std::vector<double> onTheFloor(const F& irradiance) const {
        const reference::Eye eye(embree_, kWidth, kHeight);
        std::vector<double> all(static_cast<std::size_t>(kWidth) * kHeight, -1.0);
        for (int y = 0; y < kHeight; y += 1) {
            for (int x = 0; x < kWidth; x += 1) {
                reference::SurfaceHit hit;
                const glm::dvec3 ray = glm::normalize(eye.ray(x + 0.5, y + 0.5));
                if (!embree_.intersectStraight(eye.position(), ray, hit)) continue;
                const glm::dvec3 at = hit.position + embree_.center();
                if (std::abs(at.y) > 1e-4) continue;
                all[static_cast<std::size_t>(y * kWidth + x)] = irradiance(x, y, hit, at);
            }
        }
        return all;
    }

    Registry registry_ = registerAll();
    reference::EmbreeScene embree_{scene_};
};

// Root of the mean square, of what is neither dark nor the brightest, relative to that.
double errorInHalfShadow(const std::vector<double>& found, const std::vector<double>& truth) {
    double lit = 0.0;
    for (const double value : truth)
        lit = std::max(lit, value);
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        if (truth[i] < 0.02 * lit || truth[i] > 0.98 * lit) continue;
        sum += (found[i] - truth[i]) * (found[i] - truth[i]) / (lit * lit);
        ++count;
    }
    EXPECT_GT(count, 60);
    return std::sqrt(sum / std::max(count, 1));
}

TEST_P(SoftShadows, AgreeWithRaysToAllOfTheLight) {
    const std::vector<double> truth = byRays();
    const double few = errorInHalfShadow(byPoints(4), truth);
    const double some = errorInHalfShadow(byPoints(16), truth);
    const double many = errorInHalfShadow(byPoints(64), truth);
    RecordProperty("error_of_4_points", std::to_string(few));
    RecordProperty("error_of_16_points", std::to_string(some));
    RecordProperty("error_of_64_points", std::to_string(many));
    EXPECT_LT(many, 0.02);
    EXPECT_LT(some, 0.06);
    EXPECT_LT(2.0 * many, some);
    EXPECT_LT(some, few);
}

INSTANTIATE_TEST_SUITE_P(Of, SoftShadows, testing::Values(kPanel, kSun),
                         [](const testing::TestParamInfo<Lamp>& lamp) { return lamp.param.name; });

}  // namespace
}  // namespace kaustik::test
