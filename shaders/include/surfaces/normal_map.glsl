// SPDX-License-Identifier: MIT
// Normal maps of dielectrics and mirrors, in a scene that has any (NORMAL_MAPS). Texels are read one
// by one: filters of textures have 256 places between two of them, and a caustic shows each.
#include "include/surfaces/scene_images.glsl"
#include "include/surfaces/surface_data.glsl"
#include "framework/transport/normal_map.h"

#ifdef NORMAL_MAPS
bool hasNormalMap(uint material) { return materials[material].normalMap.x >= 0.0; }

// Texels of it that a step of uv crosses.
vec2 normalTexels(uint material, vec2 uvStep) {
    return uvStep * materials[material].uv.xy * vec2(textureSize(sceneImages, 0).xy);
}

// The map's vector at a place, of any length.
vec3 normalOfMap(uint material, vec2 uv) {
    MaterialData data = materials[material];
    ivec2 size = textureSize(sceneImages, 0).xy;
    vec2 at = fract(uv * data.uv.xy) * vec2(size) - 0.5;
    ivec2 low = ivec2(floor(at));
    vec2 part = at - vec2(low);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        vec2 weight = mix(1.0 - part, part, vec2(corner));
        ivec2 texel = (low + corner + size) % size;
        sum += weight.x * weight.y *
               texelFetch(sceneImages, ivec3(texel, int(data.normalMap.x)), 0).xyz;
    }
    return vec3(sum.xy * data.normalMap.y, sum.z);
}

// `normal`: unit, of the surface without a map; `steps` along the triangle, m, and what uv grows by.
vec3 mappedNormalAt(uint material, vec3 normal, mat2x3 steps, mat2 uvSteps, vec2 uv) {
    return mappedNormal(normal, steps[0], steps[1], uvSteps[0], uvSteps[1],
                        normalOfMap(material, uv));
}
#endif
