// SPDX-License-Identifier: MIT
// What every node of the stage `view` shows in mirrors (D37): a plane one, and two at right angles.
// The eye's rays are followed in double from rectangle to rectangle; a floor of four quadrants in
// two greys under even light tells by its radiance where each ray ends.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <optional>

#include "framework/numerics/cases/common_cases.h"
#include "framework/numerics/cases/scene_text.h"
#include "framework/numerics/lab.h"

namespace kaustik::numerics {
namespace {

constexpr double kFillLight = 3.0;
constexpr double kBackground = 2.0;
constexpr double kReflectance = 0.9;

// The face of a mirrored box that the eye sees: a rectangle at right angles to an axis.
struct Face {
    int axis = 2;
    double at = 0.0;
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};
};
const Face kFar{2, -2.0, {-1.2, 0.1, -2.0}, {1.2, 1.7, -2.0}};
const Face kRight{0, 1.2, {1.2, 0.1, -2.0}, {1.2, 1.7, 0.0}};

struct Setting {
    glm::dvec3 eye{0.0};
    glm::dvec3 target{0.0};
    std::vector<Face> faces;
};

scene::Scene sceneOf(const Setting& setting) {
    std::string parts;
    for (int quadrant = 0; quadrant < 4; ++quadrant) {
        const double x = quadrant % 2 == 0 ? -5.0 : 5.0;
        const double z = quadrant / 2 == 0 ? -5.0 : 5.0;
        parts += floorPlane(fmt::format("floor {}", quadrant), x * z > 0.0 ? "grey" : "white", 10,
                            {x, 0, z});
    }
    parts += object("far", "box", "mirror", {0, 0.9, -2.1}, "size = [2.4, 1.6, 0.2]");
    if (setting.faces.size() > 1)
        parts += object("right", "box", "mirror", {1.3, 0.9, -1}, "size = [0.2, 1.6, 2]");
    scene::Scene scene = makeScene({setting.eye, setting.target, 60.0, 0.01}, parts);
    scene.ambientIrradiance = glm::vec3(static_cast<float>(kFillLight));
    return scene;
}

struct ExactView {
    glm::dvec3 position{0.0};  // on the last mirror
    glm::dvec3 direction{0.0};
    double radiance = 0.0;
    int mirrors = 0;
    bool isShown = true;  // the screen shows every place that the ray hits
};

// Distance to a face along a ray; `isNearEdge`: rounding may decide whether it is hit.
std::optional<double> toFace(const Face& face, const glm::dvec3& from, const glm::dvec3& along,
                             bool& isNearEdge) {
    constexpr double kEdge = 0.03;
    if (std::abs(along[face.axis]) < 1e-9) return std::nullopt;
    const double t = (face.at - from[face.axis]) / along[face.axis];
    if (t < 1e-9) return std::nullopt;
    const glm::dvec3 p = from + t * along;
    double inside = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        if (axis == face.axis) continue;
        inside = std::min({inside, p[axis] - face.low[axis], face.high[axis] - p[axis]});
    }
    isNearEdge = isNearEdge || std::abs(inside) < kEdge;
    return inside > 0.0 ? std::optional(t) : std::nullopt;
}

bool isOnScreen(const Frame& frame, const glm::dvec3& world) {
    const render::RasterView& view = frame.view();
    const auto pixel = render::pixelOf(view, glm::dvec3(view.worldToView * glm::dvec4(world, 1.0)));
    constexpr double kBorder = 3.0;  // px
    return pixel && pixel->x > kBorder && pixel->y > kBorder && pixel->x < view.width - kBorder &&
           pixel->y < view.height - kBorder;
}

// What the ray of a pixel sees; nothing where it hits no mirror or comes too near to an edge.
std::optional<ExactView> follow(const Frame& frame, const Setting& setting, const glm::dvec3& ray) {
    ExactView view;
    view.position = setting.eye;
    view.direction = ray;
    double share = 1.0;
    for (;;) {
        bool isNearEdge = false;
        double nearest = std::numeric_limits<double>::infinity();
        const Face* hit = nullptr;
        for (const Face& face : setting.faces) {
            const auto t = toFace(face, view.position, view.direction, isNearEdge);
            if (t && *t < nearest) {
                nearest = *t;
                hit = &face;
            }
        }
        if (isNearEdge) return std::nullopt;
        const double toFloor =
            view.direction.y < 0.0 ? -view.position.y / view.direction.y : nearest;
        if (hit == nullptr || toFloor < nearest) {
            if (view.mirrors == 0) return std::nullopt;
            if (view.direction.y >= 0.0) {
                view.radiance = share * kBackground;
                return view;
            }
            const glm::dvec3 end = view.position + toFloor * view.direction;
            if (std::min(std::abs(end.x), std::abs(end.z)) < 0.08) return std::nullopt;
            view.isShown = view.isShown && isOnScreen(frame, end);
            const double albedo = end.x * end.z > 0.0 ? 0.5 : 1.0;
            view.radiance = share * kFillLight * albedo / glm::pi<double>();
            return view;
        }
        view.position += nearest * view.direction;
        view.isShown = view.isShown && isOnScreen(frame, view.position);
        view.direction[hit->axis] = -view.direction[hit->axis];
        share *= kReflectance;
        ++view.mirrors;
    }
}

struct Found {
    std::array<int, 3> shown{0, 0, 0};  // pixels by mirrors hit, all on the screen
    int wrong = 0;                      // of these: lost, or other mirrors hit
    double direction = 0.0;
    double position = 0.0;  // m
    double radiance = 0.0;  // relative
};

Found compare(const Frame& frame, const Setting& setting) {
    const View& seen = frame.renderer().outputs().picture.view;
    const Texels position = frame.read(seen.exitPosition);
    const Texels direction = frame.read(seen.exitDirection);
    const Texels radiance = frame.read(seen.radiance);
    const glm::dvec3 eye = frame.toWorld(glm::dvec3(0.0));
    Found found;
    for (int y = 0; y < position.height; ++y) {
        for (int x = 0; x < position.width; ++x) {
            const auto exact =
                follow(frame, setting, glm::normalize(frame.worldAt(x, y, 1.0) - eye));
            if (!exact || !exact->isShown || exact->mirrors > 2) continue;
            ++found.shown[static_cast<std::size_t>(exact->mirrors)];
            if (direction.at(x, y, 3) != transport::kPathExited ||
                position.at(x, y, 3) != static_cast<float>(exact->mirrors)) {
                ++found.wrong;
                continue;
            }
            found.direction =
                std::max(found.direction,
                         glm::length(frame.toWorld(direction.rgb(x, y)) - eye - exact->direction));
            found.position = std::max(
                found.position, glm::distance(frame.toWorld(position.rgb(x, y)), exact->position));
            found.radiance =
                std::max(found.radiance, std::abs(radiance.rgb(x, y).g / exact->radiance - 1.0));
        }
    }
    return found;
}

// Every node as it is by default, and where it has the choice with each answer to where it looks.
std::vector<Lab::Choice> viewNodes(const Lab& lab) {
    std::vector<Lab::Choice> choices;
    for (const std::string& node : lab.nodesOf(ViewStage::name)) {
        const Lab::Choice choice = lab.choose(ViewStage::name, node);
        const params::ParamSet params =
            lab.registry().makeParams(lab.registry().findTechnique(choice.technique));
        const std::string name = fmt::format("view.{}.surfaces", node);
        choices.push_back(choice);
        for (const params::NamedField& field : params.all()) {
            if (field.fullName != name) continue;
            choices.push_back(choice);
            choices.back().settings.emplace_back(name, "layers");
            choices.back().subject += " (layers)";
        }
    }
    return choices;
}

void expectMirrors(Lab& lab, const Setting& setting, int maxMirrors) {
    const scene::Scene scene = sceneOf(setting);
    for (const Lab::Choice& node : viewNodes(lab)) {
        const Frame frame = lab.render(node, scene, {160, 120, {}});
        const Found found = compare(frame, setting);
        for (int mirrors = 1; mirrors <= maxMirrors; ++mirrors) {
            const int pixels = found.shown[static_cast<std::size_t>(mirrors)];
            lab.expectAtLeast(node.subject,
                              fmt::format("pixels that look into {}",
                                          mirrors == 1 ? "one mirror" : "two mirrors in turn"),
                              200, pixels, kTooFewReason);
        }
        lab.expect(node.subject, "of these: lost, or into another number of mirrors", 0.0,
                   found.wrong, kExactly);
        lab.expectDeviation(node.subject, "direction in which a ray leaves its last mirror",
                            found.direction, {1e-6, "roundings of unit vectors of 6e-8"});
        lab.expectDeviation(node.subject, "where a ray leaves its last mirror, m", found.position,
                            {1e-5, "32-bit view depths at 5 m, divided by cosines"});
        lab.expectDeviation(node.subject, "radiance, reflectance to the power of the mirrors hit",
                            found.radiance, {1e-3, "albedo is kept in half floats"});
    }
}

}  // namespace

void addMirrorCases(Suite& suite) {
    suite.add("D37", "Mirrors show the scene, and one another.", [](Lab& lab) {
        expectMirrors(lab, {{0.0, 1.0, 2.0}, {0.0, 0.6, -2.0}, {kFar}}, 1);
        expectMirrors(lab, {{-0.3, 1.0, 2.0}, {0.6, 0.6, -2.0}, {kFar, kRight}}, 2);
    });
}

}  // namespace kaustik::numerics
