// SPDX-License-Identifier: MIT
#include "framework/reference/wrong_fresnel.h"

#include <algorithm>
#include <cmath>

#include "framework/reference/batches.h"
#include "framework/reference/eye.h"
#include "framework/reference/light_sampling.h"
#include "framework/reference/light_tracing.h"
#include "framework/reference/light_transport.h"

namespace kaustik::reference {
namespace {

using Weights = std::array<double, kWrongFresnels.size()>;
constexpr Weights kOnes = {1.0, 1.0, 1.0};

double cosineBehind(double cosine, double from, double to) {
    const double eta = from / to;
    return std::sqrt(std::max(1.0 - eta * eta * (1.0 - cosine * cosine), 0.0));
}

// What becomes of the weights at one dielectric.
struct Interaction {
    Weights reflected = kOnes;
    Weights refracted = kOnes;
};

Interaction interactionOf(double cosine, double reflectance, double from, double to) {
    Interaction result;
    // Total reflection is one by any law, and what is not reflected at all has no direction.
    if (!(reflectance < 1.0) || !(reflectance > 0.0)) return result;
    for (std::size_t i = 0; i < kWrongFresnels.size(); ++i) {
        const double wrong = reflectanceOf(kWrongFresnels[i], cosine, from, to);
        const double passed = kWrongFresnels[i] == WrongFresnel::lossless ? 1.0 : 1.0 - wrong;
        result.reflected[i] = wrong / reflectance;
        result.refracted[i] = passed / (1.0 - reflectance);
    }
    return result;
}

// Follows the one path of each photon (nothing is split), with the weights of what is behind it.
class Camera : public NullSink {
  public:
    Camera(const EmbreeScene& scene, const Eye& eye, BatchResult& result)
        : scene_(scene), eye_(eye), result_(result) {}

    void emitted(const glm::dvec3&) {
        weights_ = kOnes;
        isOpen_ = false;
    }

    void hitSurface(const SurfaceHit& hit, const PhotonState& photon) {
        ++result_.rays;
        close(photon);
        if (scene_.scene().materials[hit.material].kind != scene::MaterialKind::dielectric) return;
        const auto [before, behind] = indicesAt(hit, photon);
        const Branches branches = branchesAt(hit, photon.direction, before, behind, false);
        // The normal that bent the light may be the triangle's own: the reflected ray tells.
        const double cosine = 0.5 * glm::length(branches.reflected - photon.direction);
        open_ = interactionOf(std::min(cosine, 1.0), branches.reflectance, before, behind);
        isOpen_ = true;
    }

    void arrived(const SurfaceHit& hit, const PhotonState& photon) {
        ++result_.rays;
        close(photon);
        if (!std::isfinite(photon.fluxWatts.x + photon.fluxWatts.y + photon.fluxWatts.z)) return;
        const Projection at = eye_.project(hit.position);
        if (!at.onScreen || !eye_.seesSide(hit.position, hit.geometricNormal, photon.direction) ||
            !eye_.isVisible(scene_, hit.position, hit.triangle, at.depth))
            return;
        const glm::dvec3 irradiance =
            photon.fluxWatts * eye_.coverage(hit.position, hit.geometricNormal, at.depth);
        const std::size_t layer =
            3 * static_cast<std::size_t>(eye_.width()) * static_cast<std::size_t>(eye_.height());
        double* pixel = result_.values.data() + at.pixel * std::size_t{3};
        add(pixel, irradiance);
        for (std::size_t i = 0; i < weights_.size(); ++i)
            add(pixel + (i + 1) * layer, weights_[i] * irradiance);
    }

  private:
    static void add(double* pixel, const glm::dvec3& value) {
        pixel[0] += value.x;
        pixel[1] += value.y;
        pixel[2] += value.z;
    }

    // The last interaction is over: which way the photon went is in its path.
    void close(const PhotonState& photon) {
        if (!isOpen_) return;
        const bool isReflected = (photon.reflections >> (photon.interactions - 1) & 1u) != 0;
        const Weights& factors = isReflected ? open_.reflected : open_.refracted;
        for (std::size_t i = 0; i < weights_.size(); ++i)
            weights_[i] *= factors[i];
        isOpen_ = false;
    }

    // As LightTransport has them.
    [[nodiscard]] std::pair<double, double> indicesAt(const SurfaceHit& hit,
                                                      const PhotonState& photon) const {
        const auto indexOf = [&](std::uint32_t medium) {
            return medium == 0 ? 1.0
                               : scene::indexAt(scene_.scene().materials[medium - 1],
                                                photon.wavelength.place);
        };
        const MediaStack& media = photon.media;
        const double before = indexOf(media.inner());
        if (glm::dot(photon.direction, hit.geometricNormal) < 0.0)
            return {before, indexOf(hit.material + 1)};
        return {before, media.inner() == hit.material + 1 ? indexOf(media.outer()) : before};
    }

    const EmbreeScene& scene_;
    const Eye& eye_;
    BatchResult& result_;
    Weights weights_ = kOnes;
    Interaction open_;
    bool isOpen_ = false;  // an interaction has begun, and `open_` holds what it does
};

}  // namespace

double reflectanceOf(WrongFresnel law, double cosine, double from, double to) {
    const auto exact = [cosine](double before, double behind) {
        const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
        return interactAt({sine, 0.0, -cosine}, {0.0, 0.0, 1.0}, before, behind).reflectance;
    };
    if (law == WrongFresnel::swapped) return exact(to, from);
    if (law == WrongFresnel::lossless) return exact(from, to);
    const double straight = std::pow((from - to) / (from + to), 2.0);
    const double larger = from > to ? cosineBehind(cosine, from, to) : cosine;
    return straight + (1.0 - straight) * std::pow(1.0 - larger, 5.0);
}

std::array<Image, kWrongFresnels.size()> changesByWrongFresnel(const EmbreeScene& scene,
                                                               const WrongFresnelRequest& request) {
    LightTraceSettings settings;
    settings.width = request.width;
    settings.height = request.height;
    settings.seed = request.seed;
    settings.filter.splitInteractions = 0;
    settings.filter.maximumInteractions = kLongestPathWord;
    PixelSums sums =
        makeEstimatorSums(scene, settings, static_cast<int>(kWrongFresnels.size()) + 1);
    const LightSampler sampler(scene, settings.photonsPerBatch);
    const Eye eye(scene, settings.width, settings.height);
    const LightTransport transport(scene, settings.filter);
    RunOptions options;
    options.stop.photons = request.photons;
    options.threads = request.threads;
    if (request.shouldContinue)
        options.pulse = [&](std::uint64_t) { return request.shouldContinue(); };
    runBatches(sums, options,
               [&](std::uint64_t batch, BatchResult& result, const TracedMore& tracedMore) {
                   Camera camera(scene, eye, result);
                   for (std::uint64_t i = 0; i < sampler.photonsPerBatch(); ++i) {
                       if (i % kPhotonsPerPulse == 0 && !tracedMore(i == 0 ? 0 : kPhotonsPerPulse))
                           return;
                       Random random(settings.seed, batch, i);
                       const EmittedPhoton emitted = sampler.sample(i, random);
                       transport.follow(stateOf(emitted), emitted.reach, random, camera);
                   }
                   result.photons = sampler.photonsPerBatch();
               });
    std::array<Image, kWrongFresnels.size()> changes;
    const bool isEnded = request.shouldContinue && !request.shouldContinue();
    if (isEnded) return changes;
    const Image right = sums.meanImage(0);
    for (std::size_t i = 0; i < changes.size(); ++i) {
        changes[i] = sums.meanImage(static_cast<int>(i) + 1);
        for (std::size_t at = 0; at < right.values.size(); ++at)
            changes[i].values[at] -= right.values[at];
    }
    return changes;
}

}  // namespace kaustik::reference
