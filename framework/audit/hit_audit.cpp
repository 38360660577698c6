// SPDX-License-Identifier: MIT
#include "framework/audit/hit_audit.h"

#include "framework/pipeline/stage_params.h"
#include "framework/pipeline/tracing_log.h"
#include "framework/scene/dielectrics.h"
#include "framework/scene/flat_faces.h"
#include "framework/scene/light_paths.h"
#include "framework/transport/watts.h"

#include <algorithm>
#include <cmath>

namespace kaustik::audit {
namespace {

using namespace transport;

reference::AuditPhoton toAudit(const Renderer& renderer, const TracedPhoton& traced) {
    reference::AuditPhoton photon;
    photon.position = traced.position;
    photon.direction = traced.direction;
    photon.media = traced.media;
    // Seen at a slant a pixel resolves less; the tracer takes its extent in depth too.
    photon.reachMeters = 2.0 * renderer.view().footprintPerMeter() * std::abs(photon.position.z);
    return photon;
}

// What a light sees of an exact hit: what tracers in its depths can find.
enum class LightVisibility { shown, hidden, outside, specular };

// The account of a photon that got no hit. The screen excuses only those that look there.
unsigned accountOf(Sight sight, TracerReach reach, std::optional<LightVisibility> light) {
    if (light == LightVisibility::hidden) return kAccountHiddenInMap;
    if (light == LightVisibility::outside) return kAccountOutsideMap;
    if (light == LightVisibility::specular) return kAccountBounceLimit;
    if (reach != TracerReach::eyeLayers && sight != Sight::none) return kAccountMissedByTracer;
    switch (sight) {
        case Sight::none:
            return kAccountLeftScene;
        case Sight::shown:
            return kAccountMissedByTracer;
        case Sight::offScreen:
            return kAccountOffScreen;
        case Sight::behindEye:
            return kAccountBehindEye;
        case Sight::beyondLayers:
            return kAccountBeyondLastLayer;
        case Sight::edgeOn:
            return kAccountEdgeOn;
    }
    return kAccountUnresolved;
}

constexpr const char* kLightCauses[] = {"hidden_in_map", "outside_map", "specular"};

const char* nameOf(Sight sight, TracerReach reach = TracerReach::eyeLayers,
                   std::optional<LightVisibility> light = std::nullopt) {
    if (light == LightVisibility::hidden) return kLightCauses[0];
    if (light == LightVisibility::outside) return kLightCauses[1];
    if (light == LightVisibility::specular) return kLightCauses[2];
    if (reach != TracerReach::eyeLayers && sight != Sight::none) return nameOf(Sight::shown);
    switch (sight) {
        case Sight::none:
            return "no_surface";
        case Sight::shown:
            return "tracer";
        case Sight::offScreen:
            return "off_screen";
        case Sight::behindEye:
            return "behind_eye";
        case Sight::beyondLayers:
            return "beyond_layers";
        case Sight::edgeOn:
            return "edge_on";
    }
    return "";
}

const char* falseHitName(const PhotonFate& fate, TracerReach reach,
                         std::optional<LightVisibility> light) {
    if (fate.verdict == Verdict::notANumber) return "not_a_number";
    if (fate.verdict == Verdict::displaced) return "displaced";
    if (fate.verdict == Verdict::tooNear) return "too_near";
    return nameOf(fate.sight, reach, light);  // no surface at all, or why the exact hit was passed
}

// By the photon's light, and its map where there is one.
class LightReach {
  public:
    LightReach(const Renderer& renderer, const reference::EmbreeScene& scene)
        : renderer_(renderer), scene_(scene), toWorld_(glm::inverse(renderer.view().worldToView)) {}

    // `exact` exists.
    [[nodiscard]] LightVisibility visibility(std::uint32_t light,
                                             const reference::FirstHit& exact) const {
        // Another specular surface, of which its view of receivers holds none.
        if (!isReceiver(renderer_.scene().materials[exact.material - 1].kind))
            return LightVisibility::specular;
        const glm::dvec3 world(toWorld_ * glm::dvec4(exact.position, 1.0));
        if (!isInMap(light, world)) return LightVisibility::outside;
        const scene::Light& source = renderer_.scene().lights[light];
        const glm::dvec3 local = world - scene_.center();
        const bool isSun = source.kind == scene::LightKind::directional;
        const glm::dvec3 size = scene_.bounds().maximum - scene_.bounds().minimum;
        const glm::dvec3 to = isSun ? local - 2.0 * glm::length(size) * source.direction
                                    : source.position - scene_.center();
        // Rounding apart, what turns away from the light is hidden by its own object, if it has an
        // inside; the ray then starts within it.
        const glm::dvec3 normal = glm::dmat3(toWorld_) * exact.geometricNormal;
        const double lift = 1e-6 * glm::length(size);
        const double side = glm::dot(normal, to - local) < 0.0 ? -1.0 : 1.0;
        const bool isSeen = scene_.isVisible(local + side * lift * normal, exact.triangle, to, 0.0);
        return isSeen ? LightVisibility::shown : LightVisibility::hidden;
    }

  private:
    // Whether the light's map, if it has one, covers a point.
    [[nodiscard]] bool isInMap(std::uint32_t light, const glm::dvec3& world) const {
        for (const FluxMap& map : renderer_.outputs().map.maps) {
            if (map.light != static_cast<int>(light) || map.cascade > 0) continue;
            if (map.on.views->count() > 1) continue;
            const render::RasterView& view = map.on.views->view(0);
            const glm::dvec3 there(view.worldToView * glm::dvec4(world, 1.0));
            const double scale = view.isOrthographic ? 1.0 : -there.z;
            if (!(scale > 0.0)) return false;
            const glm::dvec2 ndc = glm::dvec2(there) / (scale * view.halfExtent);
            if (std::abs(ndc.x) > 1.0 || std::abs(ndc.y) > 1.0) return false;
        }
        return true;
    }

    const Renderer& renderer_;
    const reference::EmbreeScene& scene_;
    glm::dmat4 toWorld_;
};

// What tracers of flat receivers can find.
class FlatReach {
  public:
    explicit FlatReach(const scene::Scene& scene)
        : flat_(scene::flatReceivers(scene)), dielectrics_(numberDielectrics(scene)) {
        for (std::size_t material = 0; material < scene.materials.size(); ++material)
            isOpen_.push_back(isOpen(scene, material));
    }
    [[nodiscard]] bool holds(const TracedPhoton& traced, const reference::FirstHit& exact) const {
        if (!exact.exists() || !flat_.isFlat[exact.triangle.object]) return false;
        const std::vector<std::uint32_t> around = unpackMedia(dielectrics_, traced.media);
        return std::all_of(around.begin(), around.end(),
                           [&](std::uint32_t medium) { return isOpen_[medium - 1]; });
    }

  private:
    scene::FlatReceivers flat_;
    scene::Dielectrics dielectrics_;
    std::vector<bool> isOpen_;
};

class Counter {
  public:
    Counter(HitAudit& audit, const Renderer& renderer, const reference::EmbreeScene& exact)
        : audit_(audit),
          view_(renderer.view()),
          scene_(renderer.scene()),
          seesBlockers_(renderer.settings().params.get<TraceParams>("trace").blockers > 0),
          lights_(renderer, exact) {
        for (const Sight sight : {Sight::offScreen, Sight::behindEye, Sight::beyondLayers,
                                  Sight::edgeOn, Sight::shown}) {
            audit_.missed[nameOf(sight)] = 0;
            audit_.falseHits[nameOf(sight)] = 0;
        }
        for (const char* cause : kLightCauses) {
            audit_.missed[cause] = 0;
            audit_.falseHits[cause] = 0;
        }
        for (const char* cause : {"no_surface", "displaced", "too_near", "not_a_number"})
            audit_.falseHits[cause] = 0;
    }

    void add(const TracedPhoton& traced, const reference::FirstHit& exact, const PhotonFate& fate,
             TracerReach reach) {
        const bool isRight = fate.verdict == Verdict::right;
        ++audit_.photons;
        if (exact.exists()) ++audit_.exactHits;
        if (fate.isVisible()) ++audit_.visible;
        if (isRight) ++audit_.right;
        if (isRight && fate.isVisible()) ++audit_.rightVisible;
        std::optional<LightVisibility> light;
        if (reach == TracerReach::lightFront && exact.exists())
            light = lights_.visibility(traced.light, exact);
        const bool reachable = isReachable(traced, exact, fate, reach, light);
        if (reachable) ++audit_.reachable;
        if (isRight && reachable) ++audit_.rightReachable;
        if (fate.distanceMeters) meters_.push_back(*fate.distanceMeters);
        if (fate.distancePixels) pixels_.push_back(*fate.distancePixels);
        if (fate.distanceMeters && !fate.distancePixels) ++audit_.unplaced;
        if (!traced.isFound) {
            const unsigned account = accountOf(fate.sight, reach, light);
            audit_.missedWatts[account] += transport::wattsOf(traced.fluxWatts);
            ++audit_.missedPhotons[account];
        }
        if (isRight) return;
        const bool isSpecular =
            exact.exists() && !isReceiver(scene_.materials[exact.material - 1].kind);
        if (isSpecular && traced.isFound &&
            glm::distance(glm::dvec3(traced.found), glm::dvec3(traced.position)) >
                exact.distanceMeters)
            ++audit_.throughSpecular;
        if (fate.verdict == Verdict::missed) {
            ++audit_.missed[nameOf(fate.sight, reach, light)];
        } else {
            ++audit_.falseHits[falseHitName(fate, reach, light)];
        }
        const bool isPlaced = traced.isFound && fate.verdict != Verdict::notANumber;
        if (!isPlaced && !exact.exists()) return;
        const auto pixel = pixelOf(view_, isPlaced ? glm::dvec3(traced.found) : exact.position);
        if (pixel) audit_.wrong.push_back({*pixel, fate.verdict});
    }

    void finish() {
        audit_.meters = quantilesOf(std::move(meters_));
        audit_.pixels = quantilesOf(std::move(pixels_));
    }

  private:
    bool isReachable(const TracedPhoton& traced, const reference::FirstHit& exact,
                     const PhotonFate& fate, TracerReach reach,
                     std::optional<LightVisibility> light) {
        switch (reach) {
            case TracerReach::lightFront:
                return light == LightVisibility::shown ||
                       (light == LightVisibility::specular && seesBlockers_);
            case TracerReach::eyeLayers:
                return fate.isVisible();
            case TracerReach::everything:
            case TracerReach::around:
                return exact.exists();
            case TracerReach::flatReceivers:
                if (!flat_) flat_.emplace(scene_);
                return flat_->holds(traced, exact);
        }
        return false;
    }

    HitAudit& audit_;
    const render::RasterView& view_;
    const scene::Scene& scene_;
    bool seesBlockers_;  // tracers of receivers alone stop light at what is specular
    LightReach lights_;
    std::optional<FlatReach> flat_;  // once it is asked for
    std::vector<double> meters_;
    std::vector<double> pixels_;
};

// As framework/transport/octahedral.h folds it.
glm::dvec3 unfoldUnitVector(const glm::dvec2& folded) {
    glm::dvec3 n(folded, 1.0 - std::abs(folded.x) - std::abs(folded.y));
    if (n.z < 0.0) {
        n = glm::dvec3((1.0 - std::abs(folded.y)) * (folded.x >= 0.0 ? 1.0 : -1.0),
                       (1.0 - std::abs(folded.x)) * (folded.y >= 0.0 ? 1.0 : -1.0), n.z);
    }
    return glm::normalize(n);
}

// Depths and, from the triangles' planes, their extents over the pixels; of the eye's layers alone.
Layers readLayers(const Renderer& renderer) {
    const LayeredDepth& layers = renderer.outputs().layers;
    if (!layers.depth.valid() || !layers.views->isEyeView()) return {};
    const gl::Texture& texture = renderer.texture(layers.depth);
    const std::vector<float> texels = texture.read();
    const int width = texture.desc().width;
    const int height = texture.desc().height;
    const render::RasterView& view = renderer.view();
    std::vector<float> depths;  // and extents
    depths.reserve(texels.size() / 2);
    for (std::size_t i = 0; i + 3 < texels.size(); i += 4) {
        const std::size_t pixel = i / 4 % static_cast<std::size_t>(width * height);
        const double x = static_cast<double>(pixel % static_cast<std::size_t>(width)) + 0.5;
        const double y = static_cast<double>(pixel / static_cast<std::size_t>(width)) + 0.5;
        const glm::dvec3 ray((2.0 * x / width - 1.0) * view.halfExtent.x,
                             (2.0 * y / height - 1.0) * view.halfExtent.y, -1.0);
        const double depth = static_cast<double>(texels[i]);
        const glm::dvec3 normal = unfoldUnitVector(glm::dvec2(texels[i + 1], texels[i + 2]));
        const double slope = (std::abs(normal.x) + std::abs(normal.y)) /
                             std::max(std::abs(glm::dot(normal, ray)), 1e-6);
        const double extent = 0.5 * depth * view.footprintPerMeter() * slope;
        depths.insert(depths.end(), {texels[i], static_cast<float>(extent)});
    }
    return {texture.desc().width, texture.desc().height, layers.layers, std::move(depths)};
}

std::optional<double> share(std::uint64_t part, std::uint64_t whole) {
    if (whole == 0) return std::nullopt;
    return static_cast<double>(part) / static_cast<double>(whole);
}

PhotonFate judge(const render::RasterView& view, const Layers& layers, const TracedPhoton& traced,
                 const reference::FirstHit& exact) {
    const bool isNumber = !traced.isFound || isFinite(traced.found);
    std::optional<glm::dvec3> found;
    if (traced.isFound && isNumber) found = traced.found;
    PhotonFate fate = judgeFate(view, layers, traced.position, found, exact);
    if (!isNumber) fate.verdict = Verdict::notANumber;
    return fate;
}

// Exact hits of more than these wait for room.
constexpr std::size_t kPhotonsAtOnce = std::size_t{1} << 20U;

}  // namespace

std::optional<Quantiles> quantilesOf(std::vector<double> samples) {
    if (samples.empty()) return std::nullopt;
    std::sort(samples.begin(), samples.end());
    const auto rank = [&](double share) {
        const double index = std::ceil(share * static_cast<double>(samples.size()));
        return samples[static_cast<std::size_t>(std::max(index, 1.0)) - 1];
    };
    return Quantiles{rank(0.5), rank(0.95), rank(0.99), samples.back()};
}

std::optional<double> HitAudit::agreement() const {
    return share(right, photons);
}

std::optional<double> HitAudit::agreementVisible() const {
    return share(rightVisible, visible);
}

std::optional<double> HitAudit::agreementReachable() const {
    return share(rightReachable, reachable);
}

HitAudit auditHits(const Renderer& renderer, const reference::EmbreeScene& scene, int threads) {
    HitAudit audit;
    const render::RasterView& view = renderer.view();
    const Layers layers = readLayers(renderer);
    const glm::dmat4 viewToWorld = glm::inverse(view.worldToView);
    Counter counter(audit, renderer, scene);
    for (const TraceRecord& trace : renderer.traces()) {
        const std::shared_ptr<const TracingLog> log = readTracing(renderer, trace);
        audit.notANumber += log->notANumber;
        addBooked(audit.booked, {}, log->booked);
        for (std::size_t first = 0; first < log->photons.size(); first += kPhotonsAtOnce) {
            const std::size_t end = std::min(first + kPhotonsAtOnce, log->photons.size());
            std::vector<reference::AuditPhoton> photons;
            photons.reserve(end - first);
            for (std::size_t i = first; i < end; ++i)
                photons.push_back(toAudit(renderer, log->photons[i]));
            const std::vector<reference::FirstHit> exact =
                reference::exactFirstHits(scene, photons, viewToWorld, threads);
            for (std::size_t i = first; i < end; ++i) {
                const TracedPhoton& traced = log->photons[i];
                const reference::FirstHit& hit = exact[i - first];
                counter.add(traced, hit, judge(view, layers, traced, hit), trace.reach);
            }
        }
    }
    counter.finish();
    return audit;
}

EnergyLedger resolveLedger(const Renderer& renderer, const HitAudit& audit, double emittedWatts) {
    EnergyLedger ledger = renderer.ledger();
    if (renderer.traces().empty()) return ledger;
    // What others have booked, a reconstruction that also loses light off the screen, stays.
    for (const unsigned account :
         {kAccountLeftScene, kAccountOffScreen, kAccountBehindEye, kAccountBeyondLastLayer,
          kAccountEdgeOn, kAccountMissedByTracer, kAccountUnresolved, kAccountOutsideMap,
          kAccountHiddenInMap, kAccountBounceLimit}) {
        ledger.watts[account] += audit.missedWatts[account] - audit.booked.watts[account];
        ledger.events[account] += audit.missedPhotons[account] - audit.booked.events[account];
        // Both are sums of the same photons, one in fixed point: what is left is its rounding.
        if (audit.missedPhotons[account] == 0 && ledger.events[account] == 0)
            ledger.watts[account] = 0.0;
    }
    ledger.judgeEmission(emittedWatts);
    return ledger;
}

}  // namespace kaustik::audit
