// SPDX-License-Identifier: MIT
// Puts one layer of one object into the picture's layers, in order of depth; what falls off the
// last one is counted where all fragments are. Of surfaces at the same depth the object drawn first
// stays alone, as in layers.peel (hard case 12). One thread a pixel.
layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f) uniform image2DArray layerDepths;
layout(rgba32f) uniform image2DArray layerSurfaces;
uniform sampler2DArray objectDepths;
uniform sampler2D objectSurface;
layout(std430) readonly buffer Complexities {
    uint complexities[];
};
uniform int object;
uniform int layer;
uniform int layerCount;
uniform ivec2 firstPixel;
uniform ivec2 endPixel;

void main() {
    ivec2 pixel = firstPixel + ivec2(gl_GlobalInvocationID.xy);
    if (uint(layer) >= complexities[object]) return;
    if (any(greaterThanEqual(pixel, endPixel))) return;
    vec4 depth = texelFetch(objectDepths, ivec3(pixel, layer % 2), 0);
    if (depth.x <= 0.0) return;
    vec4 surface = texelFetch(objectSurface, pixel, 0);
    for (int i = 0; i < layerCount; ++i) {
        vec4 there = imageLoad(layerDepths, ivec3(pixel, i));
        if (there.x == depth.x) return;
        if (there.x > 0.0 && there.x < depth.x) continue;
        vec4 thereSurface = imageLoad(layerSurfaces, ivec3(pixel, i));
        imageStore(layerDepths, ivec3(pixel, i), depth);
        imageStore(layerSurfaces, ivec3(pixel, i), surface);
        if (there.x <= 0.0) return;
        depth = there;
        surface = thereSurface;
    }
}
