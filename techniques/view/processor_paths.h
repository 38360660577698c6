// SPDX-License-Identifier: MIT
// The eye's paths followed by Embree on all cores; there in builds with Embree alone.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "techniques/tracing/processor_scene.h"
#include "techniques/view/traced_paths.h"

namespace kaustik {

struct LookedThrough {
    std::span<const std::uint32_t> pixels;  // x + 65536 y
    glm::vec2 offset{0.0f};                 // of their rays, px, from their middles
    std::span<const glm::vec4> receivers;   // ReceiverTexel, of the whole picture
};

struct FoundPaths {
    std::vector<PathsOfPixel> pixels;
    std::vector<PathEnd> ends;
    std::vector<std::uint32_t> lit;  // as many words an end as lights need
};

class TracesPaths {
  public:
    TracesPaths(ProcessorScene scene, const BvhViewParams& caps, int lights);
    void read(graph::PassSetup& setup) const { scene_.read(setup); }
    [[nodiscard]] FoundPaths find(const render::RasterView& eye, const LookedThrough& at) const;

  private:
    ProcessorScene scene_;
    BvhViewParams caps_;
    int lights_;
    std::vector<bool> isOpen_;  // by material
};

}  // namespace kaustik
