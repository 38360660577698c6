// SPDX-License-Identifier: MIT
// What reconstruct.triangles can be told, and which light it would not join, for drivers that
// choose photons by it.
#pragma once

#include <cstdint>
#include <string>

#include "framework/pipeline/frame_builder.h"
#include "techniques/raster_views/map_params.h"
#include "techniques/tracing/rays_by.h"

namespace kaustik {

enum class TriangleShading : int { smooth, flat, vertices };
enum class Unjoined : int { beams, discard };
enum class LightSize : int { points, widened };
enum class Coverage : int { middle, samples };

inline std::string whyCoverageIsNotSampled(const FrameFacts& facts) {
    return facts.settings.get<ReconstructParams>(ReconstructStage::name).space == StoreSpace::screen
               ? ""
               : "light is not stored on the screen";
}

// What the processor covers is of the eye's pixels alone, and matte.
inline std::string whyNotCoveredByProcessor(const FrameFacts& facts) {
    if (facts.needs != nullptr && facts.needs->glossyReceivers) return "some receivers are glossy";
    if (facts.widensByLights()) return "what a light's size spreads is laid by the device";
    return whyCoverageIsNotSampled(facts);
}

// Photons that are stored by cell keep nothing of how their lights spread them.
inline std::string whyTrianglesAreNotWidened(const FrameFacts& facts) {
    return facts.settings.choice(DriverStage::name) == "hierarchical"
               ? facts.withChosen<DriverStage>()
               : "";
}

struct TrianglesParams {
    float tolerance = 0.5f;
    int maximum = 512;
    TriangleShading shading = TriangleShading::smooth;
    Unjoined unjoined = Unjoined::beams;
    float merge = 0.0f;
    LightSize lightSize = LightSize::points;
    Coverage coverage = Coverage::middle;
    RaysBy cover = RaysBy::automatic;
    template <class R>
    void reflect(R& r) {
        const auto whyNotJoined = [](const FrameFacts& facts) { return facts.whyNoNeighbours(); };
        r.field(
             tolerance, "tolerance",
             "Neighbours are joined where they arrive no farther from where their beams say than "
             "this share of their distance",
             "", params::range(0.01f, 10.0f))
            .when(whyNotJoined);
        r.field(maximum, "maximum",
                "Longest side on the screen; wider cells are not joined, and beams shrink to it",
                "px", params::range(1, 1024));
        r.choice(shading, "shading",
                 "smooth: between the densities that the beams give at the corners; flat: the same "
                 "all over a triangle; vertices: between what each corner's photon has for a third "
                 "of all triangles there (U08)",
                 {"smooth", "flat", "vertices"})
            .when(whyNotJoined);
        r.choice(
            unjoined, "unjoined",
            "What becomes of light between photons that are not joined. beams: each covers its "
            "part by its own; discard: it is lost, and counted as discarded_triangle",
            {"beams", "discard"});
        r.field(
             merge, "merge",
             "Neighbouring cells, up to 16 along a side, that together span no more than this are "
             "drawn as one, with their flux added; 0: none",
             "px", params::range(0.0f, 64.0f))
            .when(whyNotJoined);
        r.choice(lightSize, "light_size",
                 "What light from a lamp's part, for which a point stands, does. widened: it goes "
                 "where all of the part would send it, to first order, so that fewer points do; "
                 "points: where its point does",
                 {"points", "widened"})
            .when([](const FrameFacts& facts) -> std::string {
                return facts.needs == nullptr || facts.needs->emitters > 0
                           ? ""
                           : "no light of the scene has a size";
            })
            .when(&whyTrianglesAreNotWidened);
        r.choice(coverage, "coverage",
                 "What tells which surfaces a pixel shows where one ends. middle: the one at its "
                 "middle; samples: those at four places in it, by exact rays of the eye",
                 {"middle", "samples"})
            .when(&whyCoverageIsNotSampled);
        r.choice(cover, "cover",
                 "Who finds what is covered of each of the eye's pixels: the device, or the "
                 "processor on all cores; auto: the processor where the device renders on it",
                 {"auto", "device", "processor"})
            .when(&whyNotCoveredByProcessor);
    }
};

// As they are for a store's views: nothing is joined that is too wide for one face of a cube.
[[nodiscard]] TrianglesParams trianglesForViews(TrianglesParams params,
                                                const render::RasterViews& views);

// Adds to `parted`, by square between four photons of a batch's grids
// (shaders/light_cells/squares.glsl), what of its light these hits bring where they are not joined,
// as a share of `cellFlux`, what was emitted by cell, W.
[[nodiscard]] graph::Buffer<std::uint32_t> addParted(FrameBuilder& frame, const Surfaces& surfaces,
                                                     const Hits& hits,
                                                     graph::Buffer<float> cellFlux,
                                                     graph::Buffer<std::uint32_t> parted);

}  // namespace kaustik
