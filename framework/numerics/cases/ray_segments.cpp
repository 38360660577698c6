// SPDX-License-Identifier: MIT
// A1 to A5 and A7 on include/views/ray_segment.glsl: how every screen-space tracer clips and
// interpolates a photon's ray, against clipping and projection in double.
#include <algorithm>
#include <cmath>

#include "framework/numerics/cases/common_cases.h"
#include "framework/numerics/lab.h"
#include "framework/numerics/probe.h"
#include "framework/transport/types.h"

namespace kaustik::numerics {
namespace {

using namespace transport;

constexpr const char* kFile = "include/views/ray_segment.glsl";
constexpr double kNear = 0.01;
constexpr int kSide = 8192;
// The coordinates here are of about 1 m.
const Tolerance kTwoUlpOfMeter{2.4e-7, "two steps of a 32-bit float at 1 m"};

// A square picture, 90 degrees wide, in the middle of bounds of ±2000 m.
gl::Buffer viewBlock() {
    ViewData data{};
    data.frustum = {1.0f, 1.0f, static_cast<float>(kNear), 2.0f / kSide};
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

std::vector<Segment> clip(Lab& lab, const std::vector<Ray>& rays) {
    const gl::Buffer view = viewBlock();
    std::vector<glm::vec4> inputs;
    for (const Ray& ray : rays) {
        inputs.emplace_back(ray.origin, ray.index);
        inputs.emplace_back(ray.direction, ray.count);
    }
    const std::vector<glm::vec4> out =
        probe(lab.context(), "numerics/ray_segment.comp", inputs, static_cast<int>(rays.size()), 3,
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

void expectCause(Lab& lab, const std::string& what, unsigned account, const Segment& segment) {
    lab.expect(kFile, what, account, segment.cause, kExactly);
}

void crossesTheNearPlane(Lab& lab) {
    // Comes towards the eye and goes on behind it.
    const glm::vec3 direction = glm::normalize(glm::vec3(0.0f, 0.001f, 1.0f));
    const Segment s = clip(lab, {{glm::vec3(0, 0, -1), direction}}).front();
    lab.expect(kFile, "t of the far end, m", (1.0 - kNear) / static_cast<double>(direction.z),
               s.farT, kTwoUlpOfMeter);
    const double t = (1.0 - kNear) / static_cast<double>(direction.z);
    const double y = t * static_cast<double>(direction.y);
    lab.expect(kFile, "pixel of the far end", (y / kNear * 0.5 + 0.5) * kSide, s.farPixel.y,
               {0.5,
                "t is known to 1.2e-7 m of the near plane's 0.01 m: 1.2e-5 of 0.1 of the "
                "picture, and half a pixel is what a step can tell"});
    expectCause(lab, "cause if nothing is hit: behind the eye", kAccountBehindEye, s);
}

void liesBehindTheEye(Lab& lab) {
    const Segment s = clip(lab, {{glm::vec3(0, 0, 1), glm::vec3(0, 0, 1)}}).front();
    lab.expect(kFile, "parts on the screen", 0, s.visible ? 1 : 0, kExactly);
    expectCause(lab, "cause: behind the eye", kAccountBehindEye, s);
}

void runsAlongTheViewDirection(Lab& lab) {
    const auto segments =
        clip(lab, {{glm::vec3(0, 0, -1), glm::vec3(0, 0, -1)},
                   {glm::vec3(0.5f, 0.25f, -1), glm::normalize(glm::vec3(0.5f, 0.25f, -1))}});
    const char* const names[] = {"parallel to the view direction", "through the eye"};
    for (std::size_t i = 0; i < 2; ++i) {
        const std::string name = names[i];
        lab.expect(kFile, "steps of a ray " + name, 4, segments[i].steps,
                   {0.0, "the least length that the case asks for"});
        lab.expect(
            kFile, "length on the screen of a ray " + name + ", pixels", 0.0,
            glm::length(segments[i].farPixel - segments[i].nearPixel),
            {1e-2, "the direction is unit to 6e-8, over 2000 m of a picture of 8192 pixels"});
    }
}

void hasItsScreenMiddleAtTheHarmonicMean(Lab& lab) {
    // The bounds cut the ray later, so the middle's index follows from the pixels.
    const glm::dvec3 from(0.0, 0.0, -1.0);
    const glm::dvec3 to(50.0, 0.0, -100.0);
    const glm::dvec3 direction = glm::normalize(to - from);
    const Segment whole = clip(lab, {{glm::vec3(from), glm::vec3(direction)}}).front();
    const auto pixelX = [](const glm::dvec3& p) { return (p.x / -p.z * 0.5 + 0.5) * kSide; };
    const double middle = 0.5 * (pixelX(from) + pixelX(to));
    const double share = (middle - whole.nearPixel.x) / (whole.farPixel.x - whole.nearPixel.x);
    const Segment s =
        clip(lab,
             {{glm::vec3(from), glm::vec3(direction), static_cast<float>(share * 8192), 8192.0f}})
            .front();
    lab.expect(kFile, "view depth at the middle of z = 1 to 100 m on the screen, m",
               2.0 / (1.0 / 1.0 + 1.0 / 100.0), s.depth,
               {1e-3,
                "the ends on the screen are known to 1e-3 of 8192 pixels, and depth doubles "
                "within half of them"});
}

void keepsDepthOverALongRay(Lab& lab) {
    // z = 0.01 … 1000 over the whole width: the far end would be 17,044 by adding increments.
    const glm::vec3 from(-0.0099f, 0.0f, -0.01f);
    const glm::vec3 direction(glm::normalize(glm::dvec3(990.0, 0.0, -1000.0) - glm::dvec3(from)));
    std::vector<Ray> rays;
    for (int i = 0; i <= kSide; ++i)
        rays.push_back({from, direction, static_cast<float>(i), static_cast<float>(kSide)});
    const std::vector<Segment> segments = clip(lab, rays);
    double worst = 0.0;
    for (int i = 0; i <= kSide; ++i) {
        // Exact for the ends that the shader has found: only the interpolation is tried here.
        const Segment& s = segments[static_cast<std::size_t>(i)];
        const double slope = -static_cast<double>(direction.z);
        const double z0 = -static_cast<double>(from.z) + s.nearT * slope;
        const double z1 = -static_cast<double>(from.z) + s.farT * slope;
        const double share = static_cast<double>(i) / kSide;
        const double exact = 1.0 / ((1.0 - share) / z0 + share / z1);
        worst = std::max(worst, std::abs(s.depth / exact - 1.0));
    }
    lab.expectDeviation(kFile, "worst relative error of depth over 8192 pixels", worst,
                        {std::exp2(-20.0), "2^-20, as the case asks for"});
}

void leavesTheScreen(Lab& lab) {
    const auto segments = clip(lab, {{glm::vec3(0, 0, -1), glm::vec3(1, 0, 0)},
                                     {glm::vec3(5, 0, -1), glm::vec3(1, 0, 0)}});
    lab.expect(kFile, "t where a ray leaves the screen, m", 1.0, segments[0].farT, kTwoUlpOfMeter);
    expectCause(lab, "cause of a ray that leaves: off screen", kAccountOffScreen, segments[0]);
    lab.expect(kFile, "parts on the screen of a ray beside it", 0, segments[1].visible ? 1 : 0,
               kExactly);
    expectCause(lab, "cause of a ray beside the screen: off screen", kAccountOffScreen,
                segments[1]);
}

}  // namespace

void addRaySegmentCases(Suite& suite) {
    suite.add("A1", "A ray that crosses the near plane is clipped in view space.",
              crossesTheNearPlane);
    suite.add("A2", "A ray wholly behind the eye hits nothing and is counted.", liesBehindTheEye);
    suite.add("A3", "A ray parallel to the view direction, or through the eye, is traced.",
              runsAlongTheViewDirection);
    suite.add("A4", "Depth interpolates as 1/z along a ray on the screen.",
              hasItsScreenMiddleAtTheHarmonicMean);
    suite.add("A5", "Depth stays right over the longest rays.", keepsDepthOverALongRay);
    suite.add("A7", "What cannot be seen is counted by its cause, and is no hit.", leavesTheScreen);
}

}  // namespace kaustik::numerics
