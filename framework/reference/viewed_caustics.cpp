// SPDX-License-Identifier: MIT
#include "framework/reference/viewed_caustics.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "framework/reference/eye_path.h"
#include "framework/reference/photon_density.h"

namespace kaustik::reference {

ViewedCaustics::ViewedCaustics(const EmbreeScene& scene, const Eye& eye, std::uint64_t seed,
                               std::uint64_t pass, double radiusPixels)
    : scene_(scene) {
    const auto width = static_cast<std::uint32_t>(eye.width());
    const std::uint32_t count = width * static_cast<std::uint32_t>(eye.height());
    std::vector<Point> points;
    points.reserve(count);
    double largest = 0.0;
    for (std::uint32_t pixel = 0; pixel < count; ++pixel) {
        // Neither the photons' stream of numbers nor that of the straight view.
        Random random(~seed, pass, std::uint64_t{count} + pixel);
        const double column = pixel % width + random.uniform();
        const double row = pixel / width + random.uniform();
        const glm::dvec3 ray = eye.ray(column, row);
        const double perDepth = glm::length(ray);
        const auto path =
            followEye(scene, eye.position() + eye.nearMeters() * ray, ray / perDepth, random);
        if (!path) continue;
        const double depth = eye.nearMeters() + path->lengthMeters / perDepth;
        const double radius = radiusPixels * eye.footprintPerMeter() * depth;
        largest = std::max(largest, radius);
        const SurfaceHit& hit = path->hit;
        const double side = glm::dot(hit.geometricNormal, path->direction) < 0.0 ? 1.0 : -1.0;
        Point point;
        point.pixel = pixel;
        point.position = hit.position;
        point.normal = side * hit.geometricNormal;
        point.shadingNormal = side * hit.shadingNormal;
        point.toEye = -path->direction;
        point.throughput = path->throughput;
        point.uv = hit.uv;
        point.material = hit.material;
        point.radiusSquared = radius * radius;
        points.push_back(point);
    }
    cellMeters_ = largest > 0.0 ? 2.0 * largest : 1.0;
    sortIntoBuckets(std::move(points));
}

ViewedCaustics::Cell ViewedCaustics::cellOf(const glm::dvec3& position) const {
    return Cell(glm::floor(position / cellMeters_));
}

std::size_t ViewedCaustics::bucketOf(const Cell& cell) const {
    // Teschner et al. 2003, "Optimized Spatial Hashing", section 4.1.
    const auto hash = (static_cast<std::uint32_t>(cell.x) * 73856093u) ^
                      (static_cast<std::uint32_t>(cell.y) * 19349663u) ^
                      (static_cast<std::uint32_t>(cell.z) * 83492791u);
    return hash % (bucketBegin_.size() - 1);
}

void ViewedCaustics::sortIntoBuckets(std::vector<Point> points) {
    bucketBegin_.assign(std::max<std::size_t>(points.size(), 1) + 1, 0);
    for (Point& point : points) {
        point.cell = cellOf(point.position);
        ++bucketBegin_[bucketOf(point.cell) + 1];
    }
    for (std::size_t i = 1; i < bucketBegin_.size(); ++i)
        bucketBegin_[i] += bucketBegin_[i - 1];
    std::vector<std::uint32_t> next(bucketBegin_.begin(), bucketBegin_.end() - 1);
    points_.resize(points.size());
    for (const Point& point : points)
        points_[next[bucketOf(point.cell)]++] = point;
}

void ViewedCaustics::add(const SurfaceHit& hit, const PhotonState& photon, double* radiance) const {
    if (points_.empty()) return;
    const glm::dvec3 lit = glm::dot(hit.geometricNormal, photon.direction) < 0.0
                               ? hit.geometricNormal
                               : -hit.geometricNormal;
    // A cell is as wide as the largest reach to both sides: eight of them hold every point.
    const Cell first = cellOf(hit.position - 0.5 * cellMeters_);
    for (int corner = 0; corner < 8; ++corner) {
        const Cell cell = first + Cell(corner & 1, (corner >> 1) & 1, corner >> 2);
        const std::size_t bucket = bucketOf(cell);
        for (std::uint32_t i = bucketBegin_[bucket]; i < bucketBegin_[bucket + 1]; ++i) {
            const Point& point = points_[i];
            if (point.cell != cell) continue;  // another cell of this bucket
            const glm::dvec3 offset = hit.position - point.position;
            const double distanceSquared = glm::dot(offset, offset);
            if (distanceSquared > point.radiusSquared || glm::dot(lit, point.normal) < kMinCosine) {
                continue;
            }
            const glm::dvec3 value =
                photon.fluxWatts * densityExtrapolated(distanceSquared, point.radiusSquared) *
                photon.wavelength.tinted(point.throughput *
                                         scene_.appearance().brdf(point.material, point.uv,
                                                                  point.shadingNormal,
                                                                  -photon.direction, point.toEye));
            for (int channel = 0; channel < 3; ++channel)
                radiance[std::size_t{3} * point.pixel + static_cast<std::size_t>(channel)] +=
                    value[channel];
        }
    }
}

}  // namespace kaustik::reference
