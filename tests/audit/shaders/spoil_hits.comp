// SPDX-License-Identifier: MIT
// Moves hits sideways by a number of pixels, or drops them.
#include "include/photons/transfer_map.glsl"
#include "include/views/view.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f) uniform image2D hitPosition;
layout(rgba32f) uniform image2D hitFlux;
uniform vec2 shiftPixels;
uniform int dropped;
uniform int notANumber;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(hitFlux)))) return;
    vec4 flux = imageLoad(hitFlux, texel);
    if (uint(flux.w) != kFateReceiver) return;
    vec4 position = imageLoad(hitPosition, texel);
    position.xy += shiftPixels * pixelFootprint(-position.z);
    if (notANumber != 0) position.x = uintBitsToFloat(0x7fc00000u);
    imageStore(hitPosition, texel, position);
    if (dropped != 0) imageStore(hitFlux, texel, vec4(0.0, 0.0, 0.0, float(kFateEnded)));
}
