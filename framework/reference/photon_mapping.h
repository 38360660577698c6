// SPDX-License-Identifier: MIT
// Estimator 2 (framework/README.md, "The reference"): progressive photon mapping with a fixed
// sequence of radii and independent passes (Hachisuka and Jensen 2009; Knaus and Zwicker 2011,
// equations 15 and 20).
// In each pass an eye ray through a random point of every pixel looks, straight through
// dielectrics, for its receiver, and the photons within a radius of it are its irradiance, W/m².
//
// The radius is a number of pixels, so that it follows the picture: `initialRadiusPixels` in the
// first pass, its square then shrinking as i^(alpha-1). Photons are found by where they project,
// which is why no search structure is needed.
//
// On request also the radiance of caustics along the eye's real paths, refracted and reflected
// (viewed_caustics.h), W/m²/sr; a medium weakens it. What a medium scatters towards the eye is for
// light tracing alone (light_tracing.h).
#pragma once

#include <cstdint>

#include "framework/reference/batches.h"
#include "framework/reference/embree_scene.h"
#include "framework/reference/light_transport.h"
#include "framework/reference/pixel_sums.h"

namespace kaustik::reference {

struct PhotonMappingSettings {
    int width = 800;
    int height = 600;
    std::uint64_t photonsPerBatch = 1u << 18;  // of one pass
    std::uint64_t seed = 1;
    PathFilter filter;
    double initialRadiusPixels = 1.0;  // (0, 16]
    double alpha = 0.7;                // (0, 1)
    bool followsView = false;          // also caustics seen through and in specular surfaces
};

// Layers of the sums. The density is measured within the radius and within 1/sqrt(2) of it: where
// irradiance is smooth its bias grows as the radius squared, and the extrapolation to radius 0 has
// none of it. Where the two differ much (folds, edges) so may the extrapolated value from the
// reference.
inline constexpr int kExtrapolatedLayer = 0;
inline constexpr int kNearRadiusLayer = 1;
// Caustic radiance towards the eye, extrapolated; only where a receiver is glossy.
inline constexpr int kMappedRadianceLayer = 2;

// Caustics along the eye's real paths; -1 unless asked for.
[[nodiscard]] int viewedCausticsLayer(const scene::Scene& scene,
                                      const PhotonMappingSettings& settings);

// Throws ConfigError for settings out of range.
[[nodiscard]] PixelSums makePhotonMappingSums(const EmbreeScene& scene,
                                              const PhotonMappingSettings& settings);

// Adds passes (the batches of `options`) to `sums` until `options` say stop.
void photonMapping(const EmbreeScene& scene, const PhotonMappingSettings& settings,
                   const RunOptions& options, PixelSums& sums);

// The radius of a pass (from 0) in pixels.
[[nodiscard]] double radiusPixels(const PhotonMappingSettings& settings, std::uint64_t pass);

}  // namespace kaustik::reference
