// SPDX-License-Identifier: MIT
// Parts of scene files that the cases put together.
#pragma once

#include <fmt/format.h>

#include <glm/glm.hpp>
#include <string>

#include "framework/numerics/frame.h"

namespace kaustik::numerics {

// Materials by number, index + 1: as the textures hold them.
inline constexpr std::uint32_t kGrey = 1;
inline constexpr std::uint32_t kWhite = 2;
inline constexpr std::uint32_t kWater = 3;
inline constexpr std::uint32_t kGlass = 4;
inline constexpr std::uint32_t kMirror = 5;
inline constexpr double kWaterIndex = 1.333;
inline constexpr double kGlassIndex = 1.5;

inline std::string number(double value) {
    return fmt::format("{:.17g}", value);
}
inline std::string numbers(const glm::dvec3& v) {
    return fmt::format("[{}, {}, {}]", number(v.x), number(v.y), number(v.z));
}

struct CameraText {
    glm::dvec3 position{0.0};
    glm::dvec3 target{0.0, 0.0, -1.0};
    double fovDegrees = 60.0;
    double nearMeters = 0.01;
};

// A scene with the five materials, a camera and whatever `parts` say.
inline scene::Scene makeScene(const CameraText& camera, const std::string& parts) {
    return sceneFromText(fmt::format(R"(
name = "case"
background_radiance = 2
[camera]
position = {}
target = {}
vertical_fov_degrees = {}
near = {}
[[material]]
name = "grey"
type = "lambertian"
albedo = 0.5
[[material]]
name = "white"
type = "lambertian"
albedo = 1
[[material]]
name = "water"
type = "dielectric"
ior = 1.333
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[material]]
name = "mirror"
type = "mirror"
reflectance = 0.9
)",
                                     numbers(camera.position), numbers(camera.target),
                                     number(camera.fovDegrees), number(camera.nearMeters)) +
                         parts);
}

// An object; `rest` holds the shape's own keys.
inline std::string object(const std::string& name, const std::string& shape,
                          const std::string& material, const glm::dvec3& position,
                          const std::string& rest) {
    return fmt::format(
        "[[object]]\nname = \"{}\"\nshape = \"{}\"\nmaterial = \"{}\"\nposition = {}\n{}\n", name,
        shape, material, numbers(position), rest);
}

// A plane that faces +Z, as an eye that looks down -Z sees it.
inline std::string facingPlane(const std::string& name, const std::string& material, double side,
                               const glm::dvec3& position) {
    return object(name, "plane", material, position,
                  fmt::format("size = [{0}, {0}]\nrotation_degrees = [90, 0, 0]", number(side)));
}
// One that faces +Y.
inline std::string floorPlane(const std::string& name, const std::string& material, double side,
                              const glm::dvec3& position) {
    return object(name, "plane", material, position,
                  fmt::format("size = [{0}, {0}]", number(side)));
}

inline std::string sun(const glm::dvec3& direction, double irradiance = 1000.0) {
    return fmt::format(
        "[[light]]\nname = \"sun\"\ntype = \"directional\"\ndirection = {}\nirradiance = {}\n",
        numbers(direction), number(irradiance));
}

}  // namespace kaustik::numerics
