// SPDX-License-Identifier: MIT
// Surfaces of a foreign scene that emit: their geometry in the world and their radiance, and what
// stands for them in a scene file. That has no lights with a size, so that it is a point light,
// made in one place alone.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>

#include "framework/reading/reader_process.h"
#include "framework/scene/foreign/foreign_scene.h"

namespace kaustik::scene {

enum class AreaLightKind { rectangle, disc, sphere, mesh };

// Emits the same radiance into all directions of the hemisphere above each of its points.
struct AreaLight {
    std::string name;
    AreaLightKind kind = AreaLightKind::rectangle;
    std::array<glm::dvec3, 4> corners{};  // rectangle: in order around it
    glm::dvec3 center{0.0};
    glm::dvec3 normal{0.0, 1.0, 0.0};  // rectangle and disc: unit, where it shines
    double radius = 0.0;               // disc and sphere, m
    double area = 0.0;                 // m²
    glm::dvec3 radiance{0.0};          // W/m²/sr

    [[nodiscard]] glm::dvec3 powerWatts() const;  // π area radiance
};

// Throws ConfigError "place: …" for a light that has no area. `reader` reads mesh files.
[[nodiscard]] AreaLight areaLightOf(const ForeignShape& shape, reading::ReaderProcess& reader);

// A point light in its middle. That of a rectangle or disc has the same intensity along the normal,
// and so shines brighter to the sides and behind it; that of others has the same power.
[[nodiscard]] Light pointLightFor(const AreaLight& light);

}  // namespace kaustik::scene
