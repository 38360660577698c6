// SPDX-License-Identifier: MIT
#include "framework/reference/light_tracing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "framework/core/error.h"
#include "framework/reference/eye.h"
#include "framework/reference/light_sampling.h"
#include "framework/scene/needs.h"
#include "framework/transport/watts.h"

namespace kaustik::reference {
namespace {

// The Henyey-Greenstein phase function, 1/sr; `cosine`: of the angle of deflection.
double phase(double g, double cosine) {
    const double denominator = 1.0 + g * g - 2.0 * g * cosine;
    return (1.0 - g * g) / (4.0 * std::numbers::pi * denominator * std::sqrt(denominator));
}

bool scatters(const scene::Scene& scene) {
    return scene.medium && scene.medium->scatteringPerMeter != glm::vec3(0.0f);
}

// Turns the events of a photon's path into values of pixels.
class Camera {
  public:
    Camera(const EmbreeScene& scene, const Eye& eye, const std::vector<PathClass>& classes,
           BatchResult& result)
        : scene_(scene), eye_(eye), result_(result) {
        const std::size_t layerSize =
            static_cast<std::size_t>(eye.width()) * static_cast<std::size_t>(eye.height()) * 3;
        if (!classes.empty()) {
            classifier_.emplace(scene.scene(), classes);
            layerSize_ = layerSize;
            firstClass_ = layerSize * static_cast<std::size_t>(firstClassLayer(scene.scene()));
        }
        const int radianceLayer = causticRadianceLayer(scene.scene());
        if (radianceLayer > 0) radiance_ = layerSize * static_cast<std::size_t>(radianceLayer);
        if (!scatters(scene.scene())) return;
        const scene::Medium& medium = *scene.scene().medium;
        scattering_ = glm::dvec3(medium.scatteringPerMeter);
        mediumExtinction_ = scattering_ + glm::dvec3(medium.absorptionPerMeter);
        anisotropy_ = static_cast<double>(medium.anisotropy);
        inScattered_ = layerSize * static_cast<std::size_t>(inScatteredLayer(scene.scene()));
    }

    void emitted(const glm::dvec3& flux) { result_.energy.add(transport::kAccountEmitted, flux); }
    void absorbed(const glm::dvec3& flux) { result_.energy.add(transport::kAccountAbsorbed, flux); }
    void lost(unsigned account, const glm::dvec3& flux) { result_.energy.add(account, flux); }
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
        const Projection at = eye_.project(hit.position);
        if (!at.onScreen || !eye_.seesSide(hit.position, hit.geometricNormal, photon.direction))
            return;
        ++result_.rays;
        if (!eye_.isVisible(scene_, hit.position, hit.triangle, at.depth)) return;
        result_.energy.visibleWatts += transport::wattsOf(flux);
        const glm::dvec3 irradiance =
            flux * eye_.coverage(hit.position, hit.geometricNormal, at.depth);
        splat(at.pixel * std::size_t{3}, irradiance);
        if (classifier_) {
            const std::size_t place = classifier_->classOf(arrivedPathOf(photon));
            splat(firstClass_ + place * layerSize_ + at.pixel * std::size_t{3}, irradiance);
        }
        if (radiance_ == 0) return;
        const glm::dvec3 toEye = glm::normalize(eye_.position() - hit.position);
        const double side = glm::dot(hit.geometricNormal, toEye) > 0.0 ? 1.0 : -1.0;
        splat(radiance_ + at.pixel * std::size_t{3},
              irradiance *
                  photon.wavelength.tinted(scene_.appearance().brdf(
                      hit.material, hit.uv, side * hit.shadingNormal, -photon.direction, toEye)));
    }

    // One point of the path, chosen by its angle from the eye (Kulla and Fajardo 2012, section 4):
    // light that passes close by the eye is no noisier than light far from it.
    void passed(const PhotonState& photon, double distance, const glm::dvec3& extinction,
                Random& random) {
        if (inScattered_ == 0) return;
        const double end = std::min(distance, pathInsideBounds(photon));
        if (!(end > 0.0)) return;
        const glm::dvec3 toEye = eye_.position() - photon.origin;
        const double nearest = glm::dot(toEye, photon.direction);
        const double miss = std::max(glm::length(toEye - nearest * photon.direction), 1e-9);
        const double low = std::atan(-nearest / miss);
        const double high = std::atan((end - nearest) / miss);
        const double offset = miss * std::tan(low + (high - low) * random.uniform());
        const double along = std::clamp(nearest + offset, 0.0, end);
        const double perDensity = (high - low) * (miss * miss + offset * offset) / miss;
        const glm::dvec3 point = photon.origin + along * photon.direction;
        const Projection at = eye_.project(point);
        if (!at.onScreen || !eye_.isVisible(scene_, point, {}, at.depth)) return;
        const glm::dvec3 ray = eye_.position() - point;
        const double eyeDistance = glm::length(ray);
        const double scattered = phase(anisotropy_, glm::dot(photon.direction, ray) / eyeDistance);
        const glm::dvec3 toEyeExtinction = photon.wavelength.tinted(mediumExtinction_);
        const glm::dvec3 arriving =
            photon.fluxWatts * glm::exp(-extinction * along - toEyeExtinction * eyeDistance);
        splat(inScattered_ + at.pixel * std::size_t{3},
              arriving * photon.wavelength.tinted(scattering_) *
                  (scattered * perDensity * eye_.coverageOfPoint(point, at.depth)));
    }

  private:
    void splat(std::size_t first, const glm::dvec3& value) {
        double* pixel = result_.values.data() + first;
        pixel[0] += value.x;
        pixel[1] += value.y;
        pixel[2] += value.z;
    }

    [[nodiscard]] double pathInsideBounds(const PhotonState& photon) const {
        const scene::Bounds& bounds = scene_.bounds();
        double end = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            const double step = photon.direction[axis];
            if (step == 0.0) continue;
            const double side = step > 0.0 ? bounds.maximum[axis] : bounds.minimum[axis];
            end = std::min(end, (side - photon.origin[axis]) / step);
        }
        return end;
    }

    const EmbreeScene& scene_;
    const Eye& eye_;
    BatchResult& result_;
    glm::dvec3 scattering_{0.0};
    glm::dvec3 mediumExtinction_{0.0};
    double anisotropy_ = 0.0;
    std::size_t inScattered_ = 0;  // first value of the layer; 0: none
    std::size_t radiance_ = 0;     // the same
    std::optional<PathClassifier> classifier_;
    std::size_t firstClass_ = 0;  // first value of the first class
    std::size_t layerSize_ = 0;   // from one class to the next
};

// The values of classes are sums of their own, as that of all is; rounded to units of the sums they
// would differ from it by a few. Those units go to the classes that were rounded the most, so that
// the classes are all of the light to the last bit.
void roundClasses(BatchResult& result, double quantum, std::size_t layerSize,
                  std::size_t firstClass, std::size_t classCount) {
    const double unitsPerValue = 1.0 / quantum;
    constexpr double kMaxUnits = 0x1.0p52;  // pixel_sums.cpp leaves out what is more
    std::vector<double> units(classCount);
    std::vector<double> rest(classCount);
    for (std::size_t i = 0; i < layerSize; ++i) {
        if (result.values[i] == 0.0) continue;
        const double whole = std::nearbyint(result.values[i] * unitsPerValue);
        const bool isCounted = std::abs(whole) <= kMaxUnits;
        double missing = whole;
        for (std::size_t k = 0; k < classCount; ++k) {
            const double exact = result.values[firstClass + k * layerSize + i] * unitsPerValue;
            units[k] = isCounted ? std::nearbyint(exact) : 0.0;
            rest[k] = exact - units[k];
            missing -= units[k];
        }
        if (isCounted && missing != 0.0) {
            const double sign = missing > 0.0 ? 1.0 : -1.0;
            for (std::size_t k = 0; k < classCount && missing != 0.0; ++k, missing -= sign) {
                const auto most =
                    std::max_element(rest.begin(), rest.end(),
                                     [&](double a, double b) { return sign * a < sign * b; });
                units[static_cast<std::size_t>(most - rest.begin())] += sign;
                *most -= sign;
            }
            // The sums of doubles that are far apart may differ by more.
            *std::max_element(units.begin(), units.end()) += missing;
        }
        for (std::size_t k = 0; k < classCount; ++k)
            result.values[firstClass + k * layerSize + i] = units[k] * quantum;
    }
}

void traceBatch(const EmbreeScene& scene, const Eye& eye, const LightSampler& sampler,
                const LightTraceSettings& settings, std::uint64_t batch, BatchResult& result,
                const TracedMore& tracedMore) {
    const LightTransport transport(scene, settings.filter);
    Camera camera(scene, eye, settings.classes, result);
    for (std::uint64_t i = 0; i < sampler.photonsPerBatch(); ++i) {
        if (i % kPhotonsPerPulse == 0 && !tracedMore(i == 0 ? 0 : kPhotonsPerPulse)) return;
        Random random(settings.seed, batch, i);
        const EmittedPhoton emitted = sampler.sample(i, random);
        ++result.rays;
        transport.follow(stateOf(emitted), emitted.reach, random, camera);
    }
    result.photons = sampler.photonsPerBatch();
}

// Irradiance that the lights make at the scene's middle: a scale for the sums, no more.
double irradianceScale(const EmbreeScene& scene) {
    double scale = 0.0;
    const scene::Bounds& bounds = scene.bounds();
    const double size = bounds.empty ? 1.0 : glm::length(bounds.maximum - bounds.minimum);
    for (const scene::Light& light : scene.scene().lights) {
        if (light.emitter >= 0 || light.band > 0) continue;
        const auto power =
            static_cast<double>(std::max({light.power.r, light.power.g, light.power.b}));
        scale += light.kind == scene::LightKind::directional ? power : power / (size * size);
    }
    for (const scene::Emitter& emitter : scene.scene().emitters) {
        if (!emitter.object) {
            const glm::dvec3 whole = emitter.environment ? emitter.environment->fluxPerSquareMeter()
                                                         : glm::dvec3(emitter.light.power);
            scale += std::max({whole.r, whole.g, whole.b});
            continue;
        }
        const scene::Object& object = scene.scene().objects[*emitter.object];
        const glm::vec3& radiance = scene.scene().materials[object.material].emission;
        scale += static_cast<double>(std::max({radiance.r, radiance.g, radiance.b})) *
                 scene::EmittingSurface(scene.scene(), object).areaSquareMeters() / (size * size);
    }
    return scale;
}

}  // namespace

PixelSums makeEstimatorSums(const EmbreeScene& scene, const LightTraceSettings& settings,
                            int layers) {
    if (settings.width < 1 || settings.height < 1 || settings.width > 16384 ||
        settings.height > 16384) {
        throw ConfigError(fmt::format("A picture of {}x{} is not within 1x1 to 16384x16384.",
                                      settings.width, settings.height));
    }
    if (settings.photonsPerBatch < 1) throw ConfigError("A batch needs at least one photon.");
    if (settings.filter.maximumInteractions < 1)
        throw ConfigError("At least one specular interaction must be allowed.");
    if (settings.filter.splitInteractions < 0 ||
        settings.filter.splitInteractions > kMaximumSplits) {
        throw ConfigError(
            fmt::format("Photons may split at 0 to {} interactions.", kMaximumSplits));
    }
    const LightSampler sampler(scene, settings.photonsPerBatch);
    return {settings.width, settings.height, layers, irradianceScale(scene), sampler.fluxWatts()};
}

ArrivedPath arrivedPathOf(const PhotonState& photon) {
    return {{photon.reflections, std::min(photon.interactions, kLongestPathWord)},
            photon.interactions,
            photon.firstObject,
            photon.partlyReflected};
}

int inScatteredLayer(const scene::Scene& scene) {
    return scatters(scene) ? kIrradianceLayer + 1 : -1;
}

int causticRadianceLayer(const scene::Scene& scene) {
    if (!sceneNeeds(scene).glossyReceivers) return -1;
    return std::max(inScatteredLayer(scene), kIrradianceLayer) + 1;
}

int firstClassLayer(const scene::Scene& scene) {
    return std::max({kIrradianceLayer, inScatteredLayer(scene), causticRadianceLayer(scene)}) + 1;
}

PixelSums makeLightTraceSums(const EmbreeScene& scene, const LightTraceSettings& settings) {
    const int classes =
        settings.classes.empty() ? 0 : static_cast<int>(settings.classes.size()) + 1;
    return makeEstimatorSums(scene, settings, firstClassLayer(scene.scene()) + classes);
}

void lightTrace(const EmbreeScene& scene, const LightTraceSettings& settings,
                const RunOptions& options, PixelSums& sums) {
    const LightSampler sampler(scene, settings.photonsPerBatch);
    const Eye eye(scene, settings.width, settings.height);
    runBatches(sums, options,
               [&](std::uint64_t batch, BatchResult& result, const TracedMore& tracedMore) {
                   traceBatch(scene, eye, sampler, settings, batch, result, tracedMore);
                   if (settings.classes.empty()) return;
                   const std::size_t layerSize =
                       result.values.size() / static_cast<std::size_t>(sums.layers());
                   const int firstClass = firstClassLayer(scene.scene());
                   roundClasses(result, sums.quantum(), layerSize,
                                layerSize * static_cast<std::size_t>(firstClass),
                                settings.classes.size() + 1);
               });
}

void lightTraceBatch(const EmbreeScene& scene, const LightTraceSettings& settings,
                     std::uint64_t batch, BatchResult& result) {
    const LightSampler sampler(scene, settings.photonsPerBatch);
    const Eye eye(scene, settings.width, settings.height);
    traceBatch(scene, eye, sampler, settings, batch, result, [](std::uint64_t) { return true; });
}

}  // namespace kaustik::reference
