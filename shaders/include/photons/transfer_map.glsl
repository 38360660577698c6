// SPDX-License-Identifier: MIT
// Photons and hits as the texels of the transfer map (K06, section 2). Users declare the samplers.
#include "framework/transport/media_stack.h"
#include "framework/transport/types.h"

Photon unpackPhoton(vec4 position, vec4 direction, vec4 flux) {
    return Photon(position.xyz, position.w, direction.xyz, uint(direction.w), flux.rgb,
                  uint(flux.w));
}

PhotonOrigin unpackOrigin(uvec4 origin) {
    return PhotonOrigin(origin.x, origin.y & 0xffffu, origin.z, origin.w, origin.y >> 16u);
}

Hit unpackHit(vec4 position, vec4 surface, vec4 flux) {
    return Hit(position.xyz, position.w, surface.xyz, uint(surface.w), flux.rgb, uint(flux.w),
               vec3(0.0));
}

bool isFinite(vec3 v) {
    return !any(isnan(v)) && !any(isinf(v));
}

bool isNumber(Photon photon) {
    return isFinite(photon.positionVs) && isFinite(photon.directionVs) &&
           isFinite(photon.fluxWatts);
}

vec4 photonPositionTexel(Photon p) { return vec4(p.positionVs, p.footprintMeters); }
vec4 photonDirectionTexel(Photon p) { return vec4(p.directionVs, float(p.fate)); }
vec4 photonFluxTexel(Photon p) { return vec4(p.fluxWatts, float(p.media)); }
uvec4 originTexel(PhotonOrigin o) {
    return uvec4(o.cell, o.light | o.branch << 16u, o.path, o.parent);
}
vec4 hitPositionTexel(Hit h) { return vec4(h.positionVs, h.distanceMeters); }
vec4 hitSurfaceTexel(Hit h) { return vec4(h.normalVs, float(h.material)); }
vec4 hitFluxTexel(Hit h) { return vec4(h.fluxWatts, float(h.fate)); }
