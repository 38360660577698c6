// SPDX-License-Identifier: MIT
// trace.all_hits: one thread a photon and slot; slot 0 holds the first hit, the others the
// receivers that the ray would meet behind it.
#include "common/traced_photon.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f) writeonly uniform image2D nextPosition;
layout(rgba32f) writeonly uniform image2D nextDirection;
layout(rgba32f) writeonly uniform image2D nextFlux;
layout(rgba32f) writeonly uniform image2D hitPosition;
layout(rgba32f) writeonly uniform image2D hitSurface;
layout(rgba32f) writeonly uniform image2D hitFlux;
uniform sampler2D keptPosition;  // hits of earlier tracings
uniform sampler2D keptSurface;
uniform sampler2D keptFlux;
uniform int rows;  // of a slot

// The surface number `wanted` along the ray; past the first only receivers count, and none where
// the first is specular: there the light does go on elsewhere.
FirstHit hitNumber(Photon photon, int wanted) {
    FirstHit last = noHit();
    if (!isNumber(photon)) return last;
    RaySegment segment = clipRay(photon.positionVs, photon.directionVs);
    if (!segment.visible) return last;
    TracedRay ray = tracedRay(photon.positionVs, photon.directionVs, photon.media);
    int steps = stepCount(segment, trace_all_hits_minimum, trace_all_hits_steps);
    int number = -1;
    FirstHit pending = noHit();  // the next step may know a nearer one
    for (int i = 0; i <= steps; ++i) {
        FirstHit found = noHit();
        if (i < steps) found = hitOfStep(segment, ray, i, steps);
        bool isNew = found.hit.layer >= 0;
        if (number >= 0 && isNew) {
            // Neighbouring steps may meet the same surface.
            float step = segment.farT - segment.nearT;
            isNew = found.hit.t > last.hit.t + step / float(steps);
            uint material = layerAt(found.pixel, found.hit.layer).material;
            isNew = isNew && isReceiver(materialKind(material - 1u));
        }
        if (pending.hit.layer >= 0) {
            if (isNew && found.hit.t < pending.hit.t) pending = found;
            last = pending;
            pending = noHit();
            ++number;
            if (number == wanted) return last;
            uint material = layerAt(last.pixel, last.hit.layer).material;
            if (!isReceiver(materialKind(material - 1u))) return noHit();
        } else if (isNew) {
            pending = found;
        }
    }
    return noHit();
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    int slot = int(gl_GlobalInvocationID.z);
    ivec2 size = textureSize(photonPosition, 0);
    if (texel.x >= size.x || texel.y >= rows) return;
    ivec2 target = texel + ivec2(0, slot * rows);
    Photon photon = photonAt(texel);
    bool isTraced = photon.fate == kFateInFlight;
    Hit hit = Hit(vec3(0.0), 0.0, vec3(0.0), 0u, vec3(0.0), kFateNone);
    bool isKept = !isTraced && target.y < textureSize(keptFlux, 0).y;
    if (isKept) {
        photon = photonAt(target);
        hit = unpackHit(texelFetch(keptPosition, target, 0), texelFetch(keptSurface, target, 0),
                        texelFetch(keptFlux, target, 0));
    } else if (isTraced) {
        FirstHit found = hitNumber(photon, slot);
        if (slot == 0 || found.hit.layer >= 0) hit = deliver(photon, found);
    }
    if (slot > 0 && !isKept) photon.fate = isTraced ? kFateEnded : kFateNone;
    imageStore(nextPosition, target, photonPositionTexel(photon));
    imageStore(nextDirection, target, photonDirectionTexel(photon));
    imageStore(nextFlux, target, photonFluxTexel(photon));
    imageStore(hitPosition, target, hitPositionTexel(hit));
    imageStore(hitSurface, target, hitSurfaceTexel(hit));
    imageStore(hitFlux, target, hitFluxTexel(hit));
}
