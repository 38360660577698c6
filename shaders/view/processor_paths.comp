// SPDX-License-Identifier: MIT
// view.bvh, where the processor follows the eye's paths (techniques/view/traced_paths.h): what
// their ends send to the eye, as in bvh.comp. One thread a pixel.
#include "include/surfaces/environment.glsl"
#include "include/surfaces/surface_data.glsl"
#include "include/thread.glsl"
#include "view/bvh_pixels.glsl"

uniform samplerBuffer pathsOfPixels;  // PathsOfPixel, three texels
uniform samplerBuffer pathEnds;       // PathEnd, six texels
uniform usamplerBuffer litEnds;       // `litWords` an end, a bit a light
uniform int litWords;
uniform uint firstPixel;  // of the list's, that are drawn now
uniform uint pixelCount;

struct Seen {
    vec3 positionVs;
    vec3 shading;
    vec3 geometric;
    uint material;
    vec2 uv;
    float uvOfPixel;
    int end;  // of the path, its number
};
#include "view/seen_receiver.glsl"

vec3 albedoOfSeen(Seen seen) {
    return albedoOver(seen.material - 1u, seen.uv, vec2(seen.uvOfPixel, 0.0),
                      vec2(0.0, seen.uvOfPixel));
}

bool isShadowed(Seen seen, int light, vec3 toLight) {
    uint word = texelFetch(litEnds, seen.end * litWords + light / 32).x;
    return (word >> uint(light % 32) & 1u) == 0u;
}

vec3 radianceAtEnd(int end) {
    vec4 place = texelFetch(pathEnds, 6 * end);
    vec4 direction = texelFetch(pathEnds, 6 * end + 1);
    vec4 share = texelFetch(pathEnds, 6 * end + 2);
    vec4 shading = texelFetch(pathEnds, 6 * end + 3);
    vec4 geometric = texelFetch(pathEnds, 6 * end + 4);
    float uvOfPixel = texelFetch(pathEnds, 6 * end + 5).x;
    uint material = uint(place.w);
    if (material == 0u) {
        return share.rgb * environmentRadiance(direction.xyz) *
               mediumTransmittance(uint(direction.w), 1e30);
    }
    Seen seen = Seen(place.xyz, shading.xyz, geometric.xyz, material, vec2(shading.w, geometric.w),
                     uvOfPixel, end);
    return share.rgb * radianceOfReceiver(seen, direction.xyz, share.w);
}

void main() {
    uint index = threadNumber();
    if (index >= pixelCount) return;
    pixelNow = listedPixel(firstPixel + index);
    int texel = 3 * int(index);
    storeExit(pixelNow, texelFetch(pathsOfPixels, texel), texelFetch(pathsOfPixels, texel + 1));
    vec4 ends = texelFetch(pathsOfPixels, texel + 2);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < int(ends.y); ++i)
        sum += radianceAtEnd(int(ends.x) + i);
    storeRadiance(pixelNow, vec4(sum, 1.0));
}
