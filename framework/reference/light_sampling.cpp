// SPDX-License-Identifier: MIT
#include "framework/reference/light_sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "framework/scene/basis.h"

namespace kaustik::reference {
namespace {

using scene::Basis;
using scene::basisAround;

constexpr double kPi = std::numbers::pi;
constexpr int kOrientations = 48;
// So that rounding cuts nothing off; what misses is no event.
constexpr double kMargin = 1e-6;

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
    // The photons start before everything that could throw a shadow.
    const scene::Bounds& bounds = scene.bounds();
    const double radius = 0.5 * glm::length(bounds.maximum - bounds.minimum);
    const double discRadius = std::tan(0.5 * static_cast<double>(light.angularDiameterRadians));
    const glm::dvec2 margin =
        kMargin * (extent.high - extent.low) + 1e-12 + 2.01 * radius * discRadius;
    extent.low -= margin;
    extent.high += margin;
    const glm::dvec3 middle = 0.5 * (bounds.minimum + bounds.maximum);
    const double before = glm::dot(middle, along) - 1.01 * radius;
    Share share;
    share.light = &light;
    share.along = along;
    share.corner = extent.low.x * best.a + extent.low.y * best.b + before * along;
    share.sideA = (extent.high.x - extent.low.x) * best.a;
    share.sideB = (extent.high.y - extent.low.y) * best.b;
    share.measure = extent.area();
    share.discRadius = discRadius;
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

// The rectangle of numbers goes over the cone around the ball of specular surfaces; which point of
// the surface a photon starts from is drawn.
LightSampler::Share LightSampler::aimSurface(const scene::Light& light, const scene::Object& object,
                                             const EmbreeScene& scene) const {
    Share share;
    share.light = &light;
    share.surface = std::make_shared<const scene::EmittingSurface>(scene.scene(), object);
    share.corner = -scene.center();
    // As much as may be sent towards the ball from where it is nearest: a bound that deals photons.
    share.measure = share.surface->areaSquareMeters() * kPi;
    return share;
}

void LightSampler::add(Share share) {
    const double watts = total(share.light->power) * share.measure;
    if (!(watts > 0.0)) return;
    fluxWatts_ += watts;
    shares_.push_back(std::move(share));
}

LightSampler::LightSampler(const EmbreeScene& scene, std::uint64_t photonsPerBatch)
    : appearance_(&scene.appearance()), disperses_(scene::disperses(scene.scene())) {
    if (scene.specularVertices().empty()) return;
    glm::dvec3 low(std::numeric_limits<double>::max());
    glm::dvec3 high(std::numeric_limits<double>::lowest());
    for (const glm::dvec3& point : scene.specularVertices()) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    targetMiddle_ = 0.5 * (low + high);
    for (const glm::dvec3& point : scene.specularVertices())
        targetRadius_ = std::max(targetRadius_, glm::distance(point, targetMiddle_));
    targetRadius_ *= 1.0 + kMargin;
    const scene::Bounds& bounds = scene.bounds();
    middle_ = 0.5 * (bounds.minimum + bounds.maximum);
    radius_ = 0.5 * glm::length(bounds.maximum - bounds.minimum);
    startMargin_ = kMargin * glm::length(scene.bounds().maximum - scene.bounds().minimum);
    const auto aim = [&](const scene::Light& light) {
        add(light.kind == scene::LightKind::directional ? aimDirectional(light, scene)
                                                        : aimCone(light, scene));
    };
    for (const scene::Light& light : scene.scene().lights) {
        if (light.emitter < 0 && light.band == 0) aim(light);
    }
    for (const scene::Emitter& emitter : scene.scene().emitters) {
        if (emitter.isDisc()) {
            aim(emitter.light);
            continue;
        }
        if (emitter.environment) {
            scene::Light light;
            light.power = glm::vec3(emitter.environment->fluxPerSquareMeter());
            surfaceLights_.push_back(std::move(light));
            Share share;
            share.light = &surfaceLights_.back();
            share.environment = emitter.environment.get();
            share.measure = kPi * targetRadius_ * targetRadius_;
            add(std::move(share));
            continue;
        }
        const scene::Object& object = scene.scene().objects[*emitter.object];
        scene::Light light;
        light.name = object.name;
        light.kind = scene::LightKind::surface;
        light.power = scene.scene().materials[object.material].emission;
        surfaceLights_.push_back(std::move(light));
        add(aimSurface(surfaceLights_.back(), object, scene));
    }
    for (Share& share : shares_) {
        const double part = total(share.light->power) * share.measure / fluxWatts_;
        const double wanted = std::max(1.0, part * static_cast<double>(photonsPerBatch));
        // Cells about as wide as high: on the cone's unit square one turn is the long side.
        const bool isRectangle =
            share.light->kind == scene::LightKind::directional && share.environment == nullptr;
        const double aspect =
            isRectangle ? glm::length(share.sideA) / glm::length(share.sideB) : kPi;
        const double columns = std::clamp(std::round(std::sqrt(wanted * aspect)), 1.0, wanted);
        share.columns = static_cast<std::uint64_t>(columns);
        share.rows = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(wanted / columns));
        share.first = photonCount_;
        photonCount_ += share.columns * share.rows;
    }
}

EmittedPhoton LightSampler::sample(std::uint64_t index, Random& random) const {
    EmittedPhoton photon = sampleColor(index, random);
    if (!disperses_) return photon;
    const scene::DrawnWavelength drawn = scene::drawWavelength(random.uniform());
    photon.fluxWatts = drawn.ofLight * photon.fluxWatts;
    photon.wavelength = {scene::dispersionPlace(drawn.nanometers), drawn.tint};
    return photon;
}

// As if light of all wavelengths went one way.
EmittedPhoton LightSampler::sampleColor(std::uint64_t index, Random& random) const {
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
    if (share.surface) return sampleSurface(share, u, v, random);
    if (share.environment != nullptr) return sampleEnvironment(share, u, v, random);
    if (light.kind == scene::LightKind::directional) {
        photon.reach.isDistant = true;
        photon.origin = share.corner + u * share.sideA + v * share.sideB;
        photon.direction = share.along;
        photon.fluxWatts = weight * glm::dvec3(light.power);
        if (share.discRadius > 0.0) {
            // Even over the disc as the plane at right angles sees it, so that each brings as much.
            const double sine = std::sin(std::atan(share.discRadius)) * std::sqrt(random.uniform());
            const double turn = 2.0 * kPi * random.uniform();
            const Basis basis = basisAround(share.along);
            photon.direction =
                glm::normalize(std::sqrt(1.0 - sine * sine) * share.along +
                               sine * std::cos(turn) * basis.a + sine * std::sin(turn) * basis.b);
        }
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

// Two of the numbers say where on the disc that the ball of specular surfaces shows.
EmittedPhoton LightSampler::sampleEnvironment(const Share& share, double u, double v,
                                              Random& random) const {
    const double which = random.uniform();
    const double across = random.uniform();
    const scene::EmittingEnvironment::Part drawn =
        share.environment->draw(which, across, random.uniform());
    const glm::dvec3 towards = drawn.direction;
    const glm::dvec3 flux = drawn.fluxPerSquareMeter;
    EmittedPhoton photon;
    photon.reach.isDistant = true;
    photon.direction = -towards;
    const Basis basis = basisAround(photon.direction);
    const double away = targetRadius_ * std::sqrt(v);
    const double turn = 2.0 * kPi * u;
    photon.origin =
        targetMiddle_ + away * std::cos(turn) * basis.a + away * std::sin(turn) * basis.b;
    // Before everything that could throw a shadow.
    photon.origin +=
        (glm::dot(middle_ - photon.origin, photon.direction) - 1.01 * radius_) * photon.direction;
    photon.fluxWatts = flux * (share.measure / static_cast<double>(share.columns * share.rows));
    return photon;
}

EmittedPhoton LightSampler::sampleSurface(const Share& share, double u, double v,
                                          Random& random) const {
    const double which = random.uniform();
    const double first = random.uniform();
    const auto [position, normal] = share.surface->at(which, first, random.uniform());
    EmittedPhoton photon;
    photon.origin = position + share.corner + startMargin_ * normal;
    const glm::dvec3 towards = targetMiddle_ - photon.origin;
    const double distance = glm::length(towards);
    // Within the ball the light goes anywhere in front of the surface.
    const bool isOutside = distance > targetRadius_;
    const glm::dvec3 axis = isOutside ? towards / distance : normal;
    const double sineOfCone = isOutside ? targetRadius_ / distance : 1.0;
    const double cosineOfCone = std::sqrt(std::max(0.0, 1.0 - sineOfCone * sineOfCone));
    const double cosine = 1.0 - v * (1.0 - cosineOfCone);
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const double turn = 2.0 * kPi * u;
    const Basis basis = basisAround(axis);
    photon.direction = glm::normalize(cosine * axis + sine * std::cos(turn) * basis.a +
                                      sine * std::sin(turn) * basis.b);
    const double solidAngle = 2.0 * kPi * (1.0 - cosineOfCone);
    const double slant = std::max(glm::dot(photon.direction, normal), 0.0);
    photon.fluxWatts =
        glm::dvec3(share.light->power) * (slant * solidAngle * share.surface->areaSquareMeters() /
                                          static_cast<double>(share.columns * share.rows));
    return photon;
}

}  // namespace kaustik::reference
