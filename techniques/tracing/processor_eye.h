// SPDX-License-Identifier: MIT
// Between a perspective view's space and that of the scene as Embree traces it, in double
// precision.
#pragma once

#include <glm/glm.hpp>

#include "framework/reference/embree_scene.h"
#include "framework/render/view.h"

namespace kaustik {

class ProcessorEye {
  public:
    struct Ray {
        glm::dvec3 origin;     // on the near plane, local to the scene
        glm::dvec3 direction;  // unit
        double perDepth;       // its length over the view depth that it gains
    };

    ProcessorEye(const reference::EmbreeScene& scene, const render::RasterView& eye) : eye_(eye) {
        const glm::dmat4 toWorld = glm::inverse(eye.worldToView);
        rotation_ = glm::dmat3(toWorld);
        position_ = glm::dvec3(toWorld[3]) - scene.center();
    }
    [[nodiscard]] const render::RasterView& view() const { return eye_; }
    // Towards a place of the picture, px from its lower left corner, in the view's space; of a
    // depth of 1.
    [[nodiscard]] glm::dvec3 viewing(const glm::dvec2& place) const {
        const glm::dvec2 size(eye_.width, eye_.height);
        return {(2.0 * place / size - 1.0) * eye_.halfExtent, -1.0};
    }
    [[nodiscard]] Ray rayThrough(const glm::dvec2& place) const {
        const glm::dvec3 towards = viewing(place);
        const double perDepth = glm::length(towards);
        return {localPosition(eye_.nearMeters * towards), rotation_ * (towards / perDepth),
                perDepth};
    }
    [[nodiscard]] glm::dvec3 localPosition(const glm::dvec3& positionVs) const {
        return position_ + rotation_ * positionVs;
    }
    // From the scene's local space to the view's.
    [[nodiscard]] glm::dvec3 position(const glm::dvec3& local) const {
        return (local - position_) * rotation_;
    }
    [[nodiscard]] glm::dvec3 direction(const glm::dvec3& local) const { return local * rotation_; }

  private:
    render::RasterView eye_;
    glm::dmat3 rotation_;
    glm::dvec3 position_;  // the eye's
};

}  // namespace kaustik
