// SPDX-License-Identifier: MIT
// What each light sees of the scene, for photons at any place of its view (WN09, section 3.1): the
// first surfaces, and the farthest back faces of bodies. The geometry is drawn once for both.
#pragma once

#include <vector>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// The triangle that a light sees. x: object's index + 1, 0 none; y: the triangle.
struct TriangleTexel {
    static constexpr Format format = Format::rg32ui;
};

// Arrays of layers: kFirst, and where they are shared kBacks.
struct DeferredBuffers {
    static constexpr int kFirst = 0;  // of everything, receivers too
    static constexpr int kBacks = 1;  // of closed dielectrics
    graph::Texture<TriangleTexel> triangle;
    graph::Texture<ViewDepth> depth;
    graph::Texture<SurfaceTexel> surface;  // normals in the light's view space
    graph::Texture<HitShape> shape;        // the same; of backs that are shared, for beams
    Views views;                           // one
    bool hasBackFaces = false;
    glm::dvec2 cells{1.0};  // the part of the view that cells share out, as emit.grid's do
    // "deferredTriangle", "deferredDepth", "deferredSurface", "cellsOfView".
    void bindTo(gl::Command& command) const;
    void read(graph::PassSetup& setup) const;
};

// Whether specular.deferred takes the backs of these buffers: of a scene's only body.
[[nodiscard]] bool sharesBackFaces(const FrameBuilder& frame);

// The buffers of each light, drawn once a frame by the first node that asks.
[[nodiscard]] const std::vector<DeferredBuffers>& deferredBuffers(FrameBuilder& frame,
                                                                  const Geometry& geometry);

// What all of the family's nodes share (`emit.deferred`).
enum class DeferredFrame : int { tight, loose };
enum class DeferredGeometry : int { once, twice };
template <class R>
void reflectGeometry(R& r, DeferredGeometry& geometry) {
    r.choice(geometry, "geometry",
             "once: fronts and backs from one drawing, parted by a geometry shader; twice: one "
             "after the other",
             {"once", "twice"});
}
enum class DeferredLookup : int { triangle, interpolated };
struct DeferredParams {
    int size = 1024;
    DeferredFrame frame = DeferredFrame::tight;
    DeferredGeometry geometry = DeferredGeometry::once;
    DeferredLookup lookup = DeferredLookup::triangle;
    template <class R>
    void reflect(R& r) {
        r.field(size, "size",
                "Longer side of each light's view of first surfaces and backs, from which photons "
                "at any place are made; WN09 take a quarter of the map's",
                "texels", params::range(16, 8192));
        r.choice(frame, "frame",
                 "What a light's view holds. tight: the specular objects; loose: the whole scene, "
                 "as where shares of a dense grid are to be compared with WN09's",
                 {"tight", "loose"});
        reflectGeometry(r, geometry);
        r.choice(
            lookup, "lookup",
            "Where a photon between texels starts. triangle: on that of the triangles around "
            "which its ray meets, else interpolated; interpolated: between four texels' depths "
            "and normals, as published",
            {"triangle", "interpolated"});
    }
};

}  // namespace kaustik
