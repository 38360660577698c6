// SPDX-License-Identifier: MIT
// Where the eye and the lights look: rigid transforms in double precision and projections with
// reversed z (1 at the near plane, 0 at infinity), whose 32-bit floats resolve depth relative to
// its size. View spaces are right-handed and look down -Z.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "framework/scene/scene.h"
#include "framework/transport/types.h"

namespace kaustik::render {

struct EyeView {
    glm::dmat4 worldToView{1.0};
    glm::dvec2 tangents{1.0};  // of half the field of view
    double nearMeters = 0.01;
    int width = 1;
    int height = 1;
    [[nodiscard]] glm::mat4 projection() const;
    // Metres that a pixel covers at a depth of 1 m.
    [[nodiscard]] double footprintPerMeter() const { return 2.0 * tangents.y / height; }
};

// Where a point of eye view space is seen, in pixels from the lower left corner, on the screen or
// beside it; nothing where it is not before the eye.
[[nodiscard]] std::optional<glm::dvec2> pixelOf(const EyeView& view, const glm::dvec3& positionVs);

// Square pixels: the horizontal field of view follows from the size.
[[nodiscard]] EyeView makeEyeView(const scene::Camera& camera, int width, int height);
[[nodiscard]] transport::ViewData viewData(const scene::Scene& scene, const EyeView& view);

// What a light sees: an orthographic view along a directional light, a perspective one from a point
// or spot light.
struct LightView {
    glm::dmat4 worldToLight{1.0};
    bool isOrthographic = false;
    // Orthographic: half of the extent in m; perspective: tangents of the half-angles.
    glm::dvec2 halfExtent{1.0};
    double nearMeters = 0.01;
    double farMeters = 1.0;  // orthographic only
    bool isClipped = false;  // the bounds are wider than a perspective view can be
    [[nodiscard]] glm::mat4 projection() const;
};

// The tightest view from `light` that holds `target`, with depth room for `blockers`. For a point
// light the axis goes to the middle of `target`; half-angles end at 80 degrees (isClipped).
[[nodiscard]] LightView makeLightView(const scene::Light& light, const scene::Bounds& target,
                                      const scene::Bounds& blockers);
// Face 0 to 5 of the cube around a point light, 90 degrees wide.
[[nodiscard]] LightView makeCubeFaceView(const scene::Light& light, int face);

// From the light's view space to the eye's.
[[nodiscard]] glm::mat4 lightToEye(const LightView& light, const EyeView& eye);
[[nodiscard]] glm::mat4 eyeToLight(const LightView& light, const EyeView& eye);

[[nodiscard]] transport::LightData lightData(const scene::Light& light, const EyeView& eye);

}  // namespace kaustik::render
