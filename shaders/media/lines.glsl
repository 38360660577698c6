// SPDX-License-Identifier: MIT
// The path of a photon through the medium as a line on the screen: a RaySegment whose ends are the
// photon's, in pixels that may lie a little next to the screen, so that a wide line is whole there.
#include "include/photons/medium.glsl"
#include "include/views/ray_segment.glsl"

// The path up to `end` m, as far as it is inside of the medium, beyond the near plane and within so
// many pixels of the screen.
RaySegment clipPath(vec3 origin, vec3 direction, float end, float marginPixels) {
    RaySegment path;
    float low = 0.0;
    float high = min(end, boundsInterval(origin, direction).y);
    cutToNearPlane(origin, direction, low, high);
    vec2 tangents = view.frustum.xy * (1.0 + 2.0 * marginPixels * view.sizePixels.zw);
    cutToScreen(origin, direction, tangents, low, high);
    path.visible = low < high;
    if (path.visible) setEnds(path, origin, direction, low, high);
    return path;
}

// The line's width across it, px, where the path is at this 1/depth, as far as nothing keeps it
// from that. A footprint's width goes with 1/depth, so it is linear along the line as 1/depth is.
float wantedWidth(float footprintMeters, float inverseZ) {
    if (media_lines_width > 0.0) return media_lines_width;
    return media_lines_footprints * footprintMeters * inverseZ / view.frustum.w;
}
float halfWidth(float footprintMeters, float inverseZ) {
    return 0.5 * clamp(wantedWidth(footprintMeters, inverseZ), 1.0, float(media_lines_maximum));
}
