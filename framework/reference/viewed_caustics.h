// SPDX-License-Identifier: MIT
// Caustics as the eye sees them through and in specular surfaces (L S+ D S* E), for photon mapping:
// in each pass the points that a random eye path of every pixel ends at, and the photons around
// each. Such points do not lie where they are seen, so that a grid of cells finds them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "framework/reference/embree_scene.h"
#include "framework/reference/eye.h"
#include "framework/reference/light_transport.h"

namespace kaustik::reference {

class ViewedCaustics {
  public:
    // The points of one pass; `radiusPixels` is a number of pixels at the length of the path.
    ViewedCaustics(const EmbreeScene& scene, const Eye& eye, std::uint64_t seed, std::uint64_t pass,
                   double radiusPixels);

    // Adds what a photon that has arrived sends to the eye, W/m²/sr: RGB by pixel.
    void add(const SurfaceHit& hit, const PhotonState& photon, double* radiance) const;

  private:
    using Cell = glm::ivec3;
    struct Point {
        Cell cell{0};
        std::uint32_t pixel = 0;
        glm::dvec3 position{0.0};
        glm::dvec3 normal{0.0};  // geometric, on the side that is seen
        glm::dvec3 shadingNormal{0.0};
        glm::dvec3 toEye{0.0};
        glm::dvec3 throughput{0.0};
        glm::dvec2 uv{0.0};
        std::uint32_t material = 0;
        double radiusSquared = 0.0;
    };
    [[nodiscard]] Cell cellOf(const glm::dvec3& position) const;
    [[nodiscard]] std::size_t bucketOf(const Cell& cell) const;
    void sortIntoBuckets(std::vector<Point> points);

    const EmbreeScene& scene_;
    double cellMeters_ = 1.0;                 // twice the largest radius
    std::vector<Point> points_;               // by bucket
    std::vector<std::uint32_t> bucketBegin_;  // one more than buckets
};

}  // namespace kaustik::reference
