// SPDX-License-Identifier: MIT
// A texel of the row texture: x the ray parameter of a hit in m, 0 for none; y its step and layer.
// 16384 steps of 64 layers are 2^20, which a float holds exactly.
vec4 packRowTexel(LayerHit hit, int stepIndex) {
    return vec4(hit.t, float(stepIndex * 64 + hit.layer), 0.0, 0.0);
}

void unpackRowTexel(vec2 texel, out LayerHit hit, out int stepIndex) {
    int stepAndLayer = int(texel.y);
    stepIndex = stepAndLayer / 64;
    hit = LayerHit(texel.x, texel.x > 0.0 ? stepAndLayer % 64 : -1);
}
