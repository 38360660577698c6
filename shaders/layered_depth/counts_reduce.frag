// SPDX-License-Identifier: MIT
// One step of the reduce of fragment counts (K06, section 2.2): of four texels the largest count,
// and the sums of fragments, of those beyond the last layer and of pixels that have some: x to w.
uniform sampler2D source;
uniform int layerCount;
uniform int isFirst;  // the source holds the counts themselves

layout(location = 0) out vec4 reduced;

void main() {
    ivec2 size = textureSize(source, 0);
    ivec2 corner = 2 * ivec2(gl_FragCoord.xy);
    reduced = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 texel = corner + ivec2(i & 1, i >> 1);
        if (any(greaterThanEqual(texel, size))) continue;
        vec4 part = texelFetch(source, texel, 0);
        if (isFirst != 0) {
            float skipped = max(part.x - float(layerCount), 0.0);
            part = vec4(part.x, part.x, skipped, skipped > 0.0 ? 1.0 : 0.0);
        }
        reduced = vec4(max(reduced.x, part.x), reduced.yzw + part.yzw);
    }
}
