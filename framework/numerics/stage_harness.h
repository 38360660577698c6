// SPDX-License-Identifier: MIT
// A test harness for single stages: photons and hits that a case makes up go into one node, and
// what comes out is read back. World space, m, W; in the frame itself all is as in a technique's.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "framework/numerics/lab.h"
#include "framework/pipeline/ledger.h"

namespace kaustik::numerics {

// A photon on its way, and the specular surface that it leaves, if any.
struct StagePhoton {
    glm::dvec3 position{0.0};
    glm::dvec3 direction{0.0, 0.0, -1.0};  // unit
    glm::dvec3 fluxWatts{1.0};
    double footprintMeters = 0.01;
    std::vector<std::uint32_t> media = {};  // material index + 1, the innermost first
    std::uint32_t leftSide = transport::kLeftNone;
    glm::dvec3 startNormal{0.0};      // outward
    std::uint32_t startMaterial = 0;  // index + 1; 0: it starts in the open
    std::uint32_t startFate = transport::kFateNone;
    double pathMeters = 0.0;  // scatterPhotons: to the receiver where its path ends; 0: it has none
};

// The place where a photon arrived, or what it became.
struct StageHit {
    glm::dvec3 position{0.0};
    double distanceMeters = 0.0;
    glm::dvec3 normal{0.0};
    std::uint32_t material = 0;  // index + 1
    glm::dvec3 fluxWatts{0.0};
    std::uint32_t fate = transport::kFateNone;
    [[nodiscard]] bool isHit() const {
        return fate == transport::kFateReceiver || fate == transport::kFateSpecular;
    }
};

struct StageSize {
    int width = 128;
    int height = 128;
};

struct Traced {
    std::vector<StageHit> hits;  // by photon
    EnergyLedger ledger;
    [[nodiscard]] std::size_t hitCount() const;
};

// Traces photons to their first hits.
[[nodiscard]] Traced tracePhotons(Lab& lab, const Lab::Choice& tracer, const scene::Scene& scene,
                                  const std::vector<StagePhoton>& photons,
                                  const Settings& settings = {}, StageSize size = {});

// Photons that have just hit a specular surface, at `startNormal` and `startMaterial`, interact
// there. A result of fate kFateInFlight goes on; `normal` of it is its direction.
[[nodiscard]] Traced interactPhotons(Lab& lab, const Lab::Choice& specular,
                                     const scene::Scene& scene,
                                     const std::vector<StagePhoton>& photons,
                                     std::vector<std::vector<std::uint32_t>>* media = nullptr);

// Photons as they leave the lights of the scene: where they first hit a specular surface.
struct Emitted {
    std::vector<StageHit> hits;
    std::vector<glm::dvec3> directions;
    std::vector<std::vector<std::uint32_t>> media;  // as StagePhoton's
};
[[nodiscard]] Emitted emitPhotons(Lab& lab, const Lab::Choice& emitter, const scene::Scene& scene,
                                  const Settings& settings);
// Photons where they first hit a specular surface, and what they become there.
struct Bent {
    Emitted before;
    Emitted after;
    EnergyLedger ledger;
};
[[nodiscard]] Bent emitAndInteract(Lab& lab, const Lab::Choice& emitter, const scene::Scene& scene,
                                   const Settings& settings);

// Photons that have landed on a receiver, whose normal is `startNormal`, become irradiance; the
// frame has "caustic.irradiance" and "eye.receiver". They are of the scene's first light.
[[nodiscard]] Frame reconstructHits(Lab& lab, const Lab::Choice& reconstruct,
                                    const scene::Scene& scene,
                                    const std::vector<StagePhoton>& photons,
                                    const Settings& settings = {}, StageSize size = {});

// What the first map of such a frame holds, of green light, before any filter: W by texel, lower
// left first.
struct StoredFlux {
    int width = 0;
    int height = 0;
    std::vector<double> watts;
    // The sum over texels of [x0, x1) x [y0, y1).
    [[nodiscard]] double in(int x0, int y0, int x1, int y1) const;
    [[nodiscard]] double all() const { return in(0, 0, width, height); }
};
[[nodiscard]] StoredFlux readStored(const Frame& frame, int set = 0);

// What photons that were on their way scatter towards the eye: outputs().inScattered, invalid where
// the node leaves it out.
[[nodiscard]] Frame scatterPhotons(Lab& lab, const Lab::Choice& media, const scene::Scene& scene,
                                   const std::vector<StagePhoton>& photons,
                                   const Settings& settings = {}, StageSize size = {});

}  // namespace kaustik::numerics
