// SPDX-License-Identifier: MIT
// Finds the photons that landed at a pixel, and the paths that they came, in the records of every
// tracing of a frame that was rendered for Purpose::audit.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "framework/pipeline/renderer.h"

namespace kaustik::gui {

struct PhotonPath {
    transport::PhotonOrigin origin{};
    // Eye view space, m: a point of the light's path before the first surface, each interaction,
    // and where it landed.
    std::vector<glm::vec3> points;
    glm::vec3 fluxWatts{0.0f};
    float pixels = 0.0f;  // from the middle of the probed pixel
};

struct PhotonProbe {
    glm::ivec2 pixel{0};  // from the upper left
    float radiusPixels = 1.0f;
    std::size_t landed = 0;     // within the radius
    glm::vec3 fluxWatts{0.0f};  // of all of them
    // Photons of batches whose memory later ones have taken: not looked at.
    std::size_t overwritten = 0;
    std::vector<PhotonPath> paths;  // the nearest, kMaxPaths at most
    static constexpr std::size_t kMaxPaths = 200;
};

// Probes the frame that was rendered last; waits for the device.
[[nodiscard]] PhotonProbe probePhotons(const Renderer& renderer, glm::ivec2 pixel,
                                       float radiusPixels);

// The place where a point before the eye is seen, in pixels from the upper left. `visible` is false
// for a point nearer than the near plane.
struct Projected {
    glm::vec2 pixel{0.0f};
    bool visible = false;
};
[[nodiscard]] Projected project(const render::RasterView& view, const glm::vec3& pointVs);

}  // namespace kaustik::gui
