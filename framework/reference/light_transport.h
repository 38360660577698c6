// SPDX-License-Identifier: MIT
// One photon from a light through every specular surface to where it ends (L S+ D). All estimators
// and checks of the reference follow photons here and differ only in what they do with the events.
//
// At a dielectric the photon splits into its reflected and its refracted part, each with its share
// of the flux by Fresnel; after `PathFilter::splitInteractions` of them, one part is chosen with
// the probability of its share and takes all of the flux. Both leave the mean as it is, and in both
// every watt stays accounted for. Local coordinates, m, W.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

#include "framework/reference/embree_scene.h"
#include "framework/reference/optics.h"
#include "framework/reference/random.h"
#include "framework/scene/spectrum.h"
#include "framework/transport/types.h"

namespace kaustik::reference {

// The paths that count: all, or only those that a technique claims to model.
struct PathFilter {
    // Follows only the refracted branch at dielectrics; light is still reflected at mirrors and
    // where reflection is total.
    bool transmissionOnly = false;
    // Follows only what dielectrics reflect; not together with the other.
    bool reflectionOnly = false;
    int maximumInteractions = 64;  // >= 1; what hits one more is lost to the bounce limit
    int splitInteractions = 1;     // 0 to kMaximumSplits; changes the noise, not the mean
};
inline constexpr int kMaximumSplits = 8;

// How light comes from where it starts to the first surface.
struct LightReach {
    double rangeMeters = std::numeric_limits<double>::infinity();  // beyond it there is none
    // Comes from so far away that it is what the scene file says where it hits that surface, even
    // where it is inside of a dielectric there.
    bool isDistant = false;
};

// What a photon is of where the scene disperses; else it is of all wavelengths, and what colours do
// to it they do by channels.
struct Wavelength {
    double place = 0.0;    // scene/spectrum.h
    glm::dvec3 tint{0.0};  // times a colour: the share that it lets through; 0: of all
    [[nodiscard]] glm::dvec3 tinted(const glm::dvec3& color) const {
        return tint == glm::dvec3(0.0) ? color : glm::dvec3(glm::dot(color, tint));
    }
};

struct PhotonState {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0};  // unit
    glm::dvec3 fluxWatts{0.0};
    Wavelength wavelength;
    TriangleId start;
    MediaStack media;
    int interactions = 0;
    bool reflectedInside = false;  // by the last interaction, inside a dielectric
    // The path behind it, for those who tell paths apart (path_classes.h): bit i is set where
    // interaction i was a reflection, of the first 64; and the first specular object.
    std::uint64_t reflections = 0;
    std::uint32_t firstObject = 0;
    bool partlyReflected = false;  // at an interface that refracts light as well, at least once

    // Notes that the last interaction was a reflection.
    void noteReflection() {
        if (interactions <= 64) reflections |= std::uint64_t{1} << (interactions - 1);
    }
};

// What the events are told. A sink has all of these; flux in W.
struct NullSink {
    void emitted(const glm::dvec3&) {}
    void absorbed(const glm::dvec3&) {}
    void lost(unsigned /*account*/, const glm::dvec3&) {}
    // Is told, after at least one interaction, of the photon's path through the scene's medium to
    // `distance` (infinite when it hits nothing), with the flux that it starts with and the
    // extinction, 1/m.
    void passed(const PhotonState&, double /*distance*/, const glm::dvec3& /*extinction*/,
                Random&) {}
    void leftScene(const PhotonState&) {}
    void arrived(const SurfaceHit&, const PhotonState&) {}
    // Is told of every interaction before it happens.
    void hitSurface(const SurfaceHit&, const PhotonState&) {}
};

// The directions in which a photon may go on from a specular surface.
struct Branches {
    double reflectance = 1.0;
    glm::dvec3 reflected{0.0};
    glm::dvec3 refracted{0.0};
};

// The shading normal bends the light as the smooth surface would. Where it would send light to the
// wrong side of the triangle, the triangle's own normal does: nothing leaks through a surface.
// `from` and `to`: indices of refraction, of no use at a mirror.
[[nodiscard]] inline Branches branchesAt(const SurfaceHit& hit, const glm::dvec3& direction,
                                         double from, double to, bool isMirror) {
    const double side = glm::dot(direction, hit.geometricNormal) < 0.0 ? 1.0 : -1.0;
    const glm::dvec3 geometric = side * hit.geometricNormal;
    glm::dvec3 normal = side * hit.shadingNormal;
    for (int attempt = 0; attempt < 2; ++attempt, normal = geometric) {
        if (attempt == 0 && !(glm::dot(direction, normal) < 0.0)) continue;
        if (isMirror) {
            const glm::dvec3 reflected = direction - 2.0 * glm::dot(direction, normal) * normal;
            if (attempt == 1 || glm::dot(reflected, geometric) > 0.0)
                return {1.0, reflected, glm::dvec3(0.0)};
            continue;
        }
        const Interface interaction = interactAt(direction, normal, from, to);
        const bool isRight =
            glm::dot(interaction.reflected, geometric) > 0.0 &&
            (interaction.reflectance >= 1.0 || glm::dot(interaction.refracted, geometric) < 0.0);
        if (attempt == 1 || isRight)
            return {interaction.reflectance, interaction.reflected, interaction.refracted};
    }
    return {};
}

class LightTransport {
  public:
    LightTransport(const EmbreeScene& scene, const PathFilter& filter)
        : scene_(scene),
          filter_(filter),
          rounding_(4.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) *
                    glm::length(scene.bounds().maximum - scene.bounds().minimum)) {
        const auto& medium = scene.scene().medium;
        if (medium) {
            mediumExtinction_ =
                glm::dvec3(medium->scatteringPerMeter) + glm::dvec3(medium->absorptionPerMeter);
        }
        hasMedium_ = mediumExtinction_ != glm::dvec3(0.0);
        for (const scene::Material& material : scene.scene().materials) {
            hasAbsorption_ = hasAbsorption_ || material.absorptionPerMeter != glm::vec3(0.0f);
        }
    }

    // Follows a photon that leaves a light. A photon whose first surface is not specular, or lies
    // beyond the light's range, does not count: no event tells of it.
    template <class Sink>
    void follow(PhotonState photon, const LightReach& reach, Random& random, Sink& sink) const {
        Ray ray{photon.origin, photon.direction, {}, {}, SideRule::any};
        SurfaceHit hit;
        if (!scene_.intersectFromLight(ray, hit) || hit.distance > reach.rangeMeters) return;
        const scene::Material& material = scene_.scene().materials[hit.material];
        if (isReceiver(material.kind)) return;
        // A light whose rays first hit a dielectric from within is inside of it.
        if (material.kind == scene::MaterialKind::dielectric &&
            glm::dot(photon.direction, hit.geometricNormal) > 0.0) {
            photon.media.enter(hit.material + 1);
            if (!reach.isDistant) {
                photon.fluxWatts *=
                    decay(photon.wavelength.tinted(glm::dvec3(material.absorptionPerMeter)),
                          hit.distance);
            }
        }
        photon.origin = hit.position;
        photon.firstObject = hit.triangle.object;
        sink.emitted(photon.fluxWatts);
        finish(photon, &hit, random, sink);
    }

    // Follows a photon that is on its way between surfaces. `hit`: the specular surface that it
    // has just hit, or null.
    template <class Sink>
    void finish(PhotonState photon, const SurfaceHit* hit, Random& random, Sink& sink) const {
        SurfaceHit found;
        if (hit != nullptr && !interact(photon, *hit, random, sink)) return;
        while (advance(photon, found, random, sink) && interact(photon, found, random, sink)) {
        }
    }

  private:
    static glm::dvec3 decay(const glm::dvec3& perMeter, double distance) {
        if (perMeter.x == perMeter.y && perMeter.y == perMeter.z)
            return glm::dvec3(std::exp(-perMeter.x * distance));
        return glm::exp(-perMeter * distance);
    }

    // Follows the photon to the next specular surface; false when it has ended before.
    template <class Sink>
    bool advance(PhotonState& photon, SurfaceHit& hit, Random& random, Sink& sink) const {
        const std::uint32_t inner = photon.media.inner();
        Ray ray{photon.origin, photon.direction, photon.start, photon.media, SideRule::transport};
        ray.reachMeters = rounding_;
        const bool isHit = scene_.intersect(ray, hit);
        const double distance = isHit ? hit.distance : std::numeric_limits<double>::infinity();
        if (hasAbsorption_ || hasMedium_) {
            glm::dvec3 extinction = mediumExtinction_;
            if (inner != 0)
                extinction += glm::dvec3(scene_.scene().materials[inner - 1].absorptionPerMeter);
            extinction = photon.wavelength.tinted(extinction);
            if (hasMedium_) sink.passed(photon, distance, extinction, random);
            if (isHit && extinction != glm::dvec3(0.0)) {
                const glm::dvec3 arriving = photon.fluxWatts * decay(extinction, distance);
                sink.absorbed(photon.fluxWatts - arriving);
                photon.fluxWatts = arriving;
            }
        }
        if (!isHit) {
            sink.leftScene(photon);
            return false;
        }
        if (isReceiver(scene_.scene().materials[hit.material].kind)) {
            sink.arrived(hit, photon);
            return false;
        }
        if (photon.interactions >= filter_.maximumInteractions) {
            sink.lost(photon.reflectedInside ? transport::kAccountInternalReflectionLimit
                                             : transport::kAccountBounceLimit,
                      photon.fluxWatts);
            return false;
        }
        return true;
    }

    struct Indices {
        double before;
        double behind;
    };
    // The indices of refraction before and behind a surface of the material with that index; of no
    // use at a mirror. Both are the same where one dielectric ends inside of another.
    [[nodiscard]] Indices indicesAt(const PhotonState& photon, std::uint32_t material,
                                    bool enters) const {
        const MediaStack& media = photon.media;
        const std::vector<scene::Material>& materials = scene_.scene().materials;
        const auto indexOf = [&](std::uint32_t medium) {
            return medium == 0 ? 1.0
                               : scene::indexAt(materials[medium - 1], photon.wavelength.place);
        };
        const double before = indexOf(media.inner());
        if (enters) return {before, indexOf(material + 1)};
        return {before, media.inner() == material + 1 ? indexOf(media.outer()) : before};
    }

    // Lets the photon interact at a specular surface; false when nothing goes on.
    template <class Sink>
    bool interact(PhotonState& photon, const SurfaceHit& hit, Random& random, Sink& sink) const {
        sink.hitSurface(hit, photon);
        const scene::Material& material = scene_.scene().materials[hit.material];
        const bool isMirror = material.kind == scene::MaterialKind::mirror;
        const bool enters = glm::dot(photon.direction, hit.geometricNormal) < 0.0;
        const Indices indices = indicesAt(photon, hit.material, enters);
        const Branches branches =
            branchesAt(hit, photon.direction, indices.before, indices.behind, isMirror);
        photon.origin = hit.position;
        photon.start = hit.triangle;
        ++photon.interactions;
        if (isMirror) {
            photon.direction = branches.reflected;
            photon.reflectedInside = photon.media.inner() != 0;
            photon.noteReflection();
            const glm::dvec3 kept =
                photon.fluxWatts * photon.wavelength.tinted(glm::dvec3(material.albedo));
            sink.absorbed(photon.fluxWatts - kept);
            photon.fluxWatts = kept;
            return kept != glm::dvec3(0.0);
        }
        PhotonState reflected = photon;
        reflected.direction = branches.reflected;
        reflected.reflectedInside = !enters;
        reflected.noteReflection();
        reflected.partlyReflected = photon.partlyReflected || branches.reflectance < 1.0;
        if (branches.reflectance >= 1.0) {
            photon = reflected;
            return true;
        }
        if (enters && photon.media.isFull()) {
            sink.lost(transport::kAccountNestingLimit,
                      photon.fluxWatts * (1.0 - branches.reflectance));
            reflected.fluxWatts *= branches.reflectance;
            photon = reflected;
            return true;
        }
        if (filter_.reflectionOnly) {
            sink.lost(transport::kAccountUntracedBranch,
                      photon.fluxWatts * (1.0 - branches.reflectance));
            reflected.fluxWatts *= branches.reflectance;
            photon = reflected;
            return true;
        }
        photon.direction = branches.refracted;
        photon.reflectedInside = false;
        if (enters) {
            photon.media.enter(hit.material + 1);
        } else {
            photon.media.leave(hit.material + 1);
        }
        if (filter_.transmissionOnly) {
            sink.lost(transport::kAccountUntracedBranch, photon.fluxWatts * branches.reflectance);
            photon.fluxWatts *= 1.0 - branches.reflectance;
            return true;
        }
        if (branches.reflectance <= 0.0) return true;
        if (photon.interactions <= filter_.splitInteractions) {
            reflected.fluxWatts *= branches.reflectance;
            photon.fluxWatts -= reflected.fluxWatts;
            finish(reflected, nullptr, random, sink);
            return true;
        }
        if (random.uniform() < branches.reflectance) photon = reflected;
        return true;
    }

    const EmbreeScene& scene_;
    PathFilter filter_;
    double rounding_;  // of positions, m: seams to neighbouring triangles are no farther off
    glm::dvec3 mediumExtinction_{0.0};  // extinction of the scene's medium, 1/m
    bool hasMedium_ = false;
    bool hasAbsorption_ = false;
};

}  // namespace kaustik::reference
