// SPDX-License-Identifier: MIT
// A photon's splat: a disc in the receiver's tangent plane, seen through each pixel (K06, section
// 3.1, Eq. 1 with D = N·C). The weight falls linearly from the centre to the radius.
#include "common/transfer_map.glsl"
#include "common/view.glsl"

uniform sampler2D receiver;         // view depth and area of the surface that each pixel sees
uniform sampler2D receiverSurface;

struct Sprite {
    vec3 center;
    vec3 normal;
    float radius;  // m
};

const int kSpriteOn = 0;        // the pixel sees the plane
const int kSpriteOccluded = 1;  // something nearer is in front of it
const int kSpriteBeside = 2;    // the surface has ended before; or the disc does not reach
const int kSpriteOffScreen = 3;

struct SpritePixel {
    float weight;
    float area;  // m², of the surface or, where it is not seen, of the plane
    int where;
};

SpritePixel spriteAt(Sprite sprite, ivec2 pixel) {
    SpritePixel result = SpritePixel(0.0, 0.0, kSpriteBeside);
    vec3 ray = viewRay(vec2(pixel) + 0.5);
    float facing = dot(sprite.normal, ray);
    if (abs(facing) < 1e-5) return result;
    float depth = dot(sprite.normal, sprite.center) / facing;
    if (!(depth > view.tangents.z)) return result;
    float distance = length(depth * ray - sprite.center);
    if (distance >= sprite.radius) return result;
    result.weight = 1.0 - distance / sprite.radius;
    result.area = pixelArea(ray, depth, sprite.normal);
    if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, ivec2(view.sizePixels.xy)))) {
        result.where = kSpriteOffScreen;
        return result;
    }
    vec2 seen = texelFetch(receiver, pixel, 0).xy;
    // Only visible receivers are lit. How far a curved surface may leave its tangent plane follows
    // from the disc, and never falls below what a pixel resolves.
    float tolerance = 0.5 * sprite.radius + pixelFootprint(depth);
    bool facesAway = dot(texelFetch(receiverSurface, pixel, 0).xyz, sprite.normal) <= 0.0;
    if (seen.x <= 0.0 || seen.x > depth + tolerance || facesAway) {
        bool hidden = seen.x > 0.0 && seen.x < depth - tolerance;
        result.where = hidden ? kSpriteOccluded : kSpriteBeside;
    } else if (seen.x < depth - tolerance) {
        result.where = kSpriteOccluded;
    } else {
        result.area = seen.y;
        result.where = kSpriteOn;
    }
    return result;
}

// The pixels that a disc can cover: a square around its centre's pixel.
int spriteReach(Sprite sprite) {
    float depth = max(-sprite.center.z - sprite.radius, 0.25 * -sprite.center.z);
    return int(ceil(sprite.radius / pixelFootprint(depth))) + 1;
}
