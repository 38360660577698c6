// SPDX-License-Identifier: MIT
// Photons from the lights towards everything specular, in independent batches. Directional lights
// are sampled evenly over the smallest rectangle around the specular surfaces, point and spot
// lights evenly over the solid angle of the narrowest cone around them (all directions when they
// lie around the light): the flux is exact. Of lights that have a size (scene/emitters.h) all is
// sampled, not the points that stand for them: the sun's disc evenly by the projected solid angle,
// over a rectangle that is wider by what its rays are aslant, and a surface evenly by area, from
// each point over the cone around the ball that holds the specular surfaces. An environment's
// directions are drawn by its flux, over the disc that such a ball shows. Within a batch the
// samples of a light are jittered in the cells of a grid, one each, so that a batch is far less
// noisy than as many independent photons.
#pragma once

#include <cstdint>
#include <deque>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "framework/reference/embree_scene.h"
#include "framework/reference/light_transport.h"
#include "framework/reference/random.h"
#include "framework/scene/emitters.h"
#include "framework/scene/emitting_environment.h"

namespace kaustik::reference {

struct EmittedPhoton {
    glm::dvec3 origin{0.0};     // local
    glm::dvec3 direction{0.0};  // unit
    glm::dvec3 fluxWatts{0.0};  // such that a whole batch is the light's flux
    Wavelength wavelength;      // drawn at random where the scene disperses
    LightReach reach;
};

[[nodiscard]] inline PhotonState stateOf(const EmittedPhoton& emitted) {
    PhotonState photon;
    photon.origin = emitted.origin;
    photon.direction = emitted.direction;
    photon.fluxWatts = emitted.fluxWatts;
    photon.wavelength = emitted.wavelength;
    return photon;
}

class LightSampler {
  public:
    // Divides about `photonsPerBatch` photons among the lights by their flux.
    LightSampler(const EmbreeScene& scene, std::uint64_t photonsPerBatch);
    LightSampler(const LightSampler&) = delete;  // shares point to its own lights
    LightSampler& operator=(const LightSampler&) = delete;

    // What `photonsPerBatch` has become; 0 without a light or a specular surface.
    [[nodiscard]] std::uint64_t photonsPerBatch() const { return photonCount_; }
    // Flux that the photons of one batch carry, W, all channels; not all of it hits a surface.
    [[nodiscard]] double fluxWatts() const { return fluxWatts_; }
    // The photon `index` of a batch.
    [[nodiscard]] EmittedPhoton sample(std::uint64_t index, Random& random) const;

  private:
    [[nodiscard]] EmittedPhoton sampleColor(std::uint64_t index, Random& random) const;
    struct Share {
        const scene::Light* light = nullptr;
        std::uint64_t first = 0;  // photon of the batch
        std::uint64_t columns = 0;
        std::uint64_t rows = 0;
        // Directional: corner and sides of the rectangle before everything. Else: an orthonormal
        // basis with the cone's axis as `along`, and the light's position as `corner`.
        glm::dvec3 corner{0.0};
        glm::dvec3 sideA{0.0};
        glm::dvec3 sideB{0.0};
        glm::dvec3 along{0.0};
        double cosine = -1.0;                                     // of the cone's half-angle
        double measure = 0.0;                                     // m² or sr; of a surface m² sr
        double discRadius = 0.0;                                  // directional, tangent
        std::shared_ptr<const scene::EmittingSurface> surface{};  // `light` has its radiance
        const scene::EmittingEnvironment* environment = nullptr;  // `light` has its flux
    };
    [[nodiscard]] static Share aimDirectional(const scene::Light& light, const EmbreeScene& scene);
    [[nodiscard]] static Share aimCone(const scene::Light& light, const EmbreeScene& scene);
    [[nodiscard]] Share aimSurface(const scene::Light& light, const scene::Object& object,
                                   const EmbreeScene& scene) const;
    void add(Share share);
    [[nodiscard]] EmittedPhoton sampleEnvironment(const Share& share, double u, double v,
                                                  Random& random) const;
    [[nodiscard]] EmittedPhoton sampleSurface(const Share& share, double u, double v,
                                              Random& random) const;

    const Appearance* appearance_;
    bool disperses_ = false;
    std::vector<Share> shares_;
    std::deque<scene::Light> surfaceLights_;  // whose radiance and name shares have
    glm::dvec3 targetMiddle_{0.0};            // of the ball around all that is specular, local
    double targetRadius_ = 0.0;
    glm::dvec3 middle_{0.0};  // of all of the scene, and the radius of a ball around it, local
    double radius_ = 0.0;
    double startMargin_ = 0.0;  // by which photons start in front of a surface, m
    std::uint64_t photonCount_ = 0;
    double fluxWatts_ = 0.0;
};

}  // namespace kaustik::reference
