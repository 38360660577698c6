// SPDX-License-Identifier: MIT
// What a light sends through a texel of its view onto the specular surface that it sees there first:
// by the texel's area (directional) or its solid angle (cos³), less what a body around the light
// absorbs. Receivers get nothing of it, and hide what is behind them.
#include "include/photons/lights.glsl"
#include "include/surfaces/scene_fragment.glsl"
#include "include/surfaces/surface_data.glsl"

uniform mat4 lightToEye;
uniform int lightIndex;
uniform vec2 texelSize;  // m, or at 1 m before the light

layout(location = 0) out float emittable;  // W, all channels together

vec3 fluxThroughTexel() {
    LightData light = lights[lightIndex];
    float area = texelSize.x * texelSize.y;
    if (uint(light.positionVs.w) == kLightDirectional) return light.power.rgb * area;
    float distance = length(positionVs);
    float cosine = -positionVs.z / distance;
    vec3 there = (lightToEye * vec4(positionVs, 1.0)).xyz;
    bool isWithin = materialKind(material) == kMaterialDielectric && !gl_FrontFacing;
    return lightIntensity(light, there, max(texelSize.x, texelSize.y)) *
           (area * cosine * cosine * cosine) *
           mediumTransmittance(isWithin ? material + 1u : 0u, distance);
}

void main() {
    vec3 flux = isReceiver(materialKind(material)) ? vec3(0.0) : fluxThroughTexel();
    emittable = flux.r + flux.g + flux.b;
}
