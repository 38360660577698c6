// SPDX-License-Identifier: MIT
#include "framework/reference/photon_audit.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>

#include "framework/reference/threads.h"
#include "framework/scene/dielectrics.h"
#include "framework/transport/media_stack.h"

namespace kaustik::reference {

std::vector<FirstHit> exactFirstHits(const EmbreeScene& scene, std::span<const AuditPhoton> photons,
                                     const glm::dmat4& toWorld, int threads) {
    std::vector<FirstHit> hits(photons.size());
    const scene::Dielectrics dielectrics = numberDielectrics(scene.scene());
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
        const std::vector<std::uint32_t> media = unpackMedia(dielectrics, photon.media);
        for (auto medium = media.rbegin(); medium != media.rend(); ++medium)
            ray.media.enter(*medium);
        ray.leftSide = transport::leftSide(photon.media);
        ray.reachMeters = photon.reachMeters;
        SurfaceHit found;
        if (!scene.intersect(ray, found)) return;
        FirstHit& hit = hits[i];
        hit.distanceMeters = found.distance;
        hit.position = p + photon.direction * (found.distance / length);
        hit.shadingNormal = back * found.shadingNormal;
        hit.geometricNormal = back * found.geometricNormal;
        hit.turning = back * scene.normalTurning(found.triangle, found.position) * rotation;
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
