// SPDX-License-Identifier: MIT
// Estimator 1 (framework/README.md, "The reference"): light tracing. Every photon that reaches a
// receiver after at least one specular surface is joined to the camera's pinhole by a straight ray
// to which dielectrics are invisible. Unbiased for the caustic irradiance of a pixel, the mean over
// the pixel's area; and, where the scene has a medium, for the caustic light that it scatters once
// towards the eye (Henyey-Greenstein), with the transmittance to the eye. Where it has a glossy
// receiver, also for caustic radiance: the same light through the receiver's BRDF towards the eye
// (transport/brdf.h), as it leaves the surface. Out: W/m² and W/m²/sr.
//
// The medium fills the scene's bounding box for photons; the straight ray to the eye loses light to
// it all the way. Directional light is as strong as the scene file says where it hits the first
// specular surface.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/reference/batches.h"
#include "framework/reference/embree_scene.h"
#include "framework/reference/light_transport.h"
#include "framework/reference/path_classes.h"
#include "framework/reference/pixel_sums.h"

namespace kaustik::reference {

struct LightTraceSettings {
    int width = 800;
    int height = 600;
    std::uint64_t photonsPerBatch = 1u << 18;
    std::uint64_t seed = 1;
    PathFilter filter;
    std::vector<PathClass> classes;  // of irradiance, that are kept apart
};

// Layers of the sums.
inline constexpr int kIrradianceLayer = 0;
// -1 where the scene has no medium that scatters.
[[nodiscard]] int inScatteredLayer(const scene::Scene& scene);
// -1 where no receiver is glossy.
[[nodiscard]] int causticRadianceLayer(const scene::Scene& scene);
// The first of as many as there are classes, and one for all other paths; where classes are kept
// apart. In units of the sums they add up to kIrradianceLayer exactly, batch by batch.
[[nodiscard]] int firstClassLayer(const scene::Scene& scene);

// By what classes tell the path of a photon that has arrived.
[[nodiscard]] ArrivedPath arrivedPathOf(const PhotonState& photon);

// Empty sums that fit the scene and the settings; what an earlier run saved fits in their place.
// Throws ConfigError for settings out of range.
[[nodiscard]] PixelSums makeLightTraceSums(const EmbreeScene& scene,
                                           const LightTraceSettings& settings);

// Makes empty sums for an estimator with another number of layers.
[[nodiscard]] PixelSums makeEstimatorSums(const EmbreeScene& scene,
                                          const LightTraceSettings& settings, int layers);

// Adds batches to `sums` until `options` say stop.
void lightTrace(const EmbreeScene& scene, const LightTraceSettings& settings,
                const RunOptions& options, PixelSums& sums);

// The photons of one batch, for those who want to time it.
void lightTraceBatch(const EmbreeScene& scene, const LightTraceSettings& settings,
                     std::uint64_t batch, BatchResult& result);

}  // namespace kaustik::reference
