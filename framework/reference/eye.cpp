// SPDX-License-Identifier: MIT
#include "framework/reference/eye.h"

#include "framework/render/view.h"

namespace kaustik::reference {

Eye::Eye(const EmbreeScene& scene, int width, int height) : width_(width), height_(height) {
    const scene::Camera& camera = scene.scene().camera;
    const render::RasterView view = render::makeEyeView(camera, width, height);
    // Only the rotation: the translation of a matrix would lose digits far from the world's origin.
    const glm::dmat3 viewToWorld = glm::transpose(glm::dmat3(view.worldToView));
    right_ = viewToWorld[0];
    up_ = viewToWorld[1];
    backward_ = viewToWorld[2];
    position_ = camera.position - scene.center();
    tangents_ = view.halfExtent;
    pixelsPerTangent_ = height / (2.0 * view.halfExtent.y);
    nearMeters_ = view.nearMeters;
}

}  // namespace kaustik::reference
