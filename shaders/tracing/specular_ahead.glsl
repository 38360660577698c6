// SPDX-License-Identifier: MIT
// For tracers that find receivers alone: the specular surface that stops a photon before it gets to
// one (techniques/tracing/specular_ahead.h). Whoever includes this includes deliver.glsl.
#ifdef SPECULAR_AHEAD
uniform sampler2D aheadSurface;   // xyz: shading normal; w: material + 1, 0 nothing
uniform sampler2D aheadTriangle;  // xyz: the triangle's normal; w: distance, m
#ifdef PHOTON_BEAMS
uniform sampler2D aheadShape;
#endif
#endif

// Whether the photon at this texel of its list is stopped within a distance, m.
bool isStopped(ivec2 texel, float within) {
#ifdef SPECULAR_AHEAD
    return texelFetch(aheadSurface, texel, 0).w > 0.0 && texelFetch(aheadTriangle, texel, 0).w < within;
#else
    return false;
#endif
}

// Where it is.
Hit stoppedHit(Photon photon, ivec2 texel) {
    Hit hit = emptyHit();
#ifdef SPECULAR_AHEAD
    vec4 surface = texelFetch(aheadSurface, texel, 0);
    vec4 triangle = texelFetch(aheadTriangle, texel, 0);
    hit = deliverTo(photon, triangle.w, surface.xyz, triangle.xyz, uint(surface.w));
#ifdef PHOTON_BEAMS
    hit.shape = texelFetch(aheadShape, texel, 0).xyz;
#endif
#endif
    return hit;
}
