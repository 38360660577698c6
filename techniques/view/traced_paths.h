// SPDX-License-Identifier: MIT
// The eye's paths through specular surfaces, for view.bvh: followed by the device, or by the
// processor's rays where the device is the processor itself. A path is refracted at a dielectric,
// or reflected where all light is; at the first interfaces what is reflected is another path.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>

#include "framework/pipeline/frame_builder.h"
#include "techniques/thread_lists/thread_list.h"
#include "techniques/tracing/rays_by.h"

namespace kaustik {

struct BvhViewParams {
    int interfaces = 32;
    int reflections = 32;
    int mirrors = 16;
    int branches = 2;
    RaysBy rays = RaysBy::automatic;
    template <class R>
    void reflect(R& r) {
        r.field(interfaces, "interfaces", "Most refractions of an eye ray", "",
                params::range(0, 256));
        r.field(reflections, "reflections",
                "Most total internal reflections of an eye ray; what needs more is lost", "",
                params::range(0, 256));
        r.field(mirrors, "mirrors", "Most mirrors that a ray hits one after the other", "",
                params::range(1, 256))
            .when([](const FrameFacts& facts) {
                const bool mayHit = facts.needs == nullptr || facts.needs->reflectors > 0;
                return mayHit ? "" : "the scene has no mirror";
            });
        r.field(branches, "branches",
                "At how many of the first interfaces what is reflected is followed too; 0: the "
                "refracted ray alone",
                "", params::range(0, 4));
        reflectRaysBy(r, rays);
    }
};

// What a pixel's paths come to (three texels: shaders/view/processor_paths.comp). The exits are
// those of the first one: where it left its last specular surface, view space, m.
struct PathsOfPixel {
    glm::vec3 exitPositionVs{0.0f};
    float surfaces = 0.0f;  // specular ones, on its way
    glm::vec3 exitDirection{0.0f};
    float ending = 0.0f;  // transport::kPath…
    float firstEnd = 0.0f;
    float ends = 0.0f;  // of all its paths
    glm::vec2 unused{0.0f};
};

// Where a path ends (six texels).
struct PathEnd {
    glm::vec3 positionVs{0.0f};
    float material = 0.0f;      // of the receiver, index + 1; 0: the path leaves the scene
    glm::vec3 direction{0.0f};  // of the last piece, unit
    float medium = 0.0f;        // around it, material index + 1; 0: none
    glm::vec3 share{0.0f};      // of the radiance there that comes to the eye
    // View depth where the last piece begins, m, if that lies under water; else none is farther.
    float depthUnderWater = 0.0f;
    glm::vec3 shading{0.0f};  // the receiver's normals: unit, outward
    float u = 0.0f;
    glm::vec3 geometric{0.0f};
    float v = 0.0f;
    float uvOfPixel = 0.0f;  // what uv differs by over a pixel's footprint
    glm::vec3 unused{0.0f};
};

class TracesPaths;

struct TracedPaths {
    graph::Texture<ReceiverTexel> receivers;  // the eye's
    graph::Buffer<PathsOfPixel> pixels;
    graph::Buffer<PathEnd> ends;
    graph::Buffer<std::uint32_t> lit;  // a bit a light, 1 where it shines on a hidden end
};

// Follows the paths of the pixels that a list has, by the processor.
class PathsFinder {
  public:
    // ConfigError where the processor is asked for and the program is built without Embree.
    PathsFinder(FrameBuilder& frame, const BvhViewParams& params, const Geometry& geometry);
    // False: the device follows them.
    [[nodiscard]] bool isTraced() const { return traces_ != nullptr; }
    [[nodiscard]] TracedPaths create(graph::PassSetup& setup, const EyeBuffer& eye) const;
    // Reads back which pixels are listed, x + 65536 y, and follows the rays that go by `offset`,
    // px, next to their middles; has them drawn, one part after the other, by the shader
    // view/processor_paths.comp, which `shader` makes a command of.
    void find(const FrameInputs& inputs, gl::PassContext& context, const TracedPaths& paths,
              const ThreadList& listed, const glm::vec2& offset,
              const std::function<gl::Command()>& shader) const;

  private:
    int endsOfPixel_ = 1;  // at most
    int lights_ = 0;
    [[nodiscard]] int litWords() const { return (lights_ + 31) / 32; }
    std::shared_ptr<const TracesPaths> traces_;  // null: the device's
};

}  // namespace kaustik
