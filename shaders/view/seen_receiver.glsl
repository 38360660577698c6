// SPDX-License-Identifier: MIT
// What a receiver sends back along the last piece of a path of the eye: from the picture, caustics
// and all, where that shows it; else it is lit here, with the lights' own shadows. Whoever includes
// this has defined `Seen`, with vec3 positionVs, shading and geometric (unit, outward) and uint
// material (index + 1), and says what the two functions are.
#include "include/surfaces/albedo.glsl"
#include "include/views/shown_radiance.glsl"

// Over what the pixel covers there.
vec3 albedoOfSeen(Seen seen);
// Whether anything lies between the receiver and a light. `toLight`: unit.
bool isShadowed(Seen seen, int light, vec3 toLight);

ivec2 pixelNow = ivec2(0);  // whose path it is

// For a path whose last piece does not begin under water.
const float kNotUnderWater = 3.4e38;

// Of a receiver that the picture does not show, back along the ray.
vec3 radianceOfHidden(Seen seen, vec3 direction) {
    bool isFront = dot(direction, seen.geometric) < 0.0;
    // A sheet is lit on the side that is looked at.
    float side = !isFront && isOpen(seen.material - 1u) ? -1.0 : 1.0;
    vec3 normal = side * seen.shading;
    vec3 albedo = albedoOfSeen(seen);
    vec4 lobe = materials[seen.material - 1u].specular;
    vec3 sum = (albedo + lobe.rgb) * (1.0 / 3.14159265) * view.ambient.rgb;
    if (isFront) sum += materials[seen.material - 1u].emission.rgb;
    for (int i = 0; i < lightCount; ++i) {
        LightData light = lights[i];
        vec3 toLight = -lightDirection(light, seen.positionVs);
        float cosine = dot(normal, toLight);
        if (cosine <= 0.0 || side * dot(seen.geometric, toLight) <= 0.0) continue;
        if (isShadowed(seen, i, toLight)) continue;
        sum += lightIrradiance(light, seen.positionVs) * cosine *
               receiverBrdf(albedo, lobe.rgb, lobe.w, normal, toLight, -direction);
    }
    return sum;
}

// `depthUnderWater`: view depth where the last piece begins, m, or kNotUnderWater.
vec3 radianceOfReceiver(Seen seen, vec3 direction, float depthUnderWater) {
    vec3 there = seen.positionVs;
    ivec2 texel = ivec2(floor(pixelOf(there)));
    ivec2 last = ivec2(view.sizePixels.xy) - 1;
    bool isOnScreen = there.z < -view.frustum.z && all(greaterThanEqual(texel, ivec2(0))) &&
                      all(lessThanEqual(texel, last));
    // The picture shows one side of a surface.
    bool isSameSide = dot(direction, seen.geometric) < 0.0 == dot(there, seen.geometric) < 0.0;
    vec3 shown;
    if (isOnScreen && isSameSide && radianceAround(there, seen.geometric, shown)) {
#ifdef GLOSSY_RECEIVERS
        shown += lobeRadiance(there, direction, texel, seen.shading, seen.material);
#endif
        return max(shown, vec3(0.0));
    }
    // Under water nearly all light is caustic, which hidden receivers lack: it is taken to be that of
    // the receiver straight beyond the surface, as by the searches on the screen (scene_look.glsl).
    if (texelFetch(receiver, pixelNow, 0).x > depthUnderWater)
        return texelFetch(receiverRadiance, pixelNow, 0).rgb;
    return radianceOfHidden(seen, direction);
}
