// SPDX-License-Identifier: MIT
// shadow.bvh: from every receiver pixel a ray back to each light, traced exactly on the device,
// however photons are traced. In: eye buffer; out: visibility, 0 or 1 a pixel and light.
#include "techniques/shadow/rays_to_lights.h"
#include "techniques/tracing/bvh_rays.h"

namespace kaustik {
namespace {

Shadows traceExactShadowRays(FrameBuilder& frame, const params::NoParams&, Geometry geometry,
                             EyeBuffer eye, LayeredDepth layers) {
    return shadowsByRays(frame, "bvh", geometry, eye, layers,
                         [&](const Photons& rays, const Surfaces& surfaces) {
                             return hitsByBvh(frame, rays, surfaces.geometry);
                         });
}

}  // namespace

void registerShadowBvh(Registry& registry) {
    registry.node<ShadowStage>(
        "bvh",
        {"Traces a ray from every receiver to the light exactly, through the hierarchy over all "
         "triangles.",
         "", "A shadow is there or not, once a pixel. The hierarchy is that of trace.bvh."},
        &traceExactShadowRays);
}

}  // namespace kaustik
