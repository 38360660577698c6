// SPDX-License-Identifier: MIT
// A texel of the row texture: x the ray parameter of a hit in m, 0 for none; y its step and layer,
// and whether the photon came out, or in, between two pixels. 16384 steps of 64 layers, twice, are 2^21,
// which a float holds exactly.
vec4 packRowTexel(LayerHit hit, int stepIndex, bool isExit) {
    return vec4(hit.t, float((stepIndex * 64 + hit.layer) * 2 + int(isExit)), 0.0, 0.0);
}

void unpackRowTexel(vec2 texel, out LayerHit hit, out int stepIndex, out bool isExit) {
    int packedPlace = int(texel.y);
    isExit = (packedPlace & 1) == 1;
    stepIndex = packedPlace / 128;
    hit = LayerHit(texel.x, texel.x > 0.0 ? (packedPlace / 2) % 64 : -1);
}
