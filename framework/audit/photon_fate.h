// SPDX-License-Identifier: MIT
// Whether a tracer has found the first hit of a photon (framework/README.md, "The report": `hits`).
// Pure geometry in eye view space, m; pixels are continuous, from the lower left corner.
//
// A fate is right when tracer and reference both have a hit, these lie within one pixel on the
// screen and within one footprint (footprint / cos, m), or when both have none.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "framework/reference/photon_audit.h"
#include "framework/render/view.h"

namespace kaustik::audit {

// What the screen shows of a photon's exact first hit.
enum class Sight {
    none,          // there is no such hit
    shown,         // a layer holds it
    offScreen,     //
    behindEye,     // or nearer than the near plane
    beyondLayers,  // its pixel's layers are full before it
    edgeOn,        // its pixel has layers to spare, but no fragment there: edge-on or below a pixel
};

enum class Verdict {
    right,      // the hit, or that there is none
    missed,     // no hit, but there is one
    noSurface,  // a hit, but there is none
    displaced,  // a hit next to the exact one: within four pixels and four footprints of it
    tooNear,    // a hit before the exact one
    tooFar,     // a hit past the exact one
    notANumber  // a hit, but not where
};

struct PhotonFate {
    Sight sight = Sight::none;
    Verdict verdict = Verdict::right;
    // The distance between both hits. It does not exist where one of them is missing, and in pixels
    // also where one of them has no place on the screen because it is not before the eye.
    std::optional<double> distanceMeters;
    std::optional<double> distancePixels;
    // Agreement is judged among what the screen could show: edge-on surfaces are among it.
    [[nodiscard]] bool isVisible() const { return sight == Sight::shown || sight == Sight::edgeOn; }
};

// The layered depth, read back: (view depth, half of its extent over the pixel), m, by layer, row
// from the bottom and column; depth 0 after the last fragment of a pixel.
class Layers {
  public:
    Layers() = default;
    Layers(int width, int height, int layers, std::vector<float> texels);

    // What the layers show of a surface at a depth in the pixel that holds `pixel`.
    [[nodiscard]] Sight sightOf(const glm::dvec2& pixel, double depth, double footprint) const;

  private:
    [[nodiscard]] glm::dvec2 at(int x, int y, int layer) const;
    [[nodiscard]] bool holds(int x, int y, double depth, double footprint) const;

    int width_ = 0;
    int height_ = 0;
    int layers_ = 0;
    std::vector<float> texels_;
};

// `found`: where the tracer says that the photon arrived. `exact` in eye view space.
[[nodiscard]] PhotonFate judgeFate(const render::RasterView& view, const Layers& layers,
                                   const glm::dvec3& origin, const std::optional<glm::dvec3>& found,
                                   const reference::FirstHit& exact);

}  // namespace kaustik::audit
