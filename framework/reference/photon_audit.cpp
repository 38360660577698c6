// SPDX-License-Identifier: MIT
#include "framework/reference/photon_audit.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>

#include "framework/reference/threads.h"
#include "framework/scene/dielectrics.h"
#include "framework/transport/media_stack.h"

namespace kaustik::reference {

FirstHits::FirstHits(const EmbreeScene& scene, const glm::dmat4& toWorld)
    : scene_(scene),
      dielectrics_(numberDielectrics(scene.scene())),
      rotation_(toWorld),
      offset_(glm::dvec3(toWorld[3]) - scene.center()) {}

FirstHit FirstHits::of(const AuditPhoton& photon) const {
    FirstHit hit;
    const double length = glm::length(photon.direction);
    const glm::dvec3& p = photon.position;
    if (!std::isfinite(p.x + p.y + p.z + length) || length == 0.0) return hit;
    Ray ray;
    ray.origin = rotation_ * p + offset_;
    ray.direction = rotation_ * photon.direction / length;
    if (transport::stackOf(photon.media) > 0) {
        const std::vector<std::uint32_t> media = unpackMedia(dielectrics_, photon.media);
        for (auto medium = media.rbegin(); medium != media.rend(); ++medium)
            ray.media.enter(*medium);
    }
    ray.leftSide = transport::leftSide(photon.media);
    ray.reachMeters = photon.reachMeters;
    SurfaceHit found;
    if (!scene_.intersect(ray, found)) return hit;
    const glm::dmat3 back = glm::transpose(rotation_);
    hit.distanceMeters = found.distance;
    hit.position = p + photon.direction * (found.distance / length);
    hit.shadingNormal = back * found.shadingNormal;
    hit.geometricNormal = back * found.geometricNormal;
    hit.material = found.material + 1;
    hit.triangle = found.triangle;
    return hit;
}

glm::dmat3 FirstHits::turningAt(const FirstHit& hit) const {
    const glm::dvec3 local = rotation_ * hit.position + offset_;
    return glm::transpose(rotation_) * scene_.normalTurning(hit.triangle, local) * rotation_;
}

std::vector<FirstHit> exactFirstHits(const EmbreeScene& scene, std::span<const AuditPhoton> photons,
                                     const glm::dmat4& toWorld, int threads) {
    std::vector<FirstHit> hits(photons.size());
    const FirstHits finder(scene, toWorld);
    runWithThreads(threads, [&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, photons.size(), 1024),
                          [&](const tbb::blocked_range<std::size_t>& range) {
                              for (std::size_t i = range.begin(); i < range.end(); ++i)
                                  hits[i] = finder.of(photons[i]);
                          });
    });
    return hits;
}

}  // namespace kaustik::reference
