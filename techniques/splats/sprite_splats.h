// SPDX-License-Identifier: MIT
// Ray-cast splats in the receivers' tangent planes (K06, section 3.1), of reconstruct.sprites and
// reconstruct.beams. Weights are first summed over the receivers that the pixels see, so that the
// flux deposited is the photon's flux; a compute thread a photon does one and then the other.
#pragma once

#include <string>

#include "framework/pipeline/frame_builder.h"
#include "techniques/stores/stores.h"

namespace kaustik {

// What a splat covers of its receiver's tangent plane.
enum class SpriteShape : int { beam, disc, screen };

// How a splat falls off from its middle to its radius.
enum class SpriteKernel : int { gaussian, linear, epanechnikov };

struct SpritesParams {
    SpriteShape shape = SpriteShape::beam;
    SpriteKernel kernel = SpriteKernel::gaussian;
    float radiusMeters = 0.0f;
    float footprints = 2.5f;
    int maximumPixels = 64;
    int reachPixels = 120;
    template <class R>
    void reflect(R& r) {
        r.choice(
            shape, "shape",
            "beam: what a round beam along the photon's path cuts out of the tangent plane, "
            "longer where light grazes; disc: the paper's circle in that plane; screen: a circle "
            "on the screen, the paper's comparison (Fig. 6)",
            {"beam", "disc", "screen"});
        r.choice(kernel, "kernel",
                 "gaussian: cut off at 3 sigma, evens out the photons' grid best; linear: the "
                 "paper's; epanechnikov: a parabola",
                 {"gaussian", "linear", "epanechnikov"});
        r.field(radiusMeters, "radius",
                "Radius of a photon's splat; 0: follows the photon's footprint", "m",
                params::range(0.0f, 1e6f));
        r.field(footprints, "footprints",
                "Radius of a splat in widths of its photon's beam, when no radius is set", "",
                params::range(0.1f, 100.0f))
            .when(radiusMeters <= 0.0f, "its radius is set");
        r.field(maximumPixels, "maximum", "Largest radius on the screen; splats shrink to it", "px",
                params::range(1, 100));
        // Mesa's software rasteriser silently ends a shader's loops after 65,535 turns, and a
        // splat's weights are summed in one of (2 reach + 1)².
        r.field(reachPixels, "reach",
                "Farthest from its middle that a splat goes on the screen where perspective or "
                "grazing light stretch it; it is cut off there, and keeps its flux",
                "px", params::range(1, 127));
    }
};

// The node whose splats they are, and where they take their shape from.
struct Splatting {
    std::string node = "reconstruct.sprites";
    SpritesParams params;
    bool areBeams = false;  // as wide as photons' beams are where they arrive (reconstruct.beams)
    bool areRound = false;  // of the same area, then
};

// Splats what these hits bring to receivers, W, on what a store's views see; adds to `before`, or
// to a new map.
[[nodiscard]] Stored splatInto(FrameBuilder& frame, const Splatting& splatting, const Hits& hits,
                               const Store& store, const FluxMap& before);
// Splats what these hits bring in every store where light is stored.
[[nodiscard]] CausticMap splat(FrameBuilder& frame, const Splatting& splatting, const Hits& hits,
                               const Surfaces& surfaces, const CausticMap& before);

}  // namespace kaustik
