// SPDX-License-Identifier: MIT
// Share of one light that reaches each receiver past the surfaces of its shadow map: at the pixel's
// middle, or over the pixel where that is more than twice as wide on the map as one look at it.
#include "include/views/light_shadow.glsl"
#include "include/views/view.glsl"

layout(location = 0) out vec4 visibility;

uniform sampler2D receiver;
uniform sampler2D receiverSurface;
uniform int lightIndex;

// Most looks along each side of a pixel.
const int kMaxSamples = 3;

// Whether the receiver is a plane as far as the pixels next to this one. At edges and where it is
// curved, points on its tangent plane would lie off it, in light or in shadow of their own.
bool isPlane(ivec2 pixel, vec3 positionVs, vec3 normalVs) {
    float maximum = 0.05 * pixelFootprint(-positionVs.z);
    for (int i = 0; i < 4; ++i) {
        ivec2 step = (i & 1) == 0 ? ivec2(i - 1, 0) : ivec2(0, i - 2);
        ivec2 other = clamp(pixel + step, ivec2(0), ivec2(view.sizePixels.xy) - 1);
        vec3 neighbour = viewRay(vec2(other) + 0.5) * texelFetch(receiver, other, 0).x;
        if (abs(dot(normalVs, neighbour - positionVs)) > maximum) return false;
    }
    return true;
}

// What is seen of the receiver's plane `offset` pixels next to this one's middle; the eye sees the
// pixels around of it too, so that it is not edge-on.
vec3 sampleOnPlane(vec2 offset, vec3 positionVs, vec3 normalVs) {
    vec3 ray = viewRay(gl_FragCoord.xy + offset);
    return ray * (dot(normalVs, positionVs) / dot(normalVs, ray));
}

// How many looks along a side of the pixel cover it on the map. One does up to twice its width: of
// the shadow at the pixel's middle it says more than their mean.
int looksAcross(ShadowPlace middle, ivec2 layers, vec3 positionVs, vec3 normalVs) {
    float texels = 0.0;
    for (int axis = 0; axis < 2; ++axis) {
        ShadowPlace edge = shadowPlaceOf(
            sampleOnPlane(0.5 * vec2(1 - axis, axis), positionVs, normalVs), layers);
        // On another face: as on this one, for all that the number of looks depends on.
        if (edge.layer == middle.layer) texels = max(texels, 2.0 * distance(edge.at, middle.at));
    }
    if (texels < 2.0 * kShadowFilterWidth) return 1;
    return min(int(ceil(texels / kShadowFilterWidth)), kMaxSamples);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    visibility = vec4(0.0);
    float depth = texelFetch(receiver, pixel, 0).x;
    if (depth <= 0.0) return;
    vec3 positionVs = viewRay(gl_FragCoord.xy) * depth;
    vec3 normal = texelFetch(receiverSurface, pixel, 0).xyz;
    ivec2 layers = shadowLayersOf(lightIndex);
    ShadowPlace middle = shadowPlaceOf(positionVs, layers);
    int looks =
        isPlane(pixel, positionVs, normal) ? looksAcross(middle, layers, positionVs, normal) : 1;
    float sum = 0.0;
    for (int i = 0; i < looks * looks; ++i) {
        vec2 offset = (vec2(i % looks, i / looks) + 0.5) / float(looks) - 0.5;
        ShadowPlace place =
            looks == 1 ? middle
                       : shadowPlaceOf(sampleOnPlane(offset, positionVs, normal), layers);
        sum += visibleShare(place, normal);
    }
    visibility = vec4(sum / float(looks * looks));
}
