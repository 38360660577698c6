// SPDX-License-Identifier: MIT
// Values of any range as colours for the window: exposure and sRGB, or false colours; NaN is
// magenta, infinity cyan. Row 0 is the top of the image on both sides.
#include "include/maps/srgb.glsl"

uniform sampler2D values;
uniform sampler2D palette;
uniform int channels;
uniform int channel;  // 0 colour, 1 to 4 one of them, 5 luminance
uniform bool isEncoded;
uniform bool isFalseColor;
uniform float gain;
uniform vec2 range;

out vec4 mapped;

void main() {
    vec4 value = texelFetch(values, ivec2(gl_FragCoord.xy), 0);
    if (channels == 1) value = value.rrrr;
    if (channels == 2) value.b = 0.0;
    bool hasNan = any(isnan(value.rgb)) || (channels == 4 && isnan(value.a));
    bool hasInfinity = any(isinf(value.rgb)) || (channels == 4 && isinf(value.a));
    vec3 color = value.rgb;
    float single = dot(value.rgb, vec3(0.2126390059, 0.7151686788, 0.0721923154));
    if (channels == 1) single = value.r;
    if (channel >= 1 && channel <= 4) single = value[channel - 1];
    if (channel != 0) color = vec3(single);
    if (isFalseColor) {
        float t = clamp((single - range.x) / max(range.y - range.x, 1e-30), 0.0, 1.0);
        color = texelFetch(palette, ivec2(int(t * 255.0 + 0.5), 0), 0).rgb;
    } else if (!isEncoded) {
        color = encodeSrgb(gain * color);
    }
    if (hasInfinity) color = vec3(0.0, 1.0, 1.0);
    if (hasNan) color = vec3(1.0, 0.0, 1.0);
    mapped = vec4(color, 1.0);
}
