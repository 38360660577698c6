// SPDX-License-Identifier: MIT
// Handles of what is seen of the scene in some views: by the eye, by lights, from a point.
#pragma once

#include <memory>
#include <optional>

#include "framework/pipeline/tiles.h"
#include "framework/render/raster_views.h"
#include "framework/transport/geometry.h"
#include "framework/transport/texels.h"
#include "framework/transport/types.h"

namespace kaustik {

// The views that textures were rasterised in; those of cubes hold their faces one after the other.
using Views = std::shared_ptr<const render::RasterViews>;

// The surfaces on which light can be stored: the first diffuse or glossy surface on each pixel's
// straight ray, dielectrics being invisible to it. A pixel that ends on a mirror has none. The
// textures are 2D, or arrays for the faces of a cube.
struct ReceiverView {
    graph::Texture<ReceiverTexel> receiver;
    graph::Texture<SurfaceTexel> receiverSurface;  // where the ray ends on a mirror, the mirror's
    graph::Texture<AlbedoTexel> receiverAlbedo;
    Views views;
};

// What the eye sees.
struct EyeBuffer : ReceiverView {
    // The first specular surface in front of the receiver; invalid where the scene has none.
    graph::Texture<ViewDepth> interface;
    graph::Texture<SurfaceTexel> interfaceSurface;
};

// All surfaces along each pixel's ray, front to back (K06, section 2.2). Of a cube the arrays hold
// `layers` for each face. A pixel's layers end with the first whose depth is 0; what the arrays
// hold behind that one, and the surface of a layer without a depth, is undefined and nobody may ask
// for it. Depths are also defined in every layer that any pixel of the same aligned square of 4
// pixels has, so that who knows the layers of a square need not walk to one of them.
struct LayeredDepth {
    graph::Texture<LayerTexel> depth;      // array, one layer a surface
    graph::Texture<SurfaceTexel> surface;  // array
    graph::Texture<SquarePlane> pyramid;   // array; planes of the layers over squares of pixels
    graph::Buffer<transport::LayerStatistics> statistics;  // invalid where nobody asks for them
    int layers = 0;
    Views views;
    std::optional<ScreenTile> tile = {};  // of the screen, beyond whose border they are empty
};

// What a technique's nodes are given of the scene. A pass that is not read does not run: a node
// that is handed surfaces pays only for those that it reads.
struct Surfaces {
    Geometry geometry;
    EyeBuffer eye;
    LayeredDepth layers;
};

}  // namespace kaustik
