// SPDX-License-Identifier: MIT
#include "framework/gui/camera_control.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtx/rotate_vector.hpp>

namespace kaustik::gui {
namespace {

// Closer to the poles the picture would turn about itself.
constexpr double kMaxPitch = 1.55;  // rad above the horizon

// `direction` turned about `up` by `yaw` and towards it by `pitch`, rad.
glm::dvec3 turned(glm::dvec3 direction, const glm::dvec3& up, double yaw, double pitch) {
    direction = glm::rotate(direction, yaw, up);
    const glm::dvec3 across = glm::cross(direction, up);
    if (glm::length(across) < 1e-9) return direction;
    const double before = std::asin(std::clamp(glm::dot(direction, up), -1.0, 1.0));
    const double after = std::clamp(before + pitch, -kMaxPitch, kMaxPitch);
    return glm::rotate(direction, after - before, glm::normalize(across));
}

glm::dvec2 radians(glm::dvec2 pixels, double height) {
    return glm::pi<double>() * pixels / std::max(height, 1.0);
}

}  // namespace

scene::Camera orbit(const scene::Camera& camera, glm::dvec2 pixels, double height) {
    scene::Camera result = camera;
    const glm::dvec3 offset = camera.position - camera.target;
    const double distance = glm::length(offset);
    const glm::dvec2 angles = radians(pixels, height);
    result.position =
        camera.target +
        distance * turned(offset / distance, glm::normalize(camera.up), -angles.x, angles.y);
    return result;
}

scene::Camera look(const scene::Camera& camera, glm::dvec2 pixels, double height) {
    scene::Camera result = camera;
    const glm::dvec3 offset = camera.target - camera.position;
    const double distance = glm::length(offset);
    const glm::dvec2 angles = 0.5 * radians(pixels, height);
    result.target =
        camera.position +
        distance * turned(offset / distance, glm::normalize(camera.up), -angles.x, -angles.y);
    return result;
}

scene::Camera dolly(const scene::Camera& camera, double notches) {
    scene::Camera result = camera;
    const glm::dvec3 offset = camera.position - camera.target;
    const double nearest = 2.0 * camera.nearMeters / glm::length(offset);
    result.position = camera.target + offset * std::max(std::pow(0.9, notches), nearest);
    return result;
}

scene::Camera fly(const scene::Camera& camera, const glm::dvec3& meters) {
    scene::Camera result = camera;
    const glm::dvec3 forward = glm::normalize(camera.target - camera.position);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::dvec3 way =
        meters.x * right + meters.y * glm::cross(right, forward) + meters.z * forward;
    result.position += way;
    result.target += way;
    return result;
}

glm::dvec3 lightHandle(const scene::Light& light, const scene::Bounds& bounds) {
    if (light.kind != scene::LightKind::directional) return light.position;
    const glm::dvec3 middle = 0.5 * (bounds.minimum + bounds.maximum);
    return middle - 0.3 * glm::length(bounds.maximum - bounds.minimum) * light.direction;
}

scene::Light dragLight(const scene::Light& light, const scene::Bounds& bounds,
                       const render::RasterView& view, glm::dvec2 pixels) {
    scene::Light result = light;
    const glm::dmat3 toWorld = glm::transpose(glm::dmat3(view.worldToView));
    const glm::dvec3 handle = lightHandle(light, bounds);
    const double depth = std::max(-(view.worldToView * glm::dvec4(handle, 1.0)).z, view.nearMeters);
    const double scale = depth * view.footprintPerMeter();
    const glm::dvec3 way = toWorld * glm::dvec3(pixels.x * scale, -pixels.y * scale, 0.0);
    if (light.kind != scene::LightKind::directional) {
        result.position += way;
        return result;
    }
    const glm::dvec3 middle = 0.5 * (bounds.minimum + bounds.maximum);
    const glm::dvec3 direction = middle - (handle + way);
    if (glm::length(direction) > 1e-9) result.direction = glm::normalize(direction);
    return result;
}

}  // namespace kaustik::gui
