// SPDX-License-Identifier: MIT
// Lights in the eye's view space; units as in LightData.
#include "include/surfaces/scene_images.glsl"
#include "framework/transport/types.h"

layout(std430) readonly buffer Lights {
    LightData lights[];
};

// Unit, from the light towards the point.
vec3 lightDirection(LightData light, vec3 positionVs) {
    if (uint(light.positionVs.w) == kLightDirectional) return light.directionVs.xyz;
    vec3 offset = positionVs - light.positionVs.xyz;
    float distance2 = dot(offset, offset);
    return distance2 > 0.0 ? offset * inversesqrt(distance2) : light.directionVs.xyz;
}

// What a spot's image makes of its intensity in `direction`, within the outer cone:
// spotImagePosition of scene/scene.h, averaged over about a square of the side `width` in the plane
// at 1 m.
vec3 spotColor(LightData light, vec3 direction, float width) {
    if (light.rightVs.w < 0.0) return vec3(1.0);
    float edge = light.cone.z;
    vec2 across = vec2(dot(direction, light.rightVs.xyz), dot(direction, light.upVs.xyz));
    vec2 at = 0.5 + 0.5 * across / (dot(direction, light.directionVs.xyz) * edge);
    float side = float(textureSize(sceneImages, 0).x);
    float level = log2(max(0.5 * width * side / edge, 1.0));
    // The array repeats its images; a light's ends at its edge.
    float margin = min(0.5 * exp2(ceil(level)) / side, 0.5);
    at = clamp(at, margin, 1.0 - margin);
    return textureLod(sceneImages, vec3(at, light.rightVs.w), level).rgb;
}

// Radiant intensity of a light that is no directional one towards the point, W/sr. The cone's edge is the smooth
// falloff of KHR_lights_punctual, squared, as scene files have it; beyond the range there is none.
// `beamWidth`: at 1 m, over which a spot's image is averaged.
vec3 lightIntensity(LightData light, vec3 positionVs, float beamWidth) {
    vec3 offset = positionVs - light.positionVs.xyz;
    float distance2 = dot(offset, offset);
    float range = light.directionVs.w;
    if (range > 0.0 && distance2 > range * range) return vec3(0.0);
    vec3 direction = lightDirection(light, positionVs);
    if (uint(light.positionVs.w) == kLightSurface)
        return light.power.rgb * max(dot(direction, light.directionVs.xyz), 0.0);
    if (uint(light.positionVs.w) != kLightSpot) return light.power.rgb;
    float cosine = dot(direction, light.directionVs.xyz);
    if (cosine <= light.cone.y) return vec3(0.0);
    float falloff =
        cosine >= light.cone.x ? 1.0 : (cosine - light.cone.y) / (light.cone.x - light.cone.y);
    return light.power.rgb * spotColor(light, direction, beamWidth) * falloff * falloff;
}

// Irradiance at the point on a surface that faces the light, W/m².
vec3 lightIrradiance(LightData light, vec3 positionVs) {
    if (uint(light.positionVs.w) == kLightDirectional) return light.power.rgb;
    vec3 offset = positionVs - light.positionVs.xyz;
    return lightIntensity(light, positionVs, 0.0) / max(dot(offset, offset), 1e-12);
}
