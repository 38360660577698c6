// SPDX-License-Identifier: MIT
// The whole flux of each photon into the one pixel that sees it.
#include "common/ledger.glsl"
#include "common/transfer_map.glsl"
#include "common/view.glsl"

layout(local_size_x = 64) in;
layout(rgba32f) uniform image2D irradiance;
uniform sampler2D receiver;
uniform sampler2D hitPosition;
uniform sampler2D hitFlux;

void main() {
    ivec2 mapSize = textureSize(hitFlux, 0);
    int index = int(gl_GlobalInvocationID.x);
    if (index >= mapSize.x * mapSize.y) return;
    ivec2 texel = ivec2(index % mapSize.x, index / mapSize.x);
    vec4 flux = texelFetch(hitFlux, texel, 0);
    if (uint(flux.w) != kFateReceiver) return;
    ivec2 pixel = ivec2(floor(pixelOf(texelFetch(hitPosition, texel, 0).xyz)));
    float area = texelFetch(receiver, pixel, 0).y;
    if (area <= 0.0) return;
    imageStore(irradiance, pixel, vec4(flux.rgb * (reconstruct_points_gain / area), 0.0));
}
