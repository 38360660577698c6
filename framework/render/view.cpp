// SPDX-License-Identifier: MIT
#include "framework/render/view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace kaustik::render {
namespace {

constexpr double kMaxLightHalfAngle = 80.0 * 3.14159265358979323846 / 180.0;

std::array<glm::dvec3, 8> corners(const scene::Bounds& bounds) {
    std::array<glm::dvec3, 8> result{};
    for (unsigned i = 0; i < 8; ++i) {
        result[i] = {(i & 1u) != 0 ? bounds.maximum.x : bounds.minimum.x,
                     (i & 2u) != 0 ? bounds.maximum.y : bounds.minimum.y,
                     (i & 4u) != 0 ? bounds.maximum.z : bounds.minimum.z};
    }
    return result;
}

glm::dvec3 center(const scene::Bounds& bounds) {
    return 0.5 * (bounds.minimum + bounds.maximum);
}

// The diagonal of the box, for margins; never zero.
double diagonal(const scene::Bounds& bounds) {
    return std::max(glm::length(bounds.maximum - bounds.minimum), 1e-6);
}

}  // namespace

glm::mat4 RasterView::projection() const {
    glm::dmat4 p(0.0);
    p[0][0] = 1.0 / halfExtent.x;
    p[1][1] = 1.0 / halfExtent.y;
    if (isOrthographic) {
        // -z from near to far becomes 1 to 0.
        p[2][2] = 1.0 / (farMeters - nearMeters);
        p[3][2] = farMeters / (farMeters - nearMeters);
        p[3][3] = 1.0;
    } else {
        p[3][2] = nearMeters;
        p[2][3] = -1.0;
    }
    return glm::mat4(p);
}

std::optional<glm::dvec2> pixelOf(const RasterView& view, const glm::dvec3& positionVs) {
    const double depth = -positionVs.z;
    if (!(depth > 0.0)) return std::nullopt;
    const glm::dvec2 size(view.width, view.height);
    return (glm::dvec2(positionVs) / (depth * view.halfExtent) * 0.5 + 0.5) * size;
}

glm::dmat4 lookAlong(const glm::dvec3& position, const glm::dvec3& direction, glm::dvec3 up) {
    const glm::dvec3 unit = glm::normalize(direction);
    if (glm::length(glm::cross(unit, up)) < 1e-6 * glm::length(up)) {
        up = std::abs(unit.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
    }
    // Not by glm::lookAt, which takes a place to look at: of position + unit - position the digits
    // that are left depend on how far out the position is.
    const glm::dvec3 right = glm::normalize(glm::cross(unit, up));
    const glm::dmat3 axes = glm::transpose(glm::dmat3(right, glm::cross(right, unit), -unit));
    glm::dmat4 toView(axes);
    toView[3] = glm::dvec4(-(axes * position), 1.0);
    return toView;
}

RasterView makeEyeView(const scene::Camera& camera, int width, int height) {
    RasterView view;
    view.worldToView = lookAlong(camera.position, camera.target - camera.position, camera.up);
    view.halfExtent.y = std::tan(glm::radians(camera.verticalFovDegrees) / 2.0);
    view.halfExtent.x = view.halfExtent.y * width / height;
    view.nearMeters = camera.nearMeters;
    view.width = width;
    view.height = height;
    return view;
}

transport::ViewData viewData(const scene::Scene& scene, const RasterView& view,
                             const RasterView& eye) {
    transport::ViewData data{};
    data.frustum =
        glm::vec4(glm::dvec4(view.halfExtent, view.nearMeters, view.footprintPerMeter()));
    data.sizePixels =
        glm::vec4(glm::dvec4(view.width, view.height, 1.0 / view.width, 1.0 / view.height));
    data.viewToWorld = glm::mat4(glm::dmat4(glm::transpose(glm::dmat3(view.worldToView))));
    const scene::Bounds bounds = sceneBounds(scene);
    if (!bounds.empty) {
        // A margin, so that a surface that lies in the bounds' face is inside, and with it the
        // pixel that holds the ray's last point: its middle may lie beyond.
        double farthest = view.nearMeters;
        for (const glm::dvec3& corner : corners(bounds))
            farthest = std::max(farthest, -(view.worldToView * glm::dvec4(corner, 1.0)).z);
        const double pixel = view.footprintPerMeter() * (view.isOrthographic ? 1.0 : farthest);
        const double margin = 1e-4 * diagonal(bounds) + 2.0 * pixel;
        data.boundsCenterVs = glm::vec4(view.worldToView * glm::dvec4(center(bounds), 1.0));
        data.boundsHalfExtent =
            glm::vec4(glm::dvec4(0.5 * (bounds.maximum - bounds.minimum) + margin, margin));
    }
    data.fromEye = between(eye, view);
    data.farMeters = glm::vec4(static_cast<float>(view.farMeters), 0.0f, 0.0f, 0.0f);
    data.background = glm::vec4(scene.backgroundRadiance, 0.0f);
    data.ambient = glm::vec4(scene.ambientIrradiance, 0.0f);
    if (scene.medium) {
        const scene::Medium& medium = *scene.medium;
        data.mediumScattering = glm::vec4(medium.scatteringPerMeter, medium.anisotropy);
        data.mediumExtinction =
            glm::vec4(medium.scatteringPerMeter + medium.absorptionPerMeter, 0.0f);
    }
    data.environment =
        glm::vec4(static_cast<float>(scene.environmentImage),
                  static_cast<float>(glm::radians(scene.environmentTurnDegrees)), 0.0f, 0.0f);
    return data;
}

RasterView makeLightView(const scene::Light& light, const scene::Bounds& target,
                         const scene::Bounds& blockers) {
    RasterView view;
    if (light.kind == scene::LightKind::directional) {
        view.isOrthographic = true;
        view.worldToView = lookAlong(center(target), light.direction, glm::dvec3(0, 1, 0));
        glm::dvec2 low(1e300);
        glm::dvec2 high(-1e300);
        for (const glm::dvec3& corner : corners(target)) {
            const glm::dvec3 p(view.worldToView * glm::dvec4(corner, 1.0));
            low = glm::min(low, glm::dvec2(p));
            high = glm::max(high, glm::dvec2(p));
        }
        double nearest = 1e300;
        double farthest = -1e300;
        for (const scene::Bounds* bounds : {&target, &blockers}) {
            for (const glm::dvec3& corner : corners(*bounds)) {
                const double depth = -(view.worldToView * glm::dvec4(corner, 1.0)).z;
                nearest = std::min(nearest, depth);
                farthest = std::max(farthest, depth);
            }
        }
        // The plane that depth counts from lies in front of everything, so that no depth is
        // negative.
        const double margin = 1e-3 * diagonal(blockers);
        view.nearMeters = margin;
        view.farMeters = farthest - nearest + 3.0 * margin;
        const glm::dvec2 middle = 0.5 * (low + high);
        view.worldToView =
            glm::translate(glm::dmat4(1.0), glm::dvec3(-middle, nearest - 2.0 * margin)) *
            view.worldToView;
        // No margin at the sides: what the grid covers is what the surface receives.
        view.halfExtent = glm::max(0.5 * (high - low), glm::dvec2(1e-9));
        return view;
    }
    const glm::dvec3 axis = center(target) - light.position;
    const bool isInside = glm::length(axis) < 1e-9;
    view.worldToView =
        lookAlong(light.position, isInside ? light.direction : axis, glm::dvec3(0, 1, 0));
    const double widest = std::tan(kMaxLightHalfAngle);
    view.halfExtent = glm::dvec2(1e-6);
    for (const glm::dvec3& corner : corners(target)) {
        const glm::dvec3 p(view.worldToView * glm::dvec4(corner, 1.0));
        const double depth = -p.z;
        for (int i = 0; i < 2; ++i) {
            const bool isTooWide = depth <= 0.0 || std::abs(p[i]) > widest * depth;
            view.isClipped = view.isClipped || isTooWide;
            view.halfExtent[i] =
                std::max(view.halfExtent[i], isTooWide ? widest : std::abs(p[i]) / depth);
        }
    }
    view.nearMeters = 1e-4 * diagonal(blockers);
    return view;
}

RasterView makeCubeFaceView(const glm::dvec3& center, int face) {
    static const std::array<glm::dvec3, 6> kDirections = {
        glm::dvec3(1, 0, 0),  glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0),
        glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1),  glm::dvec3(0, 0, -1)};
    RasterView view;
    view.worldToView =
        lookAlong(center, kDirections[static_cast<std::size_t>(face)], glm::dvec3(0, 1, 0));
    view.nearMeters = 1e-3;
    return view;
}

RasterView inPixels(RasterView view, int width, int height) {
    view.width = width;
    view.height = height;
    const double side = std::max(view.halfExtent.x / width, view.halfExtent.y / height);
    view.halfExtent = side * glm::dvec2(width, height);
    return view;
}

glm::mat4 between(const RasterView& from, const RasterView& to) {
    return glm::mat4(to.worldToView * glm::inverse(from.worldToView));
}

transport::LightData lightData(const scene::Light& light, const RasterView& eye) {
    transport::LightData data{};
    data.positionVs = glm::vec4(eye.worldToView * glm::dvec4(light.position, 1.0));
    data.positionVs.w = static_cast<float>(light.kind);
    data.directionVs = glm::vec4(eye.worldToView * glm::dvec4(light.direction, 0.0));
    data.directionVs.w = light.rangeMeters;
    data.power = glm::vec4(light.power, light.radius);
    data.cone = glm::vec4(std::cos(light.innerConeRadians), std::cos(light.outerConeRadians),
                          std::tan(light.outerConeRadians), 0.0f);
    const glm::dmat3 toView(eye.worldToView);
    data.rightVs = glm::vec4(glm::vec3(toView * glm::cross(light.direction, light.up)),
                             static_cast<float>(light.image));
    data.upVs = glm::vec4(glm::vec3(toView * light.up), 0.0f);
    return data;
}

}  // namespace kaustik::render
