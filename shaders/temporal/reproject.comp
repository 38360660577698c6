// SPDX-License-Identifier: MIT
// Blends each pixel's irradiance with what the frame before had where it saw the same place of the
// same receiver. Histories are arrays of two layers, of which one is read and the other written in
// turn. One thread a pixel.
#include "framework/transport/octahedral.h"
#include "include/views/view.glsl"
#include "techniques/temporal/reproject_views.h"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D receiver;
uniform sampler2D receiverSurface;
layout(std430) readonly buffer Views {
    PastViews views;
};
layout(rgba32f) uniform image2D irradiance;
layout(rgba32f) uniform image2DArray irradianceHistory;
// x: view depth of the receiver, m, 0 where there is nothing to use; yz: its normal in the view of
// then, octahedral; w: how many frames its irradiance is the mean of.
layout(rgba32f) uniform image2DArray seenHistory;
#ifdef HAS_RADIANCE
layout(rgba32f) uniform image2D radiance;
layout(rgba32f) uniform image2DArray radianceHistory;
#endif

// Normals that differ by more than 26 degrees are of two surfaces that meet in an edge, across
// which irradiance jumps.
const float kSameSurface = 0.9;

struct History {
    vec3 irradiance;
    vec3 radiance;
    float frames;  // 0: there is none
};

vec3 fromWorld(PastView past, vec3 direction) {
    return direction * mat3(past.viewToWorld);  // a rotation's inverse
}

// The place in the former view's space. The difference of the eyes' positions comes first: each may
// be far larger than what they differ by.
vec3 placeBefore(vec3 placeNow) {
    precise vec3 moved = views.now.eyeWholeMeters.xyz - views.before.eyeWholeMeters.xyz;
    precise vec3 rest = views.now.eyeRest.xyz - views.before.eyeRest.xyz;
    precise vec3 fromFormerEye = mat3(views.now.viewToWorld) * placeNow + (moved + rest);
    return fromWorld(views.before, fromFormerEye);
}

// Bilinear over those of the four nearest pixels of the frame before that saw this place's surface.
// Where some did not, the mean of the rest is that of a place next to this one: it stands for so many
// frames less, else it would be dragged along outlines.
History historyOf(vec3 placeNow, vec3 normalNow) {
    History history = History(vec3(0.0), vec3(0.0), 0.0);
    vec3 place = placeBefore(placeNow);
    float depth = -place.z;
    // Also where there was no frame before: then all is zero.
    if (!(depth > views.before.frustum.z)) return history;
    vec3 normal = fromWorld(views.before, mat3(views.now.viewToWorld) * normalNow);

    vec2 size = view.sizePixels.xy;
    vec2 pixel = (place.xy / (depth * views.before.frustum.xy) * 0.5 + 0.5) * size;
    // What the footprint of a pixel was there, m: so far from the receiver's tangent plane may lie
    // what is the same surface. Along the ray that is more the steeper it is seen.
    float footprint = views.before.frustum.w * depth;
    // A place that has not moved is looked up at the pixel's middle: what two rotations round must
    // not blur what stands still, a little more with every frame.
    float rounding = 2e-6 * length(place) / footprint;
    vec2 moved = pixel - (floor(pixel) + 0.5);
    if (all(lessThan(abs(moved), vec2(rounding)))) moved = vec2(0.0);
    vec2 corner = floor(pixel) + 0.5 + moved - 0.5;
    ivec2 first = ivec2(floor(corner));
    vec2 share = corner - floor(corner);

    int layer = int(views.turn.x);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        ivec2 texel = first + offset;
        vec2 shares = mix(1.0 - share, share, vec2(offset));
        float weight = shares.x * shares.y;
        if (weight == 0.0) continue;
        if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(size)))) continue;
        vec4 seen = imageLoad(seenHistory, ivec3(texel, layer));
        if (seen.x <= 0.0) continue;
        vec2 ndc = (vec2(texel) + 0.5) * view.sizePixels.zw * 2.0 - 1.0;
        vec3 seenPlace = vec3(ndc * views.before.frustum.xy, -1.0) * seen.x;
        if (abs(dot(normal, seenPlace - place)) > footprint) continue;
        if (dot(normal, unpackUnitVector(seen.yz)) < kSameSurface) continue;
        history.irradiance += weight * imageLoad(irradianceHistory, ivec3(texel, layer)).rgb;
#ifdef HAS_RADIANCE
        history.radiance += weight * imageLoad(radianceHistory, ivec3(texel, layer)).rgb;
#endif
        history.frames += weight * seen.w;
        weights += weight;
    }
    if (weights > 0.0) {
        history.irradiance /= weights;
        history.radiance /= weights;
    }
    return history;
}

bool isFinite(vec3 value) {
    return !any(isnan(value)) && !any(isinf(value));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(irradiance)))) return;
    ivec3 next = ivec3(pixel, 1 - int(views.turn.x));
    float depth = texelFetch(receiver, pixel, 0).x;
    vec3 irradianceNow = imageLoad(irradiance, pixel).rgb;
#ifdef HAS_RADIANCE
    vec3 radianceNow = imageLoad(radiance, pixel).rgb;
    bool isHistoryValid = isFinite(irradianceNow) && isFinite(radianceNow);
#else
    bool isHistoryValid = isFinite(irradianceNow);
#endif
    // What is no number is seen as it is, and in no later frame.
    if (depth <= 0.0 || !isHistoryValid) {
        imageStore(seenHistory, next, vec4(0.0));
        return;
    }
    vec3 normal = texelFetch(receiverSurface, pixel, 0).xyz;
    History history = historyOf(viewPoint(vec2(pixel) + 0.5, depth), normal);
    float frames = history.frames + 1.0;
    float weight = max(1.0 / frames, temporal_reproject_weight);
    irradianceNow = history.irradiance + weight * (irradianceNow - history.irradiance);
    imageStore(irradiance, pixel, vec4(irradianceNow, 0.0));
    imageStore(irradianceHistory, next, vec4(irradianceNow, 0.0));
#ifdef HAS_RADIANCE
    radianceNow = history.radiance + weight * (radianceNow - history.radiance);
    imageStore(radiance, pixel, vec4(radianceNow, 0.0));
    imageStore(radianceHistory, next, vec4(radianceNow, 0.0));
#endif
    // No more frames than the weight tells apart.
    float kept = min(frames, 1.0 / temporal_reproject_weight);
    imageStore(seenHistory, next, vec4(depth, packUnitVector(normal), kept));
}
