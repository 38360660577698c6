// SPDX-License-Identifier: MIT
// common/ray_segment.glsl against clipping and projection in double (HARD_CASES.md, A: 1 to 5).
#include <cmath>

#include "framework/transport/types.h"
#include "tests/gpu/compute_probe.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using namespace transport;

constexpr double kNear = 0.01;
constexpr int kSide = 8192;

// A square picture, 90 degrees wide, in the middle of bounds of ±2000 m.
gl::Buffer viewBlock() {
    ViewData data{};
    data.tangents = {1.0f, 1.0f, static_cast<float>(kNear), 2.0f / kSide};
    data.sizePixels = {kSide, kSide, 1.0f / kSide, 1.0f / kSide};
    data.viewToWorld = glm::mat4(1.0f);
    data.boundsHalfExtent = glm::vec4(2000.0f);
    return {sizeof(data), &data, "view"};
}

struct Ray {
    glm::vec3 origin;
    glm::vec3 direction;
    float index = 0.0f;
    float count = 1.0f;
};

struct Segment {
    bool visible;
    unsigned cause;
    double nearT, farT;
    glm::dvec2 nearPixel, farPixel;
    double depth, parameter;
    int steps;
};

std::vector<Segment> clip(const std::vector<Ray>& rays) {
    const gl::Buffer view = [] {
        static_cast<void>(context());
        return viewBlock();
    }();
    std::vector<glm::vec4> inputs;
    for (const Ray& ray : rays) {
        inputs.emplace_back(ray.origin, ray.index);
        inputs.emplace_back(ray.direction, ray.count);
    }
    const std::vector<glm::vec4> out =
        probe("tests/gpu/shaders/ray_segment.comp", inputs, static_cast<int>(rays.size()), 3,
              [&](gl::Command& command) { command.uniforms("View", view); });
    std::vector<Segment> segments;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const glm::dvec4 a(out[3 * i]);
        const glm::dvec4 b(out[3 * i + 1]);
        const glm::dvec4 c(out[3 * i + 2]);
        segments.push_back({a.x > 0.5,
                            static_cast<unsigned>(a.y),
                            a.z,
                            a.w,
                            {b.x, b.y},
                            {b.z, b.w},
                            c.x,
                            c.y,
                            static_cast<int>(c.z)});
    }
    return segments;
}

TEST(RaySegment, IsCutAtTheNearPlaneBeforeAnythingIsDivided) {
    // Comes towards the eye, crosses the near plane at t = (near - 1)/d_z and goes on behind the
    // eye.
    const glm::vec3 direction = glm::normalize(glm::vec3(0.0f, 0.001f, 1.0f));
    const Segment s = clip({{glm::vec3(0, 0, -1), direction}}).front();
    ASSERT_TRUE(s.visible);
    EXPECT_EQ(s.cause, kAccountBehindEye);
    // The near plane lies 1 - near away; a float of 1 m resolves 1.2e-7 m.
    EXPECT_NEAR(s.farT, (1.0 - kNear) / static_cast<double>(direction.z), 2.4e-7);
    EXPECT_TRUE(std::isfinite(s.farPixel.y));
    EXPECT_GT(s.farPixel.y, s.nearPixel.y);
}

TEST(RaySegment, WhollyBehindTheEyeHasNoFragment) {
    const Segment s = clip({{glm::vec3(0, 0, 1), glm::vec3(0, 0, 1)}}).front();
    EXPECT_FALSE(s.visible);
    EXPECT_EQ(s.cause, kAccountBehindEye);
}

TEST(RaySegment, BesideTheScreenHasNoFragmentAndIsCountedSo) {
    const Segment s = clip({{glm::vec3(5, 0, -1), glm::vec3(1, 0, 0)}}).front();
    EXPECT_FALSE(s.visible);
    EXPECT_EQ(s.cause, kAccountOffScreen);
}

TEST(RaySegment, ThatLeavesThroughASideOfTheScreenIsOffScreen) {
    const Segment s = clip({{glm::vec3(0, 0, -1), glm::vec3(1, 0, 0)}}).front();
    ASSERT_TRUE(s.visible);
    EXPECT_EQ(s.cause, kAccountOffScreen);
    EXPECT_NEAR(s.farT, 1.0, 1e-6);
    // The right edge, to what a float of 8192 pixels resolves.
    EXPECT_NEAR(s.farPixel.x, kSide, 2e-3);
}

TEST(RaySegment, AlongTheViewDirectionKeepsTheLeastLength) {
    const auto segments =
        clip({{glm::vec3(0, 0, -1), glm::vec3(0, 0, -1)},
              {glm::vec3(0.5f, 0.25f, -1), glm::normalize(glm::vec3(0.5f, 0.25f, -1))}});
    for (const Segment& s : segments) {
        ASSERT_TRUE(s.visible);
        EXPECT_EQ(s.steps, 4);
        EXPECT_NEAR(s.nearPixel.x, s.farPixel.x, 1e-2);
    }
    EXPECT_EQ(segments[0].cause, kAccountUnresolved);
}

TEST(RaySegment, TheMiddleOnTheScreenOfZ1To100IsAtDepthTwo) {
    // Not at 50.5: 1/z is what interpolates linearly, and 2/(1/1 + 1/100) is 1.980. The bounds cut
    // the ray later, so the middle's index follows from the pixels.
    const glm::dvec3 from(0.0, 0.0, -1.0);
    const glm::dvec3 to(50.0, 0.0, -100.0);
    const glm::dvec3 direction = glm::normalize(to - from);
    const Segment whole = clip({{glm::vec3(from), glm::vec3(direction)}}).front();
    const auto pixelX = [](const glm::dvec3& p) { return (p.x / -p.z * 0.5 + 0.5) * kSide; };
    const double middle = 0.5 * (pixelX(from) + pixelX(to));
    const double share = (middle - whole.nearPixel.x) / (whole.farPixel.x - whole.nearPixel.x);
    const Segment s =
        clip({{glm::vec3(from), glm::vec3(direction), static_cast<float>(share * 8192), 8192.0f}})
            .front();
    EXPECT_NEAR(s.depth, 1.980, 2e-3);
}

TEST(RaySegment, DepthOverALongRayIsRightToTwentyBits) {
    // z = 0.01 … 1000 over the whole width: the far end would be 17,044 by adding increments.
    const glm::dvec3 from(-0.0099, 0.0, -0.01);
    const glm::dvec3 to(990.0, 0.0, -1000.0);
    const glm::dvec3 direction = glm::normalize(to - from);
    std::vector<Ray> rays;
    constexpr int kCases = 4096;
    for (int i = 0; i <= kCases; ++i) {
        rays.push_back({glm::vec3(from), glm::vec3(direction), static_cast<float>(i),
                        static_cast<float>(kCases)});
    }
    double worst = 0.0;
    // Exact for the ends that the shader has found: only the interpolation is tried here.
    const std::vector<Segment> segments = clip(rays);
    for (int i = 0; i <= kCases; ++i) {
        const Segment& s = segments[static_cast<std::size_t>(i)];
        const double z0 = -static_cast<double>(glm::vec3(from).z) -
                          s.nearT * static_cast<double>(glm::vec3(direction).z);
        const double z1 = -static_cast<double>(glm::vec3(from).z) -
                          s.farT * static_cast<double>(glm::vec3(direction).z);
        const double t = static_cast<double>(i) / kCases;
        const double exact = 1.0 / ((1.0 - t) / z0 + t / z1);
        worst = std::max(worst, std::abs(s.depth / exact - 1.0));
    }
    EXPECT_LT(worst, std::exp2(-20.0));
}

}  // namespace
}  // namespace kaustik::test
