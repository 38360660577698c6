// SPDX-License-Identifier: MIT
// What the nodes that look through specular surfaces share.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "framework/pipeline/eye_rays.h"
#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// The surfaces among which rays look for what they see.
enum class LookSurfaces : int { receivers, layers };

// How rays that have left the dielectrics look for what they see; the nodes share it.
struct SceneLookParams {
    bool scene = true;
    bool reflection = true;
    LookSurfaces surfaces = LookSurfaces::receivers;
    int stride = 4;
    int mirrors = 4;
    template <class R>
    void reflect(R& r) {
        r.field(scene, "scene",
                "Look for the surfaces that the ray hits where the picture shows them (the "
                "paper's Fig. 10); off: only the environment");
        r.field(reflection, "reflection",
                "The same for the reflection at the first interface and for mirrors; off: they see "
                "the environment")
            .when(scene, "with scene=false");
        r.choice(surfaces, "surfaces",
                 "receivers: the first receiver or mirror of every pixel; layers: the paper's, all "
                 "surfaces of the scene's layered depth, of which those that the picture does not "
                 "show are lit through the layers",
                 {"receivers", "layers"})
            .when(scene, "with scene=false");
        r.field(stride, "stride",
                "Pixels between two looks of a ray at the receivers; thinner ones may be missed. "
                "Layers are looked at in every pixel",
                "px", params::range(1, 64))
            .when(scene, "with scene=false")
            .when(surfaces == LookSurfaces::receivers, "with surfaces=layers");
        r.field(mirrors, "mirrors", "Most mirrors that a ray hits one after the other", "",
                params::range(1, 64))
            .when(scene, "with scene=false")
            .when([](const FrameFacts& facts) {
                const bool mayHit = facts.needs == nullptr || facts.needs->reflectors > 0;
                return mayHit ? "" : "the scene has no mirror";
            });
    }
};

// What a ray next to a pixel's middle sees first. x: view depth in m, of a receiver negative, 0
// none; yz: the triangle's outward unit normal, octahedral; w: material + 1.
struct SightTexel {
    static constexpr Format format = Format::rgba32f;
};

// The box around all dielectrics, along the world's axes, with a margin of two pixels.
struct DielectricsBox {
    glm::vec3 centerVs{0.0f};  // m
    glm::vec3 halfExtentMeters{0.0f};
    // The box of a receiver or a mirror overlaps that of a closed dielectric: it may lie within.
    bool holdsScene = false;
    // Most closed dielectrics that may lie in one another, by their boxes.
    int nested = 0;
};
[[nodiscard]] DielectricsBox boxOfDielectrics(const FrameBuilder& frame);

// The points where the rays of view.samples go through a pixel, px from its middle, within half a
// pixel: `count` points of a rank-1 lattice, one in each of as many columns and rows, symmetric
// about the middle, which is one of them where the count is odd; of 4 the rotated grid.
[[nodiscard]] std::vector<glm::vec2> samplesOfPixel(int count);

// The first surfaces that rays next to the pixels' middles see, drawn anew for each sample.
struct ViewSamples {
    int count = 1;  // of one, the middle, nothing is drawn
    graph::Texture<SightTexel> sight;
    graph::Texture<SurfaceTexel> surface;
    graph::Texture<DepthBuffer> depthBuffer;
    Geometry geometry;
};

// What such a pass gives, and what its shaders are told of what it was given.
struct ViewPass {
    View seen;
    ViewSamples samples;
    graph::Texture<DepthBuffer> marks;  // 0 where the ray meets a specular surface first
    int sceneLayers = 0;                // where they are looked at
    bool isGlossy = false;              // some receiver is
};

// A scene without specular surfaces: the pass `pass` is skipped, and the receivers are what is
// seen.
[[nodiscard]] View renderReceiversOnly(FrameBuilder& frame, const std::string& pass,
                                       const Radiance& receivers);
// Why such a pass runs, for pass().
[[nodiscard]] std::string lookReason(const FrameBuilder& frame);

// Declares what such a pass reads of the eye buffer and of light, by the names of
// include/views/view_sample.glsl and shown_radiance.glsl, and the outputs of its View. A pass that
// is disabled shows the receivers and no exits.
[[nodiscard]] ViewPass declareView(const FrameBuilder& frame, graph::PassSetup& setup,
                                   const Geometry& geometry, const EyeBuffer& eye,
                                   const Radiance& receivers, const Shadows& shadows);
// The same of one that draws, and by the names of include/views/scene_look.glsl what it looks for
// the scene in.
[[nodiscard]] ViewPass declareLook(const FrameBuilder& frame, graph::PassSetup& setup,
                                   const SceneLookParams& look, const Geometry& geometry,
                                   const EyeBuffer& eye, const LayeredDepth& sceneLayers,
                                   const Radiance& receivers, const Shadows& shadows);

// Whether what such a pass draws holds where the eye's rays left for good: somebody asks for it.
[[nodiscard]] bool storesExits(const gl::PassContext& context, const View& seen);

// Tells a shader what it asks for.
using Tell = std::function<void(gl::Command&)>;
// A ray through each pixel.
struct PixelSample {
    glm::vec2 offset{0.0f};  // px, from its middle
    Tell tell;               // of it, a shader that includes include/views/first_surface.glsl
    [[nodiscard]] bool isMiddle() const { return offset == glm::vec2(0.0f); }
};
// Calls `look` once for each sample of a pixel; the middle of the pixels comes first, whose ray is
// followed for its exit where it is none of the samples.
using LookOnce = std::function<void(const PixelSample& sample)>;
void lookBySamples(const FrameInputs& inputs, gl::PassContext& context, const ViewPass& pass,
                   const LookOnce& look);
// Draws all that such a pass gives: `shader` once for each sample of a pixel that meets a specular
// surface first (eye_rays/straight.frag draws the others), as often as there are `tells`. Exits
// are those of the middle, whose ray is followed for them where it is not one of the samples.
void drawSpecular(const FrameInputs& inputs, gl::PassContext& context, const ViewPass& pass,
                  const std::string& shader, const std::vector<Tell>& tells);
// Draws one shader, and also binds what include/views/scene_look.glsl needs.
void drawLook(const FrameInputs& inputs, gl::PassContext& context, const ViewPass& pass,
              const SceneLookParams& look, const std::string& shader, const Tell& tell);

// What pixels whose rays end at a cap of a view node are told by. `fate`: what becomes of them.
void reportExitLimit(FrameBuilder& frame, const std::string& pass, const View& seen,
                     const std::string& parameter, const std::string& unit, int value,
                     std::size_t EyeRays::*ending, const std::string& fate);
// What is told where more than a hundredth of the pixels' rays are lost. `why`: a sentence's end.
void reportLostRays(FrameBuilder& frame, const std::string& pass, const View& seen,
                    const std::string& why);
// The caps on refractions, total reflections and nested dielectrics, of the node `pass`.
void reportDielectricLimits(FrameBuilder& frame, const std::string& pass, const View& seen,
                            int interfaces, int reflections);
// The cap on mirrors, of the node `pass`; nothing where the scene has none.
void reportMirrorLimit(FrameBuilder& frame, const std::string& pass, const View& seen, int mirrors);

}  // namespace kaustik
