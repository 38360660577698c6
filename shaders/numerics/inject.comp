// SPDX-License-Identifier: MIT
// Photons and hits from a list, as texels of the transfer map.
layout(local_size_x = 64) in;

struct Injected {
    vec4 photonPosition;
    vec4 photonDirection;
    vec4 photonFlux;
    vec4 hitPosition;
    vec4 hitSurface;
    vec4 hitFlux;
};
layout(std430) readonly buffer Photons {
    Injected injected[];
};
layout(rgba32f) uniform image2D photonPosition;
layout(rgba32f) uniform image2D photonDirection;
layout(rgba32f) uniform image2D photonFlux;
layout(rgba32f) uniform image2D hitPosition;
layout(rgba32f) uniform image2D hitSurface;
layout(rgba32f) uniform image2D hitFlux;

void main() {
    int index = int(gl_GlobalInvocationID.x);
    ivec2 size = imageSize(photonFlux);
    if (index >= size.x * size.y) return;
    ivec2 texel = ivec2(index % size.x, index / size.x);
    Injected photon = injected[index];
    imageStore(photonPosition, texel, photon.photonPosition);
    imageStore(photonDirection, texel, photon.photonDirection);
    imageStore(photonFlux, texel, photon.photonFlux);
    imageStore(hitPosition, texel, photon.hitPosition);
    imageStore(hitSurface, texel, photon.hitSurface);
    imageStore(hitFlux, texel, photon.hitFlux);
}
