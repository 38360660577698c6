// SPDX-License-Identifier: MIT
// A photon's splat in the receiver's tangent plane, seen through each pixel (K06, section 3.1,
// Eq. 1 with D = N·C). The weight falls with the distance: from the centre, as in the paper, or
// from the photon's path, so that light that grazes a wall leaves no gaps between its splats.
#include "include/views/seen_receiver.glsl"

struct Sprite {
    vec3 center;
    vec3 normal;
    vec3 direction;  // of the photon
    float radius;    // m
#ifdef BEAM_SPLATS
    mat2x3 tangents;  // of the receiver's plane
    mat2 metric;      // in them: what maps the splat to the unit disc, squared, 1/m²
    vec2 pixels;      // half the sides of the rectangle around it, px
#endif
};

// A beam that grazes is taken as if it came at this sine at least, which bounds its splat.
const float kMinSlant = 0.1;

// The photon's direction, turned away from the surface where it would graze too much.
vec3 boundedDirection(vec3 direction, vec3 normal) {
    float slant = dot(direction, normal);
    if (abs(slant) >= kMinSlant) return direction;
    vec3 along = direction - slant * normal;
    float size = max(length(along), 1e-12);
    return (slant < 0.0 ? -1.0 : 1.0) * kMinSlant * normal +
           along * (sqrt(1.0 - kMinSlant * kMinSlant) / size);
}

// Weight at a share of the radius, [0, 1); normalised elsewhere, by its sum over the pixels.
float splatKernel(float share) {
    if (reconstruct_sprites_kernel == reconstruct_sprites_kernel_linear) return 1.0 - share;
    if (reconstruct_sprites_kernel == reconstruct_sprites_kernel_epanechnikov) {
        return 1.0 - share * share;
    }
    return exp(-4.5 * share * share);
}

float splatDistance(Sprite sprite, vec3 offset) {
#ifdef BEAM_SPLATS
    vec2 along = offset * sprite.tangents;
    return sprite.radius * sqrt(max(dot(along, sprite.metric * along), 0.0));
#endif
    if (reconstruct_sprites_shape == reconstruct_sprites_shape_disc) return length(offset);
    if (reconstruct_sprites_shape == reconstruct_sprites_shape_screen) {
        // At right angles to the view's axis, at the centre's depth, whatever the receiver does.
        vec3 point = sprite.center + offset;
#ifdef ORTHOGRAPHIC_VIEW
        return length(offset.xy);
#endif
        return length(point.xy * (sprite.center.z / min(point.z, -1e-20)) - sprite.center.xy);
    }
    return length(cross(offset, boundedDirection(sprite.direction, sprite.normal)));
}

// The farthest that the splat reaches from its centre, m.
float splatExtent(Sprite sprite) {
    if (reconstruct_sprites_shape != reconstruct_sprites_shape_beam) return sprite.radius;
    return sprite.radius / max(abs(dot(sprite.direction, sprite.normal)), kMinSlant);
}

struct SpritePixel {
    float weight;
    float area;  // m², of the surface or, where it is not seen, of the plane
    int where;
};

SpritePixel spriteAt(Sprite sprite, ivec2 pixel) {
    SpritePixel result = SpritePixel(0.0, 0.0, kSeenOutside);
    vec3 ray = viewRay(vec2(pixel) + 0.5);
    float facing = dot(sprite.normal, ray);
    if (abs(facing) < 1e-5) return result;
    float depth = depthOnPlane(vec2(pixel) + 0.5, sprite.normal, sprite.center, facing);
    if (!(depth > view.frustum.z)) return result;
    // On a slanted surface a splat is thinner than a pixel and may fall between the middles of all:
    // it reaches a pixel's width far on the screen whatever it covers on the surface, so that some
    // pixel always gets the flux (hard case 31); but only pixels that see the surface there, as the
    // splat itself ends before.
    vec3 offset = viewPoint(vec2(pixel) + 0.5, depth) - sprite.center;
    float own = splatDistance(sprite, offset) / sprite.radius;
#ifdef BEAM_SPLATS
    float share = own;  // no splat is narrower than a pixel
#else
    float share = min(own, length(vec2(pixel) + 0.5 - pixelOf(sprite.center)));
#endif
    if (share >= 1.0) return result;
    bool isReached = own < 1.0;
    result.weight = splatKernel(share);
    result.area = pixelArea(ray, depth, sprite.normal);
    if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, ivec2(view.sizePixels.xy)))) {
        if (isReached) result.where = kSeenOffScreen;
        return result;
    }
    // Only visible receivers are lit. How far a curved surface may leave its tangent plane follows
    // from the disc, and never falls below what a pixel resolves.
    float tolerance = 0.5 * sprite.radius + pixelFootprint(depth);
    int where = seenAt(pixel, depth, sprite.normal, tolerance, result.area);
    // What lies in front of the part that only a pixel's width reaches hides none of it.
    if (where != kSeenOccluded || isReached) result.where = where;
    return result;
}

// Half the sides of the pixel rectangle around the centre's pixel that the splat can cover, px.
vec2 wholeReach(Sprite sprite) {
#ifdef BEAM_SPLATS
    return sprite.pixels;
#endif
    if (reconstruct_sprites_shape == reconstruct_sprites_shape_screen) {
        return vec2(ceil(sprite.radius / pixelFootprint(-sprite.center.z)) + 1.0);
    }
    vec3 along = vec3(0.0);
    if (reconstruct_sprites_shape == reconstruct_sprites_shape_beam) {
        vec3 direction = boundedDirection(sprite.direction, sprite.normal);
        along = direction - dot(direction, sprite.normal) * sprite.normal;
        float size = length(along);
        along = size > 1e-6 ? along / size : vec3(0.0);
    }
    // Half-extents of the ellipse along x and y: a disc of the radius, stretched along `along`.
    float stretch = splatExtent(sprite);
    vec3 across = cross(sprite.normal, along);
    bool isRound = along == vec3(0.0);
    vec3 n2 = sprite.normal * sprite.normal;
    vec3 extent = isRound ? sprite.radius * sqrt(max(1.0 - n2, 0.0))
                          : sqrt(stretch * stretch * along * along +
                                 sprite.radius * sprite.radius * across * across);
    // The nearest part of the ellipse is the largest on the screen; x and y shift with depth too.
    float centerDepth = -sprite.center.z;
    float depth = max(centerDepth - extent.z, 0.25 * centerDepth);
#ifdef ORTHOGRAPHIC_VIEW
    vec2 shift = vec2(0.0);
#else
    vec2 shift = abs(sprite.center.xy) / centerDepth * extent.z;
#endif
    return ceil((extent.xy + shift) / pixelFootprint(depth)) + 1.0;
}

uniform int maxReach;  // px

// A splat ends there however far perspective or grazing light stretch it: its cost is bounded. The
// weights are summed and drawn over the same pixels, so that no flux is lost.
ivec2 spriteReach(Sprite sprite) {
    return ivec2(min(wholeReach(sprite), vec2(maxReach)));
}

// Whether any pixel of the view may see the splat: a photon may arrive where none is near.
bool isBeforeView(Sprite sprite) {
    return -sprite.center.z > view.frustum.z;
}
bool isNearView(Sprite sprite) {
    if (!isBeforeView(sprite)) return false;
    vec2 outside = max(-pixelOf(sprite.center), pixelOf(sprite.center) - view.sizePixels.xy);
    return all(lessThanEqual(outside, vec2(spriteReach(sprite)) + 1.0));
}
