// SPDX-License-Identifier: MIT
// What an eye's pixels show, as the processor looks it up for each patch of reconstruct.triangles:
// of the view and its receivers the same as shaders/include/views/view.glsl and seen_receiver.glsl,
// where the names here come from; there in builds with Embree alone.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "framework/render/view.h"
#include "framework/transport/edges.h"
#include "techniques/reconstruct/pixel_block.h"

namespace kaustik {

// Of receivers the depth, m, negative of a mirror, 0 none; area, m²;
// and, from 1 on, the number of a pixel at an edge, whose quarters have receivers of their own.
class SeenPixels {
  public:
    struct Textures {
        std::vector<glm::vec4> receiver;  // of EdgeReceiver, or of ReceiverTexel: z is 0 then
        std::vector<glm::vec4> surface;   // xyz: unit normals
        std::vector<glm::vec4> samples;   // of EdgeSample; empty without edges
    };
    struct Receiver {
        glm::vec3 normal;
        float depth, area;
        float margin;  // depthMargin() of its own
    };
    struct Pixel {
        Receiver middle;
        std::uint32_t number;
    };
    // Of squares of pixels; `several`: they show more than one surface.
    struct Block {
        Receiver receiver;
        bool several;
    };

    void look(const render::RasterView& view, const Textures& textures,
              std::span<const PixelBlock> blocks);

    [[nodiscard]] glm::vec3 ray(const glm::vec2& place) const {
        return {place * toRay_ - halfExtent_, -1.0f};
    }
    [[nodiscard]] glm::vec2 pixelOf(const glm::vec3& positionVs) const {
        return (glm::vec2(positionVs) / (-positionVs.z * halfExtent_) * 0.5f + 0.5f) *
               glm::vec2(size_);
    }
    [[nodiscard]] float depthMargin(const glm::vec3& ray, float depth,
                                    const glm::vec3& normal) const;
    [[nodiscard]] float pixelArea(const glm::vec3& ray, float depth, const glm::vec3& normal) const;
    [[nodiscard]] const glm::ivec2& size() const { return size_; }
    [[nodiscard]] int blocksOfRow() const { return blocksOfRow_; }
    [[nodiscard]] float nearMeters() const { return near_; }
    [[nodiscard]] std::size_t indexOf(const glm::ivec2& pixel) const {
        return static_cast<std::size_t>(pixel.y * size_.x + pixel.x);
    }
    [[nodiscard]] const Pixel& at(const glm::ivec2& pixel) const { return pixels_[indexOf(pixel)]; }
    [[nodiscard]] const Block& block(std::size_t index) const { return blocks_[index]; }
    [[nodiscard]] const Receiver& sample(std::uint32_t number, int place) const {
        return samples_[(number - 1) * transport::kEdgeSamples + static_cast<std::size_t>(place)];
    }

  private:
    [[nodiscard]] Receiver receiver(const glm::vec2& place, float depth, float area,
                                    const glm::vec3& normal) const;
    glm::ivec2 size_{0};
    int blocksOfRow_ = 0;
    glm::vec2 halfExtent_{1.0f}, toRay_{1.0f};
    float near_ = 0.0f, footprint_ = 0.0f;  // m; of a pixel at a depth of 1 m
    std::vector<Pixel> pixels_;
    std::vector<Receiver> samples_;  // in the order of their pixels' numbers
    std::vector<Block> blocks_;
};

}  // namespace kaustik
