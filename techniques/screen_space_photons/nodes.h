// SPDX-License-Identifier: MIT
// Screen-space photon tracing: Krüger, Bürger, Westermann 2006, "Interactive Screen-Space Accurate
// Photon Tracing on GPUs" (K06).
#pragma once

#include "framework/pipeline/registry.h"
#include "framework/pipeline/stage_params.h"
#include "framework/render/gpu_scene.h"
#include "techniques/shared/view_passes.h"

namespace kaustik {

void registerScreenSpacePhotons(Registry& registry);

// Which surfaces a layered depth image holds, and its resources' names ("layers" gives
// "layers.depth").
struct LayersRequest {
    std::string name;
    render::DrawSet set = render::DrawSet::all;
    int layers = 8;
    bool reducesCounts = false;               // by a texture reduce instead of atomics
    std::string reader = "the tracer needs";  // that needs them, for people
};
// Adds the pass that counts the fragments of every pixel (K06, section 2.2).
[[nodiscard]] graph::Buffer<transport::LayerStatistics> measureComplexity(
    FrameBuilder& frame, Geometry geometry, const LayersRequest& request);
// Adds the passes of a layered depth image without a pyramid.
[[nodiscard]] LayeredDepth peel(FrameBuilder& frame, Geometry geometry,
                                const LayersRequest& request);

// Adds the pass that makes `pyramid` of the other layers' textures.
[[nodiscard]] LayeredDepth addPyramid(FrameBuilder& frame, const LayeredDepth& layers);

// How the fragments of all pixels become their maximum and sums (K06, section 2.2).
enum class Counting : int { atomics, reduce };

struct PeelParams {
    Counting counting = Counting::atomics;
    template <class R>
    void reflect(R& r) {
        r.choice(counting, "counting",
                 "atomics: each pixel adds to shared numbers; reduce: the paper's texture reduce, "
                 "exact to 16 million fragments",
                 {"atomics", "reduce"});
    }
};
LayeredDepth peelLayers(FrameBuilder& frame, const PeelParams& params, Geometry geometry);

LayeredDepth peelObjects(FrameBuilder& frame, const params::NoParams&, Geometry geometry);

// How each photon's line gets its vertices (K06, section 2.1; section 6, future work).
enum class LineSource : int { vertex, geometry };

struct LinesParams {
    LineSource source = LineSource::vertex;
    int width = 0;
    int rows = 0;
    int memoryMebibytes = 64;
    int minimum = 4;
    template <class R>
    void reflect(R& r) {
        r.choice(source, "source",
                 "vertex: a vertex shader places both ends of each line; geometry: a geometry "
                 "shader makes the line from one point",
                 {"vertex", "geometry"});
        r.field(width, "width",
                "Most fragments of a photon's line; 0: as many as the longer side of the picture "
                "has pixels, so that no step skips one",
                "texels", params::range(0, 16384));
        r.field(rows, "rows", "Photons in a batch, one row each; 0: as many as the memory allows",
                "", params::range(0, 16384));
        r.field(memoryMebibytes, "memory",
                "Most memory for the row texture and its reductions; fewer rows mean more batches",
                "MiB", params::range(1, 8192));
        r.field(minimum, "minimum",
                "Fewest fragments of a line, for rays almost parallel to the view direction",
                "texels", params::range(1, 64));
    }
};
Hits traceLines(FrameBuilder& frame, const LinesParams& params, Photons photons, Surfaces surfaces);

struct MarchParams {
    int steps = 0;
    int minimum = 4;
    template <class R>
    void reflect(R& r) {
        r.field(steps, "steps",
                "Most steps of a photon's ray; 0: as many as the longer side of the picture has "
                "pixels, so that no step skips one",
                "", params::range(0, 16384));
        r.field(minimum, "minimum",
                "Fewest steps of a ray, for rays almost parallel to the view direction", "",
                params::range(1, 64));
    }
};
Hits traceMarch(FrameBuilder& frame, const MarchParams& params, Photons photons, Surfaces surfaces);
Hits traceMarchCompute(FrameBuilder& frame, const MarchParams& params, Photons photons,
                       Surfaces surfaces);

Hits traceHierarchical(FrameBuilder& frame, const MarchParams& params, Photons photons,
                       Surfaces surfaces);
Hits traceHierarchicalCompute(FrameBuilder& frame, const MarchParams& params, Photons photons,
                              Surfaces surfaces);

struct AllHitsParams {
    int slots = 4;
    MarchParams march;
    template <class R>
    void reflect(R& r) {
        r.field(slots, "slots", "Most hits of a ray that are kept", "", params::range(1, 16));
        march.reflect(r);
    }
};
Hits traceAllHits(FrameBuilder& frame, const AllHitsParams& params, Photons photons,
                  Surfaces surfaces);

Shadows traceShadowRays(FrameBuilder& frame, const params::NoParams&, Geometry geometry,
                        EyeBuffer eye, LayeredDepth layers);

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
                params::range(0.1f, 100.0f));
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
CausticMap splatSprites(FrameBuilder& frame, const SpritesParams& params, Hits hits,
                        Surfaces surfaces, CausticMap before);

struct GodRayParams {
    float width = 0.0f;
    float footprints = 1.5f;
    int maximum = 64;
    template <class R>
    void reflect(R& r) {
        r.field(width, "width",
                "Width of a photon's line, 1 at least (the paper's); 0: follows the photon's "
                "footprint",
                "px", params::range(0.0f, 64.0f));
        r.field(footprints, "footprints",
                "Width of a line in widths of its photon's beam, when no width is set", "",
                params::range(0.1f, 100.0f));
        r.field(maximum, "maximum", "Largest width on the screen; lines shrink to it", "px",
                params::range(1, 256));
    }
};
InScattered drawGodRays(FrameBuilder& frame, const GodRayParams& params, Hits hits, EyeBuffer eye,
                        InScattered before);

struct GaussianBlurParams {
    float sigma = 2.0f;
    template <class R>
    void reflect(R& r) {
        r.field(sigma, "sigma", "Standard deviation of the Gaussian", "px",
                params::range(0.1f, 64.0f));
    }
};
InScattered blurGaussian(FrameBuilder& frame, const GaussianBlurParams& params, InScattered sharp);
// Where an eye ray's next interface is looked for.
enum class RefractionSearch : int { automatic, monotonic, all };

// When the monotonic search takes a layer for met.
enum class RefractionStop : int { crossing, depth };

struct RefractionViewParams {
    RefractionSearch search = RefractionSearch::automatic;
    RefractionStop stop = RefractionStop::crossing;
    int interfaces = 0;
    int reflections = 4;
    int layers = 8;
    SceneLookParams look;
    template <class R>
    void reflect(R& r) {
        r.choice(search, "search",
                 "monotonic: the paper's, between the layer that the ray has passed last and the "
                 "next one; all: in every layer of every pixel on its way; auto: monotonic, unless "
                 "dielectrics lie in one another, of which it knows no order",
                 {"auto", "monotonic", "all"});
        r.choice(stop, "stop",
                 "depth: the paper's, as soon as the ray is deeper than the next layer or nearer "
                 "than the one passed; crossing: it must cross that layer's plane nearby too, so "
                 "that one which passes behind another part of the object goes on. For the "
                 "monotonic search",
                 {"crossing", "depth"});
        r.field(interfaces, "interfaces",
                "Most refractions of an eye ray; the paper's table has 2, and 1 is its Fig. 9, "
                "left. 0: "
                "4, or 2 for each closed dielectric of those that lie in one another",
                "", params::range(0, 16));
        r.field(reflections, "reflections",
                "Most total internal reflections of an eye ray; what needs more is lost", "",
                params::range(0, 64));
        r.field(layers, "layers",
                "Most layers of transmitting objects that are peeled; the monotonic search needs "
                "no more than its interfaces",
                "", params::range(1, 64));
        look.reflect(r);
    }
};
View traceRefraction(FrameBuilder& frame, const RefractionViewParams& params, Geometry geometry,
                     EyeBuffer eye, LayeredDepth layers, Radiance receivers, Shadows shadows);

struct ImageSpaceViewParams {
    int steps = 8;
    SceneLookParams look;
    template <class R>
    void reflect(R& r) {
        r.field(steps, "steps",
                "Looks at the back faces along the inverse normal, for the distance to them; 0: "
                "only the distance along the eye's ray is used",
                "", params::range(0, 64));
        look.reflect(r);
    }
};
View refractInImageSpace(FrameBuilder& frame, const ImageSpaceViewParams& params, Geometry geometry,
                         EyeBuffer eye, LayeredDepth layers, Radiance receivers, Shadows shadows);

}  // namespace kaustik
