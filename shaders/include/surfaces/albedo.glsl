// SPDX-License-Identifier: MIT
// Reflectances of materials: colors, patterns and images.
#include "include/surfaces/scene_images.glsl"
#include "include/surfaces/surface_data.glsl"

// How much of a step that repeats every 1 is above `edge`, averaged over a filter of width `w`.
float filteredStep(float x, float edge, float w) {
    w = clamp(w, 1e-5, 1.0);
    float a = x - 0.5 * w;
    float b = x + 0.5 * w;
    float above = (floor(b) - floor(a)) * (1.0 - edge) + max(fract(b) - edge, 0.0) -
                  max(fract(a) - edge, 0.0);
    return clamp(above / w, 0.0, 1.0);
}

// Reflectance at `uv`, patterns box-filtered over what uv differs by along a pixel's sides.
vec3 albedoOver(uint material, vec2 uv, vec2 uvAlongX, vec2 uvAlongY) {
    MaterialData data = materials[material];
    vec2 p = uv * data.uv.xy;
    vec2 alongX = uvAlongX * data.uv.xy;
    vec2 alongY = uvAlongY * data.uv.xy;
    vec2 width = abs(alongX) + abs(alongY);
    vec3 albedo = data.albedo.rgb;
    uint pattern = uint(data.patternAlbedo.w);
    if (pattern == 1u) {
        vec2 on = vec2(filteredStep(0.5 * p.x, 0.5, 0.5 * width.x),
                       filteredStep(0.5 * p.y, 0.5, 0.5 * width.y));
        albedo = mix(albedo, data.patternAlbedo.rgb, on.x + on.y - 2.0 * on.x * on.y);
    } else if (pattern == 2u) {
        const float joint = 0.04;  // of a tile's side
        vec2 tile = vec2(filteredStep(p.x, joint, width.x), filteredStep(p.y, joint, width.y));
        albedo = mix(data.patternAlbedo.rgb, albedo, tile.x * tile.y);
    }
    if (data.uv.z >= 0.0) {
        albedo *= textureGrad(sceneImages, vec3(p, data.uv.z), alongX, alongY).rgb;
    }
    return albedo;
}
