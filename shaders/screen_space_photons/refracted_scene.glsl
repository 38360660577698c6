// SPDX-License-Identifier: MIT
// What a ray that has left the specular surfaces sees (K06, section 4, Fig. 10): the receivers of
// the eye buffer, where its image shows them, and else what surrounds the scene. "This is an
// approximation that can only simulate the refraction of [...] objects that are visible to the
// viewer in the absence of the water surface": of what lies hidden or off the screen nothing is
// known.
#include "common/ray_segment.glsl"
#include "common/surface_data.glsl"
#include "common/surroundings.glsl"

layout(location = 0) out vec4 radiance;
layout(location = 1) out vec4 exitPosition;
layout(location = 2) out vec4 exitDirection;

uniform sampler2D interfaceDepth;
uniform sampler2D interfaceSurface;
uniform sampler2D receiver;
uniform sampler2D receiverSurface;
uniform sampler2D receiverRadiance;
uniform int looksIntoScene;  // else only at what surrounds the scene
uniform int mirrorsScene;    // the same for reflections at the first interface
uniform int lookStride;      // px

struct SceneHit {
    bool isFound;
    bool isOpen;  // not found, because nothing is there: the ray leaves the scene on the screen
    float t;      // m; not found: to where the screen or the scene ends
    ivec2 lastPixel;  // not found: of that end
    vec3 radiance;
};

SceneHit nothingThere() {
    return SceneHit(false, true, 0.0, ivec2(-1), vec3(0.0));
}

// The receiver's tangent plane at a pixel, where a ray crosses it: the ray parameter, or -1.
float crossReceiver(vec3 origin, vec3 direction, ivec2 texel, float depth) {
    vec3 normal = texelFetch(receiverSurface, texel, 0).xyz;
    float closing = dot(normal, direction);
    if (abs(closing) < 1e-6) return -1.0;
    return dot(normal, viewRay(vec2(texel) + 0.5) * depth - origin) / closing;
}

// Bilinear between those of the four pixels around the hit that lie on the hit's tangent plane.
vec3 radianceAround(vec3 hitVs, ivec2 texel) {
    vec3 normal = texelFetch(receiverSurface, texel, 0).xyz;
    vec2 corner = pixelOf(hitVs) - 0.5;
    ivec2 first = ivec2(floor(corner));
    vec2 f = corner - vec2(first);
    float reach = 2.0 * pixelFootprint(-hitVs.z);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        ivec2 other = clamp(first + step, ivec2(0), ivec2(view.sizePixels.xy) - 1);
        float depth = texelFetch(receiver, other, 0).x;
        if (depth <= 0.0) continue;
        if (abs(dot(normal, viewRay(vec2(other) + 0.5) * depth - hitVs)) > reach) continue;
        vec2 axis = mix(1.0 - f, f, vec2(step));
        sum += axis.x * axis.y * texelFetch(receiverRadiance, other, 0).rgb;
        weights += axis.x * axis.y;
    }
    return weights > 1e-3 ? sum / weights : texelFetch(receiverRadiance, texel, 0).rgb;
}

// Looks for the first receiver: by the ray's depth at the end of each step, since the last one ends
// just behind the scene's last surface. `lookStride` pixels are looked at together: where the
// ray is before the receivers at one look and behind them at the next, all pixels between are
// asked.
SceneHit searchReceivers(vec3 origin, vec3 direction) {
    SceneHit none = SceneHit(false, false, 0.0, ivec2(-1), vec3(0.0));
    RaySegment segment = clipRay(origin, direction);
    if (!segment.visible) return none;
    int n = stepCount(segment, 4, 16384);
    float count = float(n);
    bool isBefore = true;
    for (int look = 0; look < n; look += lookStride) {
        int last = min(look + lookStride, n) - 1;
        // At the stride's end, or one by one where the stride holds a change.
        ivec2 there = texelOfStep(segment, last, n);
        float depthThere = texelFetch(receiver, there, 0).x;
        float zThere = depthAtIndex(segment, float(last) + 1.0, count);
        bool isBeforeThere = depthThere <= 0.0 || zThere < depthThere;
        if (isBefore && !isBeforeThere) {
            for (int i = look; i <= last; ++i) {
                float middle = float(i) + 0.5;
                ivec2 texel = texelOfStep(segment, i, n);
                float depth = texelFetch(receiver, texel, 0).x;
                float z = depthAtIndex(segment, float(i) + 1.0, count);
                if (depth <= 0.0 || z < depth) continue;
                // Behind: through the surface, or past its edge.
                float t = crossReceiver(origin, direction, texel, depth);
                float from = parameterAtIndex(segment, max(middle - 1.5, 0.0), count);
                float to = parameterAtIndex(segment, min(middle + 1.5, count), count);
                if (t < from - 1e-5 * depth || t > to + 1e-5 * depth) continue;
                return SceneHit(true, false, t, texel,
                                radianceAround(origin + t * direction, texel));
            }
        }
        isBefore = isBeforeThere;
    }
    none.isOpen = isBefore && segment.cause == kAccountUnresolved;
    none.t = segment.farT;
    none.lastPixel =
        clamp(ivec2(floor(segment.farPixel)), ivec2(0), ivec2(view.sizePixels.xy) - 1);
    return none;
}

// What the ray that goes on sees, and the one that the first interface reflects.
SceneHit lookThrough(vec3 origin, vec3 direction) {
    return looksIntoScene != 0 ? searchReceivers(origin, direction) : nothingThere();
}
SceneHit lookIntoMirror(vec3 origin, vec3 direction) {
    return mirrorsScene != 0 ? searchReceivers(origin, direction) : nothingThere();
}

// Radiance along a ray that starts at `origin` within the medium `medium` (material index + 1) of
// an open surface, or 0, of which `seen` is known. Where nothing is known of what it meets: in
// water, which has no end to see, the receiver straight behind the surface at `pixel`, else the
// last one that the ray passes on the screen; in the open what surrounds the scene.
vec3 radianceAlong(vec3 origin, vec3 direction, uint medium, SceneHit seen, ivec2 pixel) {
    if (seen.isFound) return seen.radiance * mediumTransmittance(medium, seen.t);
    if (medium != 0u && !seen.isOpen) {
        float straight = texelFetch(receiver, pixel, 0).x;
        if (straight > -origin.z) {
            float behind = (straight + origin.z) * length(viewRay(vec2(pixel) + 0.5));
            return texelFetch(receiverRadiance, pixel, 0).rgb * mediumTransmittance(medium, behind);
        }
        if (seen.lastPixel.x >= 0 && texelFetch(receiver, seen.lastPixel, 0).x > 0.0) {
            return texelFetch(receiverRadiance, seen.lastPixel, 0).rgb *
                   mediumTransmittance(medium, seen.t);
        }
    }
    return surroundingRadiance(direction) * mediumTransmittance(medium, 1e30);
}

// The eye's ray at a mirror that it meets first: all outputs.
void writeMirror(ivec2 pixel, vec3 viewing, vec3 normal, vec3 reflectance) {
    vec3 origin = viewing * texelFetch(interfaceDepth, pixel, 0).x;
    vec3 reflected = normalize(reflect(normalize(viewing), normal));
    SceneHit seen = lookIntoMirror(origin, reflected);
    radiance = vec4(reflectance * radianceAlong(origin, reflected, 0u, seen, pixel), 1.0);
    exitPosition = vec4(origin, 1.0);
    exitDirection = vec4(reflected, kWayCameOut);
}
