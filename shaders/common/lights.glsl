// SPDX-License-Identifier: MIT
// Lights in the eye's view space; units as in LightData.
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

// Radiant intensity of a point or spot light towards the point, W/sr. The cone's edge is the smooth
// falloff of scene/scene_file.h (KHR_lights_punctual's, squared); beyond the range there is none.
vec3 lightIntensity(LightData light, vec3 positionVs) {
    vec3 offset = positionVs - light.positionVs.xyz;
    float distance2 = dot(offset, offset);
    float range = light.directionVs.w;
    if (range > 0.0 && distance2 > range * range) return vec3(0.0);
    if (uint(light.positionVs.w) != kLightSpot) return light.power.rgb;
    float cosine = dot(lightDirection(light, positionVs), light.directionVs.xyz);
    float width = max(light.cone.x - light.cone.y, 1e-4);
    float falloff = clamp((cosine - light.cone.y) / width, 0.0, 1.0);
    return light.power.rgb * falloff * falloff;
}

// Irradiance at the point on a surface that faces the light, W/m².
vec3 lightIrradiance(LightData light, vec3 positionVs) {
    if (uint(light.positionVs.w) == kLightDirectional) return light.power.rgb;
    vec3 offset = positionVs - light.positionVs.xyz;
    return lightIntensity(light, positionVs) / max(dot(offset, offset), 1e-12);
}
