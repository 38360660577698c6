// SPDX-License-Identifier: MIT
// Colours of the reference: what receivers reflect and what spots project. The same definitions as
// shaders/include/surfaces/surface.glsl and lights.glsl, at points: the device filters patterns and
// images over a pixel (box, mip levels), resamples images to squares of one size and holds them in
// 16-bit floats. Images here are bilinear between the centres of their own texels, in double.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "framework/image/image.h"
#include "framework/scene/scene.h"

namespace kaustik::reference {

class Appearance {
  public:
    // Decodes all images. `scene` must outlive this. Throws IoError.
    explicit Appearance(const scene::Scene& scene);

    // Diffuse reflectance of a material at `uv`.
    [[nodiscard]] glm::dvec3 albedo(std::uint32_t material, const glm::dvec2& uv) const;
    // transport/brdf.h, 1/sr: `normal` is the shading normal on the eye's side.
    [[nodiscard]] glm::dvec3 brdf(std::uint32_t material, const glm::dvec2& uv,
                                  const glm::dvec3& normal, const glm::dvec3& toLight,
                                  const glm::dvec3& toEye) const;
    // What a material's normal map holds at `uv`, of any length; the material has one.
    [[nodiscard]] glm::dvec3 mappedVector(std::uint32_t material, const glm::dvec2& uv) const;
    // Its texels that a step of uv crosses.
    [[nodiscard]] glm::dvec2 normalTexels(std::uint32_t material, const glm::dvec2& uvStep) const;
    // What a spot's image makes of its intensity in `direction` (unit, within the outer cone).
    [[nodiscard]] glm::dvec3 spotColor(const scene::Light& light,
                                       const glm::dvec3& direction) const;

    // What comes from outside of the scene along `direction` (unit, world space, from the eye
    // outwards), W/m²/sr.
    [[nodiscard]] glm::dvec3 environment(const glm::dvec3& direction) const;

  private:
    const scene::Scene& scene_;
    std::vector<Image> images_;
};

}  // namespace kaustik::reference
