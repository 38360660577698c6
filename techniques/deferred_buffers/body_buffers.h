// SPDX-License-Identifier: MIT
// Fronts and backs of each body by itself, so that rays go from one to another (WN09, section
// 3.1.1): normals, depths and materials, and where photons have beams how the normals turn. A body
// is an object, or several that meet or lie in one another, of which none is told from the others
// (scene/connected_bodies.h). Each is drawn once for both.
#pragma once

#include <string>
#include <vector>

#include "techniques/deferred_buffers/deferred_buffers.h"
#include "techniques/raster_views/back_faces.h"

namespace kaustik {

// Closed dielectrics, one or those that are connected. World space, m.
struct Body {
    std::vector<std::size_t> objects;
    std::vector<std::string> names;
    std::vector<scene::Bounds> boxes;  // of the objects; may overlap another body's
};
[[nodiscard]] std::vector<Body> bodiesOf(const FrameBuilder& frame);

// Coarsely sorted, by the nearest points of their boxes: from a point, or along a direction.
[[nodiscard]] std::vector<Body> nearestFirst(std::vector<Body> bodies, const scene::Light& light);
[[nodiscard]] std::vector<Body> nearestFirst(std::vector<Body> bodies, const glm::dvec3& eye);
// The names in quotation marks and separated by commas: "'a', 'b'".
[[nodiscard]] std::string quoted(const std::vector<std::string>& names);
// Names the bodies beyond the first `maximum`, which are left out; "" where there are none.
[[nodiscard]] std::string omittedNames(const std::vector<Body>& bodies, int maximum);

// Arrays: the front and the back of body i are layers 2i and 2i + 1, and after those of all the
// first surface that is no dielectric.
struct BodyBuffers {
    graph::Texture<ViewDepth> depth;
    graph::Texture<SurfaceTexel> surface;  // normals in the view's space
    graph::Texture<HitShape> shape;        // the same; where it was asked for
    Views views;                           // one
    int bodies = 0;
    int boxes = 0;
    const gl::Buffer* boxData = nullptr;  // of deferred::BodyBox; lives as long as the frame
    // Declares what deferred_buffers/bodies.glsl reads: "bodyDepth", "bodySurface", "bodyShape".
    // The pass's shaders are compiled as BODIES, and as SEVERAL_BODIES where there is more than
    // one.
    void sample(graph::PassSetup& setup) const;
    // The block "BodyBoxes", "boxCount" and "bodyCount".
    void bindTo(gl::Command& command) const;
};

// How rays that have left a body look for the next one (include/views/plane_search.glsl).
struct BodySearchParams {
    int searchSteps = 48;
    int iterations = 4;
    int refinements = 6;
    template <class R>
    void reflect(R& r) {
        r.field(searchSteps, "search_steps",
                "Even steps through a body's box in which its front is searched before what "
                "iteration has found, or where it has found nothing",
                "", params::range(0, 1024))
            .when(&whyNoOtherBody);
        r.renamed("looks", "search_steps");
        r.field(iterations, "iterations",
                "Looks at the front that a ray may meet before the residual's test", "",
                params::range(1, 64))
            .when(&whyNoOtherBody);
        r.field(refinements, "refinements", "Bisections of the step in which a front was found", "",
                params::range(0, 32))
            .when(&whyNoOtherBody)
            .when(searchSteps > 0, "no front is searched for, with search_steps=0");
    }
};

// A deferred::BodyBox an object of these, drawn or not, for `buffers` of one view.
void setBoxes(FrameBuilder& frame, const std::vector<Body>& bodies, const std::string& prefix,
              BodyBuffers& buffers);

// What the pass is called, and the names of its textures begin with.
struct BodyBuffersPass {
    int bodies = 1;  // that are drawn: the first ones
    std::string name;
    std::string reason;
    std::string prefix;
    bool hasShape = false;
    DeferredGeometry geometry = DeferredGeometry::once;
};
[[nodiscard]] BodyBuffers drawBodies(FrameBuilder& frame, const Geometry& geometry,
                                     const Views& views, const std::vector<Body>& bodies,
                                     const BodyBuffersPass& pass);

}  // namespace kaustik
