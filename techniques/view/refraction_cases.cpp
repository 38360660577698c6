// SPDX-License-Identifier: MIT
// Hard cases of the nodes that follow the eye's rays through specular surfaces, against closed
// forms in double: a plane-parallel slab (C25), an index of 1 (C19), total reflection and Snell's
// window (C22), a ball (F.ball), and that both searches find the same in convex bodies.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/exact.h"
#include "framework/numerics/lab.h"
#include "techniques/register_hard_cases.h"

namespace kaustik {
namespace {

using namespace numerics;

// A node with its settings.
struct Tested {
    Lab::Choice choice;
    std::string subject;
};

// Those that look for each interface along the ray.
std::vector<Tested> tracedViews(const Lab& lab) {
    std::vector<Tested> tested;
    for (const char* search : {"monotonic", "all"}) {
        Lab::Choice choice = lab.choose(ViewStage::name, "refraction");
        choice.settings.emplace_back("view.refraction.search", search);
        choice.subject += fmt::format(" ({})", search);
        tested.push_back({choice, choice.subject});
    }
    const Lab::Choice exact = lab.choose(ViewStage::name, "bvh");
    tested.push_back({exact, exact.subject});
    return tested;
}

std::vector<Tested> rayFollowingViews(const Lab& lab) {
    std::vector<Tested> tested = tracedViews(lab);
    const Lab::Choice other = lab.choose(ViewStage::name, "image_space");
    tested.push_back({other, other.subject});
    return tested;
}

const FrameRequest kRequest{160, 120, {{"emit.photons", "8x8"}}};

struct Exits {
    Texels position;   // view space, m
    Texels direction;  // view space
    Texels radiance;
};
Exits exitsOf(const Frame& frame) {
    const View& seen = frame.renderer().outputs().picture.view;
    return {frame.read(seen.exitPosition), frame.read(seen.exitDirection),
            frame.read(seen.radiance)};
}

// What the ray of a pixel does, in the world.
struct ExactExit {
    glm::dvec3 position{0.0};
    glm::dvec3 direction{0.0};
    int interfaces = 0;
};
struct Deviation {
    double direction = 0.0;  // largest
    double position = 0.0;   // m
    int pixels = 0;
    int wrong = 0;  // lost, or of another number of interfaces
};
// `exact`: for a ray from the eye, unit; nothing where the pixel is not asked.
Deviation compare(const Frame& frame, const Exits& exits,
                  const std::function<std::optional<ExactExit>(const glm::dvec3& eye,
                                                               const glm::dvec3& ray)>& exact) {
    const glm::dvec3 eye = frame.toWorld(glm::dvec3(0.0));
    Deviation deviation;
    for (int y = 0; y < exits.position.height; ++y) {
        for (int x = 0; x < exits.position.width; ++x) {
            const auto expected = exact(eye, glm::normalize(frame.worldAt(x, y, 1.0) - eye));
            if (!expected) continue;
            ++deviation.pixels;
            const bool isRight =
                exits.direction.at(x, y, 3) == 1.0f &&
                exits.position.at(x, y, 3) == static_cast<float>(expected->interfaces);
            if (!isRight) {
                ++deviation.wrong;
                continue;
            }
            const glm::dvec3 direction =
                frame.toWorld(exits.direction.rgb(x, y)) - frame.toWorld(glm::dvec3(0.0));
            const glm::dvec3 position = frame.toWorld(exits.position.rgb(x, y));
            deviation.direction =
                std::max(deviation.direction, glm::length(direction - expected->direction));
            deviation.position =
                std::max(deviation.position, glm::distance(position, expected->position));
        }
    }
    return deviation;
}

// A slab of 1 m, turned by 25 degrees about y.
void slab(Lab& lab) {
    const double turn = glm::radians(25.0);
    const glm::dvec3 normal(std::sin(turn), 0.0, std::cos(turn));
    const glm::dvec3 side(std::cos(turn), 0.0, -std::sin(turn));
    const glm::dvec3 center(0.0, 0.0, -4.0);
    const scene::Scene scene = makeScene(
        {{}, {0.0, 0.0, -1.0}, 40.0, 0.01},
        object("slab", "box", "glass", center, "size = [8, 8, 1]\nrotation_degrees = [0, 25, 0]"));
    const auto exact = [&](const glm::dvec3& eye,
                           const glm::dvec3& ray) -> std::optional<ExactExit> {
        const double toFront =
            glm::dot(center + 0.5 * normal - eye, normal) / glm::dot(ray, normal);
        const glm::dvec3 entry = eye + toFront * ray;
        const ExactInterface in = exactInterface(ray, normal, 1.0, kGlassIndex);
        const glm::dvec3 exit = entry - in.refracted / glm::dot(in.refracted, normal);
        for (const glm::dvec3& point : {entry, exit}) {
            const glm::dvec3 local = point - center;
            if (std::abs(glm::dot(local, side)) > 3.8 || std::abs(local.y) > 3.8)
                return std::nullopt;
        }
        return ExactExit{exit, ray, 2};
    };
    for (const Tested& tested : rayFollowingViews(lab)) {
        const Frame frame = lab.render(tested.choice, scene, kRequest);
        const Deviation found = compare(frame, exitsOf(frame), exact);
        lab.expect(tested.subject, "pixels that see through a slab", 160 * 120, found.pixels,
                   kExactly);
        lab.expect(tested.subject, "of these: lost, or not of two interfaces", 0.0, found.wrong,
                   kExactly);
        lab.expectDeviation(tested.subject, "exit direction, less the entry's", found.direction,
                            {2e-6, "roundings of 6e-8 in two refractions, and in the eye's ray"});
    }
    for (const Tested& tested : tracedViews(lab)) {
        const Frame frame = lab.render(tested.choice, scene, kRequest);
        const Deviation found = compare(frame, exitsOf(frame), exact);
        lab.expectDeviation(tested.subject, "exit point of a slab, m", found.position,
                            {2e-5, "32-bit view depths and normals at 5 m, divided by cosines"});
    }
}

// A ball of radius 1 at 4 m, whose rays within 0.9 of the radius hit two interfaces.
std::optional<ExactExit> throughBall(const glm::dvec3& eye, const glm::dvec3& ray) {
    const glm::dvec3 center(0.0, 0.0, -4.0);
    const glm::dvec3 toCenter = center - eye;
    const double along = glm::dot(toCenter, ray);
    const double square = glm::dot(toCenter, toCenter) - along * along;
    if (square > 0.81) return std::nullopt;
    const glm::dvec3 entry = eye + (along - std::sqrt(1.0 - square)) * ray;
    const ExactInterface in = exactInterface(ray, entry - center, 1.0, kGlassIndex);
    const glm::dvec3 exit = entry - 2.0 * glm::dot(in.refracted, entry - center) * in.refracted;
    const ExactInterface out = exactInterface(in.refracted, center - exit, kGlassIndex, 1.0);
    return ExactExit{exit, out.refracted, 2};
}

const std::string kFacets =
    "facets of 1/512 of the circumference lie 2e-5 of the radius below the ball, their normals are "
    "interpolated, and both refractions at 64 degrees of incidence multiply what is missing";

void ball(Lab& lab) {
    const scene::Scene scene =
        makeScene({{}, {0.0, 0.0, -1.0}, 36.0, 0.01},
                  object("ball", "sphere", "glass", {0, 0, -4}, "radius = 1\nsegments = 512"));
    std::vector<Exits> exits;
    for (const Tested& tested : tracedViews(lab)) {
        const Frame frame = lab.render(tested.choice, scene, kRequest);
        exits.push_back(exitsOf(frame));
        const Deviation found = compare(frame, exits.back(), throughBall);
        lab.expectAtLeast(tested.subject, "pixels of a ball that are compared", 5000, found.pixels,
                          kTooFewReason);
        lab.expect(tested.subject, "of these: lost, or not of two interfaces", 0.0, found.wrong,
                   kExactly);
        lab.expectDeviation(tested.subject, "exit direction of a ball", found.direction,
                            {2e-3, kFacets});
        lab.expectDeviation(tested.subject, "exit point of a ball, of its radius", found.position,
                            {1e-3, kFacets});
    }
    int different = 0;
    for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 160; ++x) {
            const bool isSame =
                exits[0].position.at(x, y, 3) == exits[1].position.at(x, y, 3) &&
                glm::distance(exits[0].direction.rgb(x, y), exits[1].direction.rgb(x, y)) < 1e-2;
            different += isSame ? 0 : 1;
        }
    }
    lab.expect("view.refraction", "pixels of a ball that the two searches see differently, share",
               0.0, different / (160.0 * 120.0),
               {2e-3, "pixels on the silhouette, of which there are 2 %"});
}

// Glass of index 1 over a floor: nothing bends, nothing is reflected.
void invisible(Lab& lab) {
    scene::Scene scene = makeScene(
        {{0.0, 1.5, 1.0}, {0.0, 0.4, -2.0}, 50.0, 0.01},
        sun({0.4, -1.0, -0.3}) +
            object("ball", "sphere", "glass", {0, 0.7, -2}, "radius = 0.6\nsegments = 128") +
            floorPlane("floor", "grey", 30, {0, 0, 0}));
    scene.materials[kGlass - 1].ior = 1.0f;
    const auto straight = [](const glm::dvec3& eye,
                             const glm::dvec3& ray) -> std::optional<ExactExit> {
        const glm::dvec3 toCenter = glm::dvec3(0, 0.7, -2) - eye;
        const double along = glm::dot(toCenter, ray);
        const double square = glm::dot(toCenter, toCenter) - along * along;
        if (square > 0.3) return std::nullopt;
        return ExactExit{eye + (along + std::sqrt(0.36 - square)) * ray, ray, 2};
    };
    for (const Tested& tested : rayFollowingViews(lab)) {
        const Frame frame = lab.render(tested.choice, scene, kRequest);
        const Exits exits = exitsOf(frame);
        const Deviation found = compare(frame, exits, straight);
        lab.expect(tested.subject, "lost in glass of index 1", 0.0, found.wrong, kExactly);
        lab.expectDeviation(tested.subject,
                            "direction beyond glass of index 1, less that in front of it",
                            found.direction, {1e-6, "roundings of unit vectors of 6e-8"});
        const Texels behind = frame.read("compose.receiver_radiance");
        double worst = 0.0;
        for (int y = 0; y < 120; ++y) {
            for (int x = 0; x < 160; ++x) {
                worst = std::max(worst, std::abs(exits.radiance.rgb(x, y).g - behind.rgb(x, y).g) /
                                            std::max(behind.rgb(x, y).g, 1.0));
            }
        }
        lab.expectDeviation(tested.subject, "radiance through glass of index 1, relative", worst,
                            {1e-2,
                             "looked up between pixels: 1e-4 pixels aside, at the edge of a "
                             "shadow of a hundred times the light"});
    }
}

// An eye 1 m under water that looks up: within asin(1/n) of the vertical it sees the sky with
// n² T of its radiance, outside of it all is reflected.
void snellsWindow(Lab& lab) {
    const double background = 2.0;
    const scene::Scene scene = makeScene({{0.0, -1.0, 0.0}, {0.0, 0.0, -0.3}, 110.0, 0.01},
                                         floorPlane("water", "water", 60, {0, 0, 0}));
    const glm::dvec3 down(0.0, -1.0, 0.0);
    const auto isQueried = [](const glm::dvec3& ray) {
        // The water's edge, and what rounding decides.
        const double sine = std::sqrt(1.0 - ray.y * ray.y);
        return ray.y > 0.06 && std::abs(sine * kWaterIndex - 1.0) > 1e-5;
    };
    for (const Tested& tested : rayFollowingViews(lab)) {
        const Frame frame = lab.render(tested.choice, scene, kRequest);
        const Exits exits = exitsOf(frame);
        int inside = 0;
        const Deviation found = compare(
            frame, exits,
            [&](const glm::dvec3& eye, const glm::dvec3& ray) -> std::optional<ExactExit> {
                if (!isQueried(ray)) return std::nullopt;
                const ExactInterface at = exactInterface(ray, down, kWaterIndex, 1.0);
                const bool isTotal = at.refracted == glm::dvec3(0.0);
                inside += isTotal ? 0 : 1;
                return ExactExit{eye + ray / ray.y, isTotal ? at.reflected : at.refracted, 1};
            });
        lab.expectAtLeast(tested.subject, "pixels in Snell's window", 1000, inside, kTooFewReason);
        lab.expectAtLeast(tested.subject, "pixels outside of Snell's window", 1000,
                          found.pixels - inside, kTooFewReason);
        lab.expect(tested.subject, "lost at the surface from below", 0.0, found.wrong, kExactly);
        lab.expectDeviation(
            tested.subject, "direction through the surface from below, or reflected",
            found.direction,
            {3e-4,
             "roundings of 6e-8 over the cosine of refraction, 1e-5 below the critical sine"});
        double worst = 0.0;
        const glm::dvec3 eye = frame.toWorld(glm::dvec3(0.0));
        for (int y = 0; y < 120; ++y) {
            for (int x = 0; x < 160; ++x) {
                const glm::dvec3 ray = glm::normalize(frame.worldAt(x, y, 1.0) - eye);
                if (!isQueried(ray)) continue;
                const ExactInterface at = exactInterface(ray, down, kWaterIndex, 1.0);
                const double share =
                    at.reflectance + (1.0 - at.reflectance) * kWaterIndex * kWaterIndex;
                worst = std::max(worst,
                                 std::abs(exits.radiance.rgb(x, y).g / (background * share) - 1.0));
            }
        }
        lab.expectDeviation(tested.subject, "radiance from below, n² T of the sky's, relative",
                            worst,
                            {1e-3,
                             "reflectance climbs to 1 like the square root of what is left "
                             "of the critical angle, 1e-5 here"});
    }
}

}  // namespace

void addRefractionCases(Suite& suite) {
    suite.add("C25", "", slab);
    suite.add("C19", "", invisible);
    suite.add("C22", "", snellsWindow);
    suite.add("F.ball", "A ray through a ball leaves where and as the closed form says.", ball);
}

}  // namespace kaustik
