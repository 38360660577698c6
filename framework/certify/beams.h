// SPDX-License-Identifier: MIT
// Light from a part of a specular triangle to pixels, enclosed. A cell is a triangle within the
// first specular triangle on the light's way. Where its light goes, how much of it, and which share
// of a pixel a square metre covers there are functions of the place in the cell that are enclosed
// to second order (jet.h). A pixel's irradiance is the integral over cells of
//
//     flux · coverage · [the place on the screen lies in the pixel],
//
// in which no derivative of the map is divided by: folds and foci need nothing of their own. What
// lies in the pixel is a polygon of the cell that is known up to a band, the second-order rest of
// the map in pixels, and so is what lies in front of or behind an edge of any facet.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "framework/certify/eye_view.h"
#include "framework/certify/geometry.h"
#include "framework/certify/sums.h"

namespace kaustik::certify {

struct BeamSettings {
    int interactions = 1;
    bool transmissionOnly = false;  // as reference::PathFilter has it
    double bandPixels = 0.01;       // cells whose places on the screen are less sure are split
    int maxDepth = 12;              // of splits into four
};

// What a test puts in the place of the truth, to see that it is found out.
struct PlantedError {
    double fresnelFactor = 1.0;      // of what dielectrics let through
    bool withoutReflection = false;  // what dielectrics reflect, but not all of it, ends there
    std::uint32_t droppedFacet = 0xffffffffu;
};

class BeamTracer {
  public:
    BeamTracer(const Geometry& geometry, const EyeView& eye, const BeamSettings& settings,
               const PlantedError& planted = {});

    // Pieces of work: a facet under a light. There are as many as sources times facets.
    [[nodiscard]] std::uint64_t pieces() const;
    // Adds the light that first meets the facet of that piece.
    void trace(std::uint64_t piece, BoundSums& sums) const;

    [[nodiscard]] BoundSums emptySums() const;
    // W, all channels' mean: about what the lights send to specular surfaces at most.
    [[nodiscard]] double wattScale() const { return wattScale_; }
    [[nodiscard]] double irradianceScale() const { return irradianceScale_; }

    [[nodiscard]] const Geometry& geometry() const { return geometry_; }
    [[nodiscard]] const EyeView& eye() const { return eye_; }
    [[nodiscard]] const BeamSettings& settings() const { return settings_; }
    [[nodiscard]] const PlantedError& planted() const { return planted_; }

  private:
    const Geometry& geometry_;
    const EyeView& eye_;
    BeamSettings settings_;
    PlantedError planted_;
    double wattScale_ = 0.0;
    double irradianceScale_ = 0.0;
    std::vector<std::vector<bool>> isOutside_;  // of an object's box, by source
};

}  // namespace kaustik::certify
