// SPDX-License-Identifier: MIT
// What one texel of each kind of texture means. Textures are read by texelFetch; (0, 0) is the
// lower left.
#pragma once

#include "framework/graph/graph.h"

namespace kaustik {

using graph::Format;

struct ViewDepth {  // x: view depth in m, 0 none; y: half of its extent over the pixel, m
    static constexpr Format format = Format::rg32f;
};
struct SurfaceTexel {  // xyz: outward shading normal in view space; w: material + 1, 0 none
    static constexpr Format format = Format::rgba32f;
};
struct SquarePlane {  // xyz: 1/z in a square's middle, 1/m, 0 empty, and its growth a pixel; w: how
                      // far from that plane a ray may hit the layer
    static constexpr Format format = Format::rgba32f;
};
// All that a hit test asks of a layer, in one place. x: view depth in m, 0 none; yz: the triangle's
// outward unit normal, octahedral (framework/transport/octahedral.h); w: material + 1.
struct LayerTexel {
    static constexpr Format format = Format::rgba32f;
};
struct ReceiverTexel {  // x: view depth in m, 0 none; y: area of the surface that the pixel sees,
                        // m²
    static constexpr Format format = Format::rg32f;
};
struct AlbedoTexel {  // rgb: reflectance; a: 1 where there is a receiver, else 0
    static constexpr Format format = Format::rgba16f;
};
struct DepthBuffer {
    static constexpr Format format = Format::depth32f;
};
struct PhotonPosition {  // xyz: view space, m; w: footprint, m
    static constexpr Format format = Format::rgba32f;
};
struct PhotonDirection {  // xyz: unit, view space; w: fate
    static constexpr Format format = Format::rgba32f;
};
struct PhotonFlux {  // rgb: W; w: media
    static constexpr Format format = Format::rgba32f;
};
struct OriginTexel {  // transport::PhotonOrigin
    static constexpr Format format = Format::rgba32ui;
};
// How a photon's ray differs from that of the next cell of its light's grid, in
// include/photons/beam.glsl's basis across its direction. xy: a cell along u; zw: along v.
struct BeamPlace {  // m a cell
    static constexpr Format format = Format::rgba32f;
};
struct BeamTurn {  // of the direction, rad a cell
    static constexpr Format format = Format::rgba32f;
};
// What of its cell, and of cells next to it that are no photon's, a photon stands for
// (include/photons/cell_extent.glsl); 0: its cell.
struct CellExtentTexel {
    static constexpr Format format = Format::rg32ui;
};
struct HitPosition {  // xyz: view space, m; w: distance travelled, m
    static constexpr Format format = Format::rgba32f;
};
struct HitSurface {  // xyz: outward normal; w: material + 1
    static constexpr Format format = Format::rgba32f;
};
// How the normal of a specular surface turns: x, y along the vectors of include/photons/beam.glsl's
// basis across it, z between them, 1/m.
struct HitShape {
    static constexpr Format format = Format::rgba32f;
};
// What a tracer that searches one tile of the screen says of a ray. x: of several tiles' hits the
// first has the least, 0: nothing was hit; y: the hit's step, with kStrayed; z, w: how many steps,
// where squares are skipped of one layer each, and how many squares were asked.
struct HitOrder {
    static constexpr Format format = Format::rgba32ui;
};
struct HitFlux {  // rgb: W that arrive; w: fate
    static constexpr Format format = Format::rgba32f;
};
struct FluxWord {  // array: words of sums in fixed point (transport::kFluxWords)
    static constexpr Format format = Format::r32ui;
};
struct PhotonCountTexel {  // array: photons
    static constexpr Format format = Format::r32ui;
};
struct FilteredTexel {  // array: as sets of a map of flux, rgb: W, or W/sr
    static constexpr Format format = Format::rgba32f;
};
struct IrradianceTexel {  // rgb: W/m²
    static constexpr Format format = Format::rgba32f;
};
struct RadianceTexel {  // rgb: W/m²/sr
    static constexpr Format format = Format::rgba32f;
};
struct DisplayTexel {  // rgb: display-encoded (sRGB), [0,1]
    static constexpr Format format = Format::rgba8;
};

struct VisibilityTexel {  // x: share of a light's direct light that reaches the receiver, [0, 1]
    static constexpr Format format = Format::r32f;
};
// x: how the path of the ray through the pixel's middle has ended, kPath… + kPathMet; 0: it met no
// specular surface.
struct PathEnding {
    static constexpr Format format = Format::r32f;
};
struct ExitPosition {  // xyz: view space, m; w: specular surfaces that the eye's ray hit, 0 none
    static constexpr Format format = Format::rgba32f;
};
struct ExitDirection {  // xyz: unit, view space; w: how the ray's path has ended, kPath…
    static constexpr Format format = Format::rgba32f;
};

}  // namespace kaustik
