// SPDX-License-Identifier: MIT
// view.maps: the receivers and the flux around one generator into arrays of all. One thread a texel.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2DArray mapReceiver;
uniform sampler2DArray mapSurface;
uniform sampler2DArray mapFlux;
layout(rg32f) writeonly uniform image2DArray allReceivers;
layout(rgba32f) writeonly uniform image2DArray allSurfaces;
layout(rgba32f) writeonly uniform image2DArray allFlux;
uniform int firstView;
uniform int setsPerView;

void main() {
    ivec3 size = textureSize(mapReceiver, 0);
    ivec2 id = ivec2(gl_GlobalInvocationID.xy);
    ivec3 from = ivec3(id.x, id.y % size.y, id.y / size.y);
    if (from.x >= size.x || from.z >= size.z) return;
    ivec3 to = from + ivec3(0, 0, firstView);
    imageStore(allReceivers, to, texelFetch(mapReceiver, from, 0));
    imageStore(allSurfaces, to, texelFetch(mapSurface, from, 0));
    for (int set = 0; set < setsPerView; ++set) {
        vec4 flux = texelFetch(mapFlux, ivec3(from.xy, from.z * setsPerView + set), 0);
        imageStore(allFlux, ivec3(to.xy, to.z * setsPerView + set), flux);
    }
}
