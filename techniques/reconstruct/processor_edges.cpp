// SPDX-License-Identifier: MIT
#include "techniques/reconstruct/processor_edges.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "framework/transport/edges.h"
#include "techniques/tracing/processor_eye.h"

namespace kaustik {
namespace {

SeenAtPlace seenAt(const reference::EmbreeScene& scene, const ProcessorEye& eye,
                   const glm::dvec2& place) {
    const ProcessorEye::Ray ray = eye.rayThrough(place);
    reference::SurfaceHit hit;
    if (!scene.intersectStraight(ray.origin, ray.direction, hit)) return {};
    const double depth = eye.view().nearMeters + hit.distance / ray.perDepth;
    const bool isLit = isReceiver(scene.scene().materials[hit.material].kind);
    return {eye.direction(hit.shadingNormal), static_cast<float>(isLit ? depth : -depth),
            eye.direction(hit.geometricNormal)};
}

}  // namespace

std::vector<SeenAtPlace> seenAtPlaces(const reference::EmbreeScene& scene,
                                      const render::RasterView& eye,
                                      std::span<const std::uint32_t> pixels) {
    constexpr std::size_t kPlaces = transport::kEdgeSamples;
    const ProcessorEye processorEye(scene, eye);
    std::vector<SeenAtPlace> seen(kPlaces * pixels.size());
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, pixels.size(), 64),
        [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                const glm::dvec2 corner(pixels[i] & 0xffffu, pixels[i] >> 16u);
                for (std::size_t place = 0; place < kPlaces; ++place) {
                    const glm::dvec2 inPixel = transport::edgePlace(static_cast<int>(place));
                    seen[kPlaces * i + place] = seenAt(scene, processorEye, corner + inPixel);
                }
            }
        });
    return seen;
}

}  // namespace kaustik
