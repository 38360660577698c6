// SPDX-License-Identifier: MIT
// Moves a camera and a light by what a hand does on the picture. World space, m.
#pragma once

#include <glm/glm.hpp>

#include "framework/render/view.h"
#include "framework/scene/scene.h"

namespace kaustik::gui {

// Turns the camera about its target: `pixels` of a mouse over a picture of `height` pixels; half a
// turn for the whole height. It never passes over the top.
[[nodiscard]] scene::Camera orbit(const scene::Camera& camera, glm::dvec2 pixels, double height);
// Turns it where it stands.
[[nodiscard]] scene::Camera look(const scene::Camera& camera, glm::dvec2 pixels, double height);
// Nearer to the target by notches of a wheel, never reaching it.
[[nodiscard]] scene::Camera dolly(const scene::Camera& camera, double notches);
// Moves the camera along its own axes (right, up, forward), m.
[[nodiscard]] scene::Camera fly(const scene::Camera& camera, const glm::dvec3& meters);

// The point at which a light is taken hold of: a point or spot light itself, and for a directional
// light a point on its way through the middle of the scene.
[[nodiscard]] glm::dvec3 lightHandle(const scene::Light& light, const scene::Bounds& bounds);
// The light after its handle has been dragged by `pixels` on the picture: a directional one turns
// about the middle of the scene, another moves at right angles to the view.
[[nodiscard]] scene::Light dragLight(const scene::Light& light, const scene::Bounds& bounds,
                                     const render::RasterView& view, glm::dvec2 pixels);

}  // namespace kaustik::gui
