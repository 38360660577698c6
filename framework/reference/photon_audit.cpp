// SPDX-License-Identifier: MIT
#include "framework/reference/photon_audit.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>

#include "framework/reference/threads.h"

namespace kaustik::reference {

std::vector<FirstHit> exactFirstHits(const EmbreeScene& scene, std::span<const AuditPhoton> photons,
                                     const glm::dmat4& toWorld, int threads) {
    std::vector<FirstHit> hits(photons.size());
    const glm::dmat3 rotation(toWorld);
    const glm::dmat3 back = glm::transpose(rotation);
    const glm::dvec3 offset = glm::dvec3(toWorld[3]) - scene.center();
    const auto audit = [&](std::size_t i) {
        const AuditPhoton& photon = photons[i];
        const double length = glm::length(photon.direction);
        const glm::dvec3& p = photon.position;
        if (!std::isfinite(p.x + p.y + p.z + length) || length == 0.0) return;
        Ray ray;
        ray.origin = rotation * p + offset;
        ray.direction = rotation * photon.direction / length;
        ray.innerMedium = photon.media % transport::kMediumBase;  // transfer_map.glsl
        ray.leftSide = photon.media / (transport::kMediumBase * transport::kMediumBase);
        ray.reachMeters = photon.reachMeters;
        SurfaceHit found;
        if (!scene.intersect(ray, found)) return;
        FirstHit& hit = hits[i];
        hit.distanceMeters = found.distance;
        hit.position = p + photon.direction * (found.distance / length);
        hit.shadingNormal = back * found.shadingNormal;
        hit.geometricNormal = back * found.geometricNormal;
        hit.material = found.material + 1;
        hit.triangle = found.triangle;
    };
    runWithThreads(threads, [&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, photons.size(), 1024),
                          [&](const tbb::blocked_range<std::size_t>& range) {
                              for (std::size_t i = range.begin(); i < range.end(); ++i)
                                  audit(i);
                          });
    });
    return hits;
}

}  // namespace kaustik::reference
