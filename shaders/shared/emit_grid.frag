// SPDX-License-Identifier: MIT
// One photon a texel of the light's grid, where the first surface is specular: its flux is what the
// light sends through the texel, by its area (directional) or its solid angle (cos³; hard case
// 34a). An opaque surface nearer to the light leaves the texel empty.
#include "include/scene_fragment.glsl"
#include "include/surface.glsl"
#include "include/specular.glsl"
#include "include/lights.glsl"
#ifdef PHOTON_BEAMS
#include "include/beam.glsl"
#endif

layout(location = 0) out vec4 photonPosition;
layout(location = 1) out vec4 photonDirection;
layout(location = 2) out vec4 photonFlux;
layout(location = 3) out uvec4 photonOrigin;
layout(location = 4) out vec4 hitPosition;
layout(location = 5) out vec4 hitSurface;
layout(location = 6) out vec4 hitFlux;
#ifdef PHOTON_BEAMS
layout(location = 7) out vec4 hitShape;
#endif

uniform int lightIndex;
uniform vec2 halfExtent;    // m, or tangents of the half-angles
uniform vec2 gridSize;      // texels
uniform float gridBottom;   // first row of this light's part of the transfer map
uniform vec2 ownRows;       // of the transfer map, from and before

// Rows beside the batch's own are there to be joined with, and carry of their flux a share below
// what any sum resolves; a power of two, so that all ratios are the same.
const float kNextToNothing = exp2(-80.0);

void main() {
    LightData light = lights[lightIndex];
    vec2 texel = 2.0 * halfExtent / gridSize;
    vec3 direction = lightDirection(light, positionVs);
    vec3 flux;
    float footprint;
    if (uint(light.positionVs.w) == kLightDirectional) {
        flux = light.power.rgb * (texel.x * texel.y);
        footprint = sqrt(texel.x * texel.y);
    } else {
        vec2 inGrid = gl_FragCoord.xy - vec2(0.0, gridBottom);
        vec2 onPlane = (inGrid * 2.0 / gridSize - 1.0) * halfExtent;
        float cosine = inversesqrt(1.0 + dot(onPlane, onPlane));
        float solidAngle = texel.x * texel.y * cosine * cosine * cosine;
        float distance = length(positionVs - light.positionVs.xyz);
        flux = lightIntensity(light, positionVs, max(texel.x, texel.y)) * solidAngle;
        footprint = sqrt(solidAngle) * distance;
    }
    bool isPhoton = !isReceiver(materialKind(material)) && flux.r + flux.g + flux.b > 0.0;
    vec3 geometric = geometricNormal(positionVs, -direction);
    // A light whose rays first hit a dielectric from within is inside of it.
    bool isInside =
        materialKind(material) == kMaterialDielectric && dot(direction, geometric) > 0.0;
    uint media = isInside ? enterMedium(0u, material + 1u) : 0u;
    if (uint(light.positionVs.w) != kLightDirectional) {
        flux *= mediumTransmittance(innerMedium(media),
                                    length(positionVs - light.positionVs.xyz));
    }
    vec3 normal = bendingNormal(direction, shadingNormal(normalVs, geometric), geometric,
                                material + 1u, media);
    float fate = float(isPhoton ? kFateSpecular : kFateNone);
    vec4 on = vec4(isPhoton ? 1.0 : 0.0);
    if (gl_FragCoord.y < ownRows.x || gl_FragCoord.y > ownRows.y) flux *= kNextToNothing;
    photonPosition = vec4(positionVs, footprint) * on;
    photonDirection = vec4(direction * on.xyz, fate);
    photonFlux = vec4(flux, float(media)) * on;
    uint cell = uint(gl_FragCoord.y - gridBottom) * uint(gridSize.x) + uint(gl_FragCoord.x);
    photonOrigin = originTexel(PhotonOrigin(cell, uint(lightIndex), kEmittedPath, 0u));
    hitPosition = vec4(positionVs, 0.0) * on;
    hitSurface = vec4(normal, float(material + 1u)) * on;
    hitFlux = vec4(flux * on.xyz, fate);
#ifdef PHOTON_BEAMS
    // Of what was interpolated over the triangle, as the normals are.
    float size = max(length(normalVs), 1e-12);
    mat2x3 places = mat2x3(dFdx(positionVs), dFdy(positionVs));
    mat2x3 turns = mat2x3(dFdx(normalVs), dFdy(normalVs)) / size;
    hitShape = vec4(shapeFrom(normal, places, turns), 0.0) * on;
#endif
}
