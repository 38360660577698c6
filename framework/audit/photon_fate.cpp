// SPDX-License-Identifier: MIT
#include "framework/audit/photon_fate.h"

#include <algorithm>
#include <cmath>

namespace kaustik::audit {
namespace {

// A cosine below this is edge-on; the pixel then decides alone.
constexpr double kSmallestCosine = 1e-6;
constexpr double kDisplaced = 4.0;  // pixels and footprints

bool isOnScreen(const render::RasterView& view, const glm::dvec2& pixel) {
    return pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < view.width && pixel.y < view.height;
}

Sight sightOf(const render::RasterView& view, const Layers& layers,
              const reference::FirstHit& exact) {
    if (!exact.exists()) return Sight::none;
    const double depth = -exact.position.z;
    if (!(depth >= view.nearMeters)) return Sight::behindEye;
    const std::optional<glm::dvec2> pixel = pixelOf(view, exact.position);
    if (!pixel || !isOnScreen(view, *pixel)) return Sight::offScreen;
    return layers.sightOf(*pixel, depth, depth * view.footprintPerMeter());
}

}  // namespace

Layers::Layers(int width, int height, int layers, std::vector<float> texels)
    : width_(width), height_(height), layers_(layers), texels_(std::move(texels)) {}

glm::dvec2 Layers::at(int x, int y, int layer) const {
    const std::size_t texel = (static_cast<std::size_t>(layer) * static_cast<std::size_t>(height_) +
                               static_cast<std::size_t>(y)) *
                                  static_cast<std::size_t>(width_) +
                              static_cast<std::size_t>(x);
    return {texels_[2 * texel], texels_[2 * texel + 1]};
}

bool Layers::holds(int x, int y, double depth, double footprint) const {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return false;
    for (int layer = 0; layer < layers_; ++layer) {
        const glm::dvec2 there = at(x, y, layer);
        if (there.x <= 0.0) return false;
        if (std::abs(there.x - depth) <= there.y + 2.0 * footprint) return true;
    }
    return false;
}

Sight Layers::sightOf(const glm::dvec2& pixel, double depth, double footprint) const {
    if (layers_ == 0) return Sight::beyondLayers;
    const int x = static_cast<int>(pixel.x);
    const int y = static_cast<int>(pixel.y);
    // A neighbour's fragment is as good: within a pixel of the hit is right.
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            if (holds(x + dx, y + dy, depth, footprint)) return Sight::shown;
        }
    }
    const double last = at(x, y, layers_ - 1).x;
    return last > 0.0 && depth > last ? Sight::beyondLayers : Sight::edgeOn;
}

PhotonFate judgeFate(const render::RasterView& view, const Layers& layers, const glm::dvec3& origin,
                     const std::optional<glm::dvec3>& found, const reference::FirstHit& exact) {
    PhotonFate fate;
    fate.sight = sightOf(view, layers, exact);
    if (!found || !exact.exists()) {
        if (exact.exists()) fate.verdict = Verdict::missed;
        if (found) fate.verdict = Verdict::noSurface;
        return fate;
    }
    const double distance = glm::distance(*found, exact.position);
    fate.distanceMeters = distance;
    const std::optional<glm::dvec2> a = pixelOf(view, *found);
    const std::optional<glm::dvec2> b = pixelOf(view, exact.position);
    if (a && b) fate.distancePixels = glm::distance(*a, *b);

    const double toEye = std::max(glm::length(exact.position), 1e-300);
    const double cosine = std::max(
        std::abs(glm::dot(exact.geometricNormal, exact.position)) / toEye, kSmallestCosine);
    const double footprint = std::abs(exact.position.z) * view.footprintPerMeter() / cosine;
    const auto isWithin = [&](double times) {
        // Neither may be before the eye, where there are no pixels: then metres alone tell.
        const bool isOnScreen = fate.distancePixels && *fate.distancePixels <= times;
        return (isOnScreen || (!a && !b)) && distance <= times * footprint;
    };
    if (isWithin(1.0)) return fate;
    if (isWithin(kDisplaced)) {
        fate.verdict = Verdict::displaced;
    } else if (glm::distance(*found, origin) < exact.distanceMeters) {
        fate.verdict = Verdict::tooNear;
    } else {
        fate.verdict = Verdict::tooFar;
    }
    return fate;
}

}  // namespace kaustik::audit
