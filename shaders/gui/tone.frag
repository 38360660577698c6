// SPDX-License-Identifier: MIT
// Values of any range as colours for the window: exposure and sRGB, or false colours; NaN is
// magenta, infinity cyan, and what an image leaves out grey. Row 0 is the top of the image on both
// sides.
#include "include/maps/srgb.glsl"

uniform sampler2D values;
uniform sampler2D palette;  // row 0: from low to high; row 1: symmetric
uniform int channels;
uniform int channel;  // 0 all, 1 to 4 one of them, 5 luminance or length
uniform int kind;     // 0 a colour, 1 a vector, 2 channels by themselves
uniform bool isEncoded;
uniform bool isFalseColor;
uniform bool leavesOut;  // NaN says that there is no value
uniform int scale;       // 0 linear, 1 logarithmic, 2 symmetric
uniform float gain;
uniform vec2 range;

out vec4 mapped;

float placeOn(float value) {
    if (scale == 2) return 0.5 + 0.5 * value / max(range.y, 1e-30);
    if (scale == 1) return value > 0.0 ? log(value / range.x) / log(range.y / range.x) : 0.0;
    return (value - range.x) / max(range.y - range.x, 1e-30);
}

void main() {
    vec4 value = texelFetch(values, ivec2(gl_FragCoord.xy), 0);
    if (channels == 1) value = value.rrrr;
    if (channels == 2) value.b = 0.0;
    bool hasNan = any(isnan(value.rgb)) || (channels == 4 && isnan(value.a));
    bool hasInfinity = any(isinf(value.rgb)) || (channels == 4 && isinf(value.a));
    vec3 color = value.rgb;
    float single = dot(value.rgb, vec3(0.2126390059, 0.7151686788, 0.0721923154));
    if (kind == 1) single = length(value.rgb);
    if (kind == 2 || channels == 1) single = value.r;
    if (channel >= 1 && channel <= 4) single = value[channel - 1];
    bool isVector = kind == 1 && channel == 0;
    if (!isVector && (channel != 0 || kind == 2)) color = vec3(single);
    if (isFalseColor) {
        float t = clamp(placeOn(single), 0.0, 1.0);
        color = texelFetch(palette, ivec2(int(t * 255.0 + 0.5), scale == 2 ? 1 : 0), 0).rgb;
    } else if (isVector) {
        color = clamp(0.5 + 0.5 * gain * color, 0.0, 1.0);
    } else if (!isEncoded) {
        color = encodeSrgb(gain * color);
    }
    if (hasInfinity) color = vec3(0.0, 1.0, 1.0);
    if (hasNan) color = leavesOut ? vec3(0.25) : vec3(1.0, 0.0, 1.0);
    mapped = vec4(color, 1.0);
}
