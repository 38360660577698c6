// SPDX-License-Identifier: MIT
// The line of one photon: a parallelogram that covers every pixel which may hold a part of it. The
// fragments work their shares out themselves, so that a device's rules for lines do not matter
// (hard case 6), nor how far beyond the line the parallelogram reaches. A strip of four vertices.
#include "include/hits.glsl"
#include "include/photons.glsl"
#include "screen_space_photons/god_rays.glsl"

layout(std430) buffer NarrowedLines {
    Narrowed narrowed;
};

flat out vec4 pathPixels;  // of both ends; the longer axis of the line comes first
flat out vec4 pathEnds;    // 1/z and t of both ends
flat out vec3 pathDirection;
flat out vec3 pathExtinction;  // 1/m
flat out vec3 pathPower;       // see god_rays.frag
flat out vec2 pathWidth;       // footprint, m; width along the shorter axis over that across
flat out int isSteep;

void main() {
    gl_Position = vec4(-2.0, -2.0, 0.0, 1.0);
    uint index = uint(gl_InstanceID);
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    Photon photon = photonAt(texel);
    if (photon.fate != kFateInFlight || !isNumber(photon)) return;
    uint fate = uint(texelFetch(hitFlux, texel, 0).w);
    bool hasHit = fate == kFateReceiver || fate == kFateSpecular;
    float end = hasHit ? texelFetch(hitPosition, texel, 0).w : 3.0e38;
    RaySegment path = clipPath(photon.positionVs, photon.directionVs, end,
                             0.5 * float(media_lines_maximum) + 1.0);
    if (!path.visible) return;

    vec2 along = path.farPixel - path.nearPixel;
    isSteep = abs(along.y) > abs(along.x) ? 1 : 0;
    if (isSteep != 0) {
        along = along.yx;
        path.nearPixel = path.nearPixel.yx;
        path.farPixel = path.farPixel.yx;
    }
    pathPixels = vec4(path.nearPixel, path.farPixel);
    pathEnds = vec4(path.nearNearness, path.farNearness, path.nearT, path.farT);
    pathDirection = photon.directionVs;
    pathExtinction = extinctionAround(photon.media);
    float pixel = view.frustum.w;
    pathPower = photon.fluxWatts * view.mediumScattering.rgb *
               ((path.farT - path.nearT) * path.nearNearness * path.farNearness / (pixel * pixel));
    // A line of less than a pixel has no direction on the screen.
    float slope = abs(along.x) > 1.0 ? along.y / along.x : 0.0;
    pathWidth = vec2(photon.footprintMeters, sqrt(1.0 + slope * slope));

    bool isEnd = (gl_VertexID & 1) == 1;
    float side = gl_VertexID < 2 ? -1.0 : 1.0;
    // A pixel's middle is half a pixel at most from what it holds along the line, and so much more
    // across as the line rises; the rest is for the rasteriser's rounding.
    const float rounding = 0.05;
    float forward = along.x < 0.0 ? -1.0 : 1.0;
    float beyond = (0.5 + rounding) * (isEnd ? forward : -forward);
    float nearest = max(path.nearNearness, path.farNearness);
    float wanted = wantedWidth(photon.footprintMeters, nearest);
    if (gl_VertexID == 0 && wanted > float(media_lines_maximum)) {
        atomicAdd(narrowed.count, 1u);
        atomicMax(narrowed.widestBits, floatBitsToUint(wanted));
    }
    float reach = halfWidth(photon.footprintMeters, nearest) * pathWidth.y + 1.0 + rounding;
    if (slope == 0.0) reach += abs(along.y);
    vec2 corner = isEnd ? path.farPixel : path.nearPixel;
    corner += vec2(beyond, beyond * slope + side * reach);
    if (isSteep != 0) corner = corner.yx;
    gl_Position = vec4(corner * view.sizePixels.zw * 2.0 - 1.0, 0.0, 1.0);
}
