// SPDX-License-Identifier: MIT
// Surfaces of a foreign scene that emit: which radiance a material has to have for them.
#pragma once

#include <glm/glm.hpp>

#include "framework/reading/reader_process.h"
#include "framework/scene/foreign/foreign_scene.h"

namespace kaustik::scene {

// Emits the same radiance into all directions of the hemisphere above each of its points.
struct AreaLight {
    double area = 0.0;         // m²
    glm::dvec3 radiance{0.0};  // W/m²/sr

    [[nodiscard]] glm::dvec3 powerWatts() const;  // π area radiance
};

// Throws ConfigError "place: …" for a light that has no area. `reader` reads mesh files.
[[nodiscard]] AreaLight areaLightOf(const ForeignShape& shape, reading::ReaderProcess& reader);

}  // namespace kaustik::scene
