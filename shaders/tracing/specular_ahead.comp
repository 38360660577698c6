// SPDX-License-Identifier: MIT
// The first specular surface on the way of each photon of one light, in layers of what is specular
// in the light's view, a texel a step. One thread a photon.
// Rays come to bodies at their outlines more than elsewhere: what leaves another one near its rim.
#define MAX_SLOPE 64.0
#include "include/photons/photon_thread.glsl"
#include "trace/march.glsl"

layout(rgba32f) writeonly uniform image2D nextSurface;
layout(rgba32f) writeonly uniform image2D nextTriangle;
#ifdef PHOTON_BEAMS
layout(rgba32f) writeonly uniform image2D nextShape;
#endif
uniform int lightIndex;

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    if (int(lightOfBand(originAt(texel).light)) != lightIndex) return;
    Photon photon = photonAt(texel);
    vec4 surface = vec4(0.0);
    vec4 triangle = vec4(0.0);
    vec3 shape = vec3(0.0);
    if (photon.fate == kFateInFlight) {
        // As many steps as there are texels.
        FirstHit first = march(photon, 1, int(max(view.sizePixels.x, view.sizePixels.y)));
        if (first.hit.layer >= 0) {
            uint material;
            Crossing crossing = crossingOf(photonInView(photon), first, material);
            surface = vec4(directionToEye(crossing.shading), float(material));
            triangle = vec4(directionToEye(crossing.geometric), crossing.t);
#ifdef PHOTON_BEAMS
            shape = shapeOf(bendingNormal(photon.directionVs, surface.xyz, triangle.xyz, material,
                                          photon.media),
                            turningToEye(crossing.turning));
#endif
        }
    }
    imageStore(nextSurface, texel, surface);
    imageStore(nextTriangle, texel, triangle);
#ifdef PHOTON_BEAMS
    imageStore(nextShape, texel, vec4(shape, 0.0));
#endif
}
