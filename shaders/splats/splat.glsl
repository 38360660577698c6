// SPDX-License-Identifier: MIT
// The splat of a photon of a list, as both passes over its pixels make it.
#include "include/photons/hits.glsl"
#include "include/photons/photon_thread.glsl"
#include "splats/sprite.glsl"

// Metres that a pixel covers where a splat lies; the same in all faces of a cube, as in its own.
float splatFootprint(vec3 center) {
#ifdef MANY_VIEWS
    vec3 there = abs(center);
    return pixelFootprint(max(max(there.x, there.y), there.z));
#else
    return pixelFootprint(-center.z);
#endif
}

#ifdef BEAM_SPLATS
#include "splats/beam_splat.glsl"
#else
// Where a photon has arrived; `wanted`: the radius that it asks for, m, and `largest` the one that
// it may have.
Sprite splatOf(ivec2 texel, out float wanted, out float largest) {
    Sprite sprite;
    sprite.center = pointFromEye(texelFetch(hitPosition, texel, 0).xyz);
    sprite.normal = directionFromEye(texelFetch(hitSurface, texel, 0).xyz);
    sprite.direction = directionFromEye(texelFetch(photonDirection, texel, 0).xyz);
    wanted = reconstruct_sprites_radius > 0.0
                 ? reconstruct_sprites_radius
                 : reconstruct_sprites_footprints * texelFetch(photonPosition, texel, 0).w;
    float pixel = splatFootprint(sprite.center);
    largest = float(reconstruct_sprites_maximum) * pixel;
    sprite.radius = clamp(wanted, pixel, largest);
    return sprite;
}
#endif
