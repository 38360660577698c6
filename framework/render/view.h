// SPDX-License-Identifier: MIT
// Views that surfaces are rasterised in: rigid transforms in double precision and projections with
// reversed z (1 at the near plane, 0 at infinity), whose 32-bit floats resolve depth relative to
// its size. View spaces are right-handed and look down -Z.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "framework/scene/scene.h"
#include "framework/transport/types.h"

namespace kaustik::render {

// What the eye, a light or a face of a cube sees.
struct RasterView {
    glm::dmat4 worldToView{1.0};
    bool isOrthographic = false;
    // Perspective: tangents of half the field of view; orthographic: half of the extent, m.
    glm::dvec2 halfExtent{1.0};
    double nearMeters = 0.01;
    double farMeters = 1.0;  // orthographic only
    int width = 1;           // pixels
    int height = 1;
    bool isClipped = false;  // what it was to hold is wider than a perspective view can be
    [[nodiscard]] glm::mat4 projection() const;
    // Metres that a pixel covers at a depth of 1 m; orthographic: at any.
    [[nodiscard]] double footprintPerMeter() const { return 2.0 * halfExtent.y / height; }
};

// The place where a point of a perspective view's space is seen, in pixels from the lower left
// corner, on the screen or next to it. There is none where the point is not in front of the eye.
[[nodiscard]] std::optional<glm::dvec2> pixelOf(const RasterView& view,
                                                const glm::dvec3& positionVs);

// From world space to that of a view from `position` along `direction`. `up` is replaced where it
// is parallel to it.
[[nodiscard]] glm::dmat4 lookAlong(const glm::dvec3& position, const glm::dvec3& direction,
                                   glm::dvec3 up);

// Square pixels: the horizontal field of view follows from the size.
[[nodiscard]] RasterView makeEyeView(const scene::Camera& camera, int width, int height);

// The tightest view from `light` that holds `target`, with depth room for `blockers`: orthographic
// along a directional light, perspective from a point or spot light, where the axis goes to the
// middle of `target` and half-angles end at 80 degrees (isClipped). Its size is to be set.
[[nodiscard]] RasterView makeLightView(const scene::Light& light, const scene::Bounds& target,
                                       const scene::Bounds& blockers);
// Face 0 to 5 (+x, -x, +y, -y, +z, -z) of the cube around a point in world space, 90 degrees wide.
[[nodiscard]] RasterView makeCubeFaceView(const glm::dvec3& center, int face);

// Gives the same view so many pixels, and widens it along one axis until these are square.
[[nodiscard]] RasterView inPixels(RasterView view, int width, int height);

// `eye`: the view in whose space photons and hits are.
[[nodiscard]] transport::ViewData viewData(const scene::Scene& scene, const RasterView& view,
                                           const RasterView& eye);
// The transform from one view's space to another's.
[[nodiscard]] glm::mat4 between(const RasterView& from, const RasterView& to);

[[nodiscard]] transport::LightData lightData(const scene::Light& light, const RasterView& eye);

}  // namespace kaustik::render
