// SPDX-License-Identifier: MIT
#include "techniques/reconstruct/processor_pixels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "framework/transport/octahedral.h"
#include "framework/transport/seen.h"

namespace kaustik {

using glm::vec2;
using glm::vec3;
using namespace transport;

float SeenPixels::depthMargin(const vec3& ray, float depth, const vec3& normal) const {
    const float footprint = footprint_ * depth;
    const float slope = (std::abs(normal.x) + std::abs(normal.y)) /
                        std::max(std::abs(glm::dot(normal, ray)), 1e-4f);
    return footprint * (1.0f + 0.5f * std::min(slope, kMaxPixelSlope));
}

float SeenPixels::pixelArea(const vec3& ray, float depth, const vec3& normal) const {
    const float side = footprint_ * depth;
    return side * side / std::max(std::abs(glm::dot(normal, ray)), 1e-4f);
}

SeenPixels::Receiver SeenPixels::receiver(const vec2& place, float depth, float area,
                                          const vec3& normal) const {
    return {normal, depth, area, depthMargin(ray(place), std::abs(depth), normal)};
}

void SeenPixels::look(const render::RasterView& view, const Textures& textures,
                      std::span<const PixelBlock> blocks) {
    size_ = {view.width, view.height};
    blocksOfRow_ = (size_.x + kPixelBlockSide - 1) / kPixelBlockSide;
    halfExtent_ = vec2(view.halfExtent);
    toRay_ = 2.0f * halfExtent_ / vec2(size_);
    near_ = static_cast<float>(view.nearMeters);
    footprint_ = static_cast<float>(view.footprintPerMeter());
    pixels_.resize(textures.receiver.size());
    std::uint32_t numbers = 0;
    for (const glm::vec4& seen : textures.receiver)
        numbers =
            std::max(numbers, textures.samples.empty() ? 0u : static_cast<std::uint32_t>(seen.z));
    samples_.resize(static_cast<std::size_t>(numbers) * kEdgeSamples);
    blocks_.resize(blocks.size());
    tbb::parallel_for(0, size_.y, [&](int y) {
        for (int x = 0; x < size_.x; ++x) {
            const std::size_t index = indexOf({x, y});
            const glm::vec4& seen = textures.receiver[index];
            Pixel& pixel = pixels_[index];
            const vec2 corner(x, y);
            pixel.middle = receiver(corner + 0.5f, seen.x, seen.y, vec3(textures.surface[index]));
            pixel.number = textures.samples.empty() ? 0u : static_cast<std::uint32_t>(seen.z);
            for (std::size_t i = 0; pixel.number > 0 && i < kEdgeSamples; ++i) {
                const std::size_t at = (pixel.number - 1) * kEdgeSamples + i;
                const glm::vec4& sample = textures.samples[at];
                samples_[at] = receiver(corner + edgePlace(static_cast<int>(i)), sample.x, sample.y,
                                        unpackUnitVector({sample.z, sample.w}));
            }
        }
    });
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const glm::vec4& seen = blocks[i].receiver;
        const auto row = static_cast<std::size_t>(blocksOfRow_);
        const vec2 middle = static_cast<float>(kPixelBlockSide) * (vec2(i % row, i / row) + 0.5f);
        blocks_[i] = {receiver(middle, seen.x, seen.y, unpackUnitVector({seen.z, seen.w})),
                      seen.y < 0.0f};
    }
}

}  // namespace kaustik
