// SPDX-License-Identifier: MIT
#include "framework/reference/light_sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace kaustik::reference {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kOrientations = 48;
// So that rounding cuts nothing off; what misses is no event.
constexpr double kMargin = 1e-6;

struct Basis {
    glm::dvec3 a, b;
};

// Two unit vectors at right angles to `along` and to each other; the first horizontal if possible.
Basis basisAround(const glm::dvec3& along) {
    const glm::dvec3 upwards =
        std::abs(along.y) < 0.999999 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 a = glm::normalize(glm::cross(upwards, along));
    return {a, glm::cross(along, a)};
}

struct Rectangle {
    glm::dvec2 low{std::numeric_limits<double>::max()};
    glm::dvec2 high{std::numeric_limits<double>::lowest()};
    [[nodiscard]] double area() const { return (high.x - low.x) * (high.y - low.y); }
};

Rectangle extentOf(const std::vector<glm::dvec3>& points, const Basis& basis) {
    Rectangle extent;
    for (const glm::dvec3& point : points) {
        const glm::dvec2 at(glm::dot(point, basis.a), glm::dot(point, basis.b));
        extent.low = glm::min(extent.low, at);
        extent.high = glm::max(extent.high, at);
    }
    return extent;
}

struct Cell {
    std::uint64_t column = 0;
    std::uint64_t row = 0;
};

// Cells in strips of several rows, so that one photon goes much the same way as the ones before it:
// they hit the same triangles and pixels while a cache holds them.
Cell cellOf(std::uint64_t index, std::uint64_t columns, std::uint64_t rows) {
    constexpr std::uint64_t kStripRows = 16;
    const std::uint64_t firstRow = index / (columns * kStripRows) * kStripRows;
    const std::uint64_t rowsHere = std::min(kStripRows, rows - firstRow);
    const std::uint64_t within = index - firstRow * columns;
    return {within / rowsHere, firstRow + within % rowsHere};
}

double total(const glm::vec3& power) {
    return static_cast<double>(power.r) + static_cast<double>(power.g) +
           static_cast<double>(power.b);
}

}  // namespace

LightSampler::Share LightSampler::aimDirectional(const scene::Light& light,
                                                 const EmbreeScene& scene) {
    const glm::dvec3 along = glm::normalize(light.direction);
    const Basis plain = basisAround(along);
    Basis best = plain;
    Rectangle extent = extentOf(scene.specularVertices(), plain);
    for (int i = 1; i < kOrientations; ++i) {
        const double angle = 0.5 * kPi * i / kOrientations;
        const Basis turned{std::cos(angle) * plain.a + std::sin(angle) * plain.b,
                           std::cos(angle) * plain.b - std::sin(angle) * plain.a};
        const Rectangle other = extentOf(scene.specularVertices(), turned);
        if (other.area() < extent.area()) {
            best = turned;
            extent = other;
        }
    }
    const glm::dvec2 margin = kMargin * (extent.high - extent.low) + 1e-12;
    extent.low -= margin;
    extent.high += margin;
    // The photons start before everything that could throw a shadow.
    const scene::Bounds& bounds = scene.bounds();
    const double radius = 0.5 * glm::length(bounds.maximum - bounds.minimum);
    const glm::dvec3 middle = 0.5 * (bounds.minimum + bounds.maximum);
    const double before = glm::dot(middle, along) - 1.01 * radius;
    Share share;
    share.light = &light;
    share.along = along;
    share.corner = extent.low.x * best.a + extent.low.y * best.b + before * along;
    share.sideA = (extent.high.x - extent.low.x) * best.a;
    share.sideB = (extent.high.y - extent.low.y) * best.b;
    share.measure = extent.area();
    return share;
}

LightSampler::Share LightSampler::aimCone(const scene::Light& light, const EmbreeScene& scene) {
    Share share;
    share.light = &light;
    share.corner = light.position - scene.center();
    glm::dvec3 low(std::numeric_limits<double>::max());
    glm::dvec3 high(std::numeric_limits<double>::lowest());
    for (const glm::dvec3& point : scene.specularVertices()) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    const glm::dvec3 axis = 0.5 * (low + high) - share.corner;
    const double length = glm::length(axis);
    share.along = length > 0.0 ? axis / length : glm::dvec3(0, -1, 0);
    // A cone narrower than a half space is convex: it holds a triangle when it holds its corners.
    double cosine = 1.0;
    for (const glm::dvec3& point : scene.specularVertices()) {
        const glm::dvec3 towards = point - share.corner;
        const double size = glm::length(towards);
        cosine = std::min(cosine, size > 0.0 ? glm::dot(towards, share.along) / size : -1.0);
    }
    share.cosine = cosine > 0.0 ? std::max(cosine - kMargin, 0.0) : -1.0;
    if (light.kind == scene::LightKind::spot) {
        const double outer = std::cos(static_cast<double>(light.outerConeRadians));
        if (outer > share.cosine) {
            share.cosine = outer;
            share.along = glm::normalize(light.direction);
        }
    }
    const Basis basis = basisAround(share.along);
    share.sideA = basis.a;
    share.sideB = basis.b;
    share.measure = 2.0 * kPi * (1.0 - share.cosine);
    return share;
}

LightSampler::LightSampler(const EmbreeScene& scene, std::uint64_t photonsPerBatch)
    : appearance_(&scene.appearance()) {
    if (scene.specularVertices().empty()) return;
    for (const scene::Light& light : scene.scene().lights) {
        if (total(light.power) <= 0.0) continue;
        Share share = light.kind == scene::LightKind::directional ? aimDirectional(light, scene)
                                                                  : aimCone(light, scene);
        if (share.measure <= 0.0) continue;
        fluxWatts_ += total(light.power) * share.measure;
        shares_.push_back(share);
    }
    for (Share& share : shares_) {
        const double part = total(share.light->power) * share.measure / fluxWatts_;
        const double wanted = std::max(1.0, part * static_cast<double>(photonsPerBatch));
        // Cells about as wide as high: on the cone's unit square one turn is the long side.
        const double aspect = share.light->kind == scene::LightKind::directional
                                  ? glm::length(share.sideA) / glm::length(share.sideB)
                                  : kPi;
        const double columns = std::clamp(std::round(std::sqrt(wanted * aspect)), 1.0, wanted);
        share.columns = static_cast<std::uint64_t>(columns);
        share.rows = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(wanted / columns));
        share.first = photonCount_;
        photonCount_ += share.columns * share.rows;
    }
}

EmittedPhoton LightSampler::sample(std::uint64_t index, Random& random) const {
    std::size_t s = shares_.size() - 1;
    while (shares_[s].first > index)
        --s;
    const Share& share = shares_[s];
    const Cell cell = cellOf(index - share.first, share.columns, share.rows);
    const double u =
        (static_cast<double>(cell.column) + random.uniform()) / static_cast<double>(share.columns);
    const double v =
        (static_cast<double>(cell.row) + random.uniform()) / static_cast<double>(share.rows);
    const double weight = share.measure / static_cast<double>(share.columns * share.rows);
    const scene::Light& light = *share.light;
    EmittedPhoton photon;
    if (light.kind == scene::LightKind::directional) {
        photon.reach.isDistant = true;
        photon.origin = share.corner + u * share.sideA + v * share.sideB;
        photon.direction = share.along;
        photon.fluxWatts = weight * glm::dvec3(light.power);
        return photon;
    }
    const double cosine = 1.0 - v * (1.0 - share.cosine);
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const double turn = 2.0 * kPi * u;
    photon.origin = share.corner;
    photon.direction = glm::normalize(cosine * share.along + sine * std::cos(turn) * share.sideA +
                                      sine * std::sin(turn) * share.sideB);
    photon.fluxWatts = weight * glm::dvec3(light.power);
    if (light.kind == scene::LightKind::spot) {
        const double falloff =
            spotFalloff(light, glm::dot(photon.direction, glm::normalize(light.direction)));
        photon.fluxWatts *= falloff > 0.0
                                ? falloff * appearance_->spotColor(light, photon.direction)
                                : glm::dvec3(0.0);
    }
    if (light.rangeMeters > 0.0f) photon.reach.rangeMeters = static_cast<double>(light.rangeMeters);
    return photon;
}

}  // namespace kaustik::reference
