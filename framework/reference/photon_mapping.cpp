// SPDX-License-Identifier: MIT
#include "framework/reference/photon_mapping.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "framework/core/error.h"
#include "framework/reference/eye.h"
#include "framework/reference/light_sampling.h"
#include "framework/reference/light_tracing.h"
#include "framework/reference/photon_density.h"
#include "framework/reference/viewed_caustics.h"
#include "framework/scene/needs.h"

namespace kaustik::reference {
namespace {

// What the eye sees through one point of a pixel.
struct VisiblePoint {
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0};       // geometric, towards the eye
    double radiusSquared = -1.0;  // m²; negative: no receiver
};

// How that point reflects.
struct Reflector {
    std::uint32_t material = 0;
    glm::dvec2 uv{0.0};
    glm::dvec3 shadingNormal{0.0};  // on the eye's side
    glm::dvec3 toEye{0.0};          // unit
};

// `reflectors`: one a point, where asked for.
std::vector<VisiblePoint> findVisiblePoints(const EmbreeScene& scene, const Eye& eye,
                                            std::uint64_t seed, std::uint64_t pass, double radius,
                                            std::vector<Reflector>* reflectors) {
    std::vector<VisiblePoint> points(static_cast<std::size_t>(eye.width()) *
                                     static_cast<std::size_t>(eye.height()));
    if (reflectors != nullptr) reflectors->resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        // Not the photons' stream of numbers.
        Random random(~seed, pass, i);
        const double column =
            static_cast<double>(i % static_cast<std::size_t>(eye.width())) + random.uniform();
        const double row =
            static_cast<double>(i / static_cast<std::size_t>(eye.width())) + random.uniform();
        const glm::dvec3 ray = eye.ray(column, row);
        SurfaceHit hit;
        if (!scene.intersectStraight(eye.position() + eye.nearMeters() * ray, glm::normalize(ray),
                                     hit)) {
            continue;
        }
        if (!isReceiver(scene.scene().materials[hit.material].kind)) continue;
        const double depth = glm::length(hit.position - eye.position()) / glm::length(ray);
        const bool isFront = glm::dot(hit.geometricNormal, eye.position() - hit.position) > 0.0;
        const double radiusMeters = radius * eye.footprintPerMeter() * depth;
        points[i] = {hit.position, isFront ? hit.geometricNormal : -hit.geometricNormal,
                     radiusMeters * radiusMeters};
        if (reflectors == nullptr) continue;
        (*reflectors)[i] = {hit.material, hit.uv, isFront ? hit.shadingNormal : -hit.shadingNormal,
                            -glm::normalize(ray)};
    }
    return points;
}

// Adds each photon that arrives to the visible points around it.
class Gatherer {
  public:
    Gatherer(const EmbreeScene& scene, const Eye& eye, const PhotonMappingSettings& settings,
             std::uint64_t pass, BatchResult& result)
        : scene_(scene),
          eye_(eye),
          hasRadiance_(sceneNeeds(scene.scene()).glossyReceivers),
          points_(findVisiblePoints(scene, eye, settings.seed, pass, radiusPixels(settings, pass),
                                    hasRadiance_ ? &reflectors_ : nullptr)),
          result_(result) {
        // How far apart on the screen two points can be that are one radius apart: rays at the
        // picture's corner spread radial distances the most.
        const glm::dvec3 corner = eye.ray(0.0, 0.0);
        const double radius = radiusPixels(settings, pass);
        const double nearer = 1.0 - radius * eye.footprintPerMeter();
        reach_ = radius * glm::length(corner) / std::max(nearer, 0.1);
        within_ = points_.size() * 3 * kNearRadiusLayer;
        radiance_ = points_.size() * 3 * kMappedRadianceLayer;
        const int viewLayer = viewedCausticsLayer(scene.scene(), settings);
        if (viewLayer < 0) return;
        view_.emplace(scene, eye, settings.seed, pass, radius);
        viewed_ = points_.size() * 3 * static_cast<std::size_t>(viewLayer);
    }

    void emitted(const glm::dvec3& flux) { result_.energy.add(transport::kAccountEmitted, flux); }
    void absorbed(const glm::dvec3& flux) { result_.energy.add(transport::kAccountAbsorbed, flux); }
    void lost(unsigned account, const glm::dvec3& flux) { result_.energy.add(account, flux); }
    void passed(const PhotonState&, double, const glm::dvec3&, Random&) {}
    void leftScene(const PhotonState& photon) {
        ++result_.rays;
        result_.energy.add(transport::kAccountLeftScene, photon.fluxWatts);
    }
    void hitSurface(const SurfaceHit&, const PhotonState&) { ++result_.rays; }

    void arrived(const SurfaceHit& hit, const PhotonState& photon) {
        ++result_.rays;
        const glm::dvec3& flux = photon.fluxWatts;
        if (!std::isfinite(flux.x + flux.y + flux.z + hit.distance)) {
            result_.energy.watts[transport::kAccountNotANumber] += 1.0;
            return;
        }
        result_.energy.add(transport::kAccountDeposited, flux);
        if (view_) view_->add(hit, photon, result_.values.data() + viewed_);
        const glm::dvec2 at = eye_.pixelOf(hit.position);
        if (!std::isfinite(at.x + at.y)) return;
        const glm::dvec3 lit = glm::dot(hit.geometricNormal, photon.direction) < 0.0
                                   ? hit.geometricNormal
                                   : -hit.geometricNormal;
        const auto range = [this](double middle, int count) {
            const double last = static_cast<double>(count - 1);
            return std::pair(static_cast<int>(std::clamp(std::floor(middle - reach_), 0.0, last)),
                             static_cast<int>(std::clamp(std::floor(middle + reach_), -1.0, last)));
        };
        const auto [left, right] = range(at.x, eye_.width());
        const auto [top, bottom] = range(at.y, eye_.height());
        for (int row = top; row <= bottom; ++row) {
            for (int column = left; column <= right; ++column)
                add(static_cast<std::size_t>(row) * static_cast<std::size_t>(eye_.width()) +
                        static_cast<std::size_t>(column),
                    hit.position, lit, photon);
        }
    }

  private:
    void add(std::size_t pixel, const glm::dvec3& position, const glm::dvec3& lit,
             const PhotonState& photon) {
        const VisiblePoint& point = points_[pixel];
        const glm::dvec3 offset = position - point.position;
        const double distanceSquared = glm::dot(offset, offset);
        if (distanceSquared > point.radiusSquared || glm::dot(lit, point.normal) < kMinCosine)
            return;
        const glm::dvec3 within = photon.fluxWatts * densityWithin(point.radiusSquared);
        const glm::dvec3 atPoint =
            photon.fluxWatts * densityExtrapolated(distanceSquared, point.radiusSquared);
        double* extrapolated = result_.values.data() + 3 * pixel;
        double* plain = extrapolated + within_;
        for (int channel = 0; channel < 3; ++channel) {
            extrapolated[channel] += atPoint[channel];
            plain[channel] += within[channel];
        }
        if (!hasRadiance_) return;
        const Reflector& at = reflectors_[pixel];
        const glm::dvec3 reflected =
            atPoint * photon.wavelength.tinted(scene_.appearance().brdf(
                          at.material, at.uv, at.shadingNormal, -photon.direction, at.toEye));
        double* radiance = result_.values.data() + radiance_ + 3 * pixel;
        for (int channel = 0; channel < 3; ++channel)
            radiance[channel] += reflected[channel];
    }

    const EmbreeScene& scene_;
    const Eye& eye_;
    bool hasRadiance_;
    std::vector<Reflector> reflectors_;  // before `points_`, which fills it
    std::vector<VisiblePoint> points_;
    BatchResult& result_;
    double reach_ = 0.0;        // pixels
    std::size_t within_ = 0;    // first value of the layer
    std::size_t radiance_ = 0;  // the same
    std::size_t viewed_ = 0;    // the same
    std::optional<ViewedCaustics> view_;
};

// The first layer after those of irradiance and radiance.
int firstFreeLayer(const scene::Scene& scene) {
    return sceneNeeds(scene).glossyReceivers ? kMappedRadianceLayer + 1 : kMappedRadianceLayer;
}

LightTraceSettings lightSettings(const PhotonMappingSettings& settings) {
    return {settings.width, settings.height, settings.photonsPerBatch,
            settings.seed,  settings.filter, {}};
}

}  // namespace

double radiusPixels(const PhotonMappingSettings& settings, std::uint64_t pass) {
    // Knaus and Zwicker 2011, equation 15.
    double square = settings.initialRadiusPixels * settings.initialRadiusPixels;
    for (std::uint64_t i = 1; i <= pass; ++i) {
        const auto n = static_cast<double>(i);
        square *= (n + settings.alpha) / (n + 1.0);
    }
    return std::sqrt(square);
}

PixelSums makePhotonMappingSums(const EmbreeScene& scene, const PhotonMappingSettings& settings) {
    if (!(settings.initialRadiusPixels > 0.0 && settings.initialRadiusPixels <= 16.0))
        throw ConfigError("The initial radius must be above 0 and at most 16 pixels.");
    if (!(settings.alpha > 0.0 && settings.alpha < 1.0))
        throw ConfigError("alpha must lie between 0 and 1.");
    return makeEstimatorSums(scene, lightSettings(settings),
                             firstFreeLayer(scene.scene()) + (settings.followsView ? 1 : 0));
}

int viewedCausticsLayer(const scene::Scene& scene, const PhotonMappingSettings& settings) {
    return settings.followsView ? firstFreeLayer(scene) : -1;
}

void photonMapping(const EmbreeScene& scene, const PhotonMappingSettings& settings,
                   const RunOptions& options, PixelSums& sums) {
    const LightSampler sampler(scene, settings.photonsPerBatch);
    const Eye eye(scene, settings.width, settings.height);
    const LightTransport transport(scene, settings.filter);
    runBatches(sums, options,
               [&](std::uint64_t pass, BatchResult& result, const TracedMore& tracedMore) {
                   Gatherer gatherer(scene, eye, settings, pass, result);
                   for (std::uint64_t i = 0; i < sampler.photonsPerBatch(); ++i) {
                       if (i % kPhotonsPerPulse == 0 && !tracedMore(i == 0 ? 0 : kPhotonsPerPulse))
                           return;
                       Random random(settings.seed, pass, i);
                       const EmittedPhoton emitted = sampler.sample(i, random);
                       ++result.rays;
                       transport.follow(stateOf(emitted), emitted.reach, random, gatherer);
                   }
                   result.photons = sampler.photonsPerBatch();
               });
}

}  // namespace kaustik::reference
