// SPDX-License-Identifier: MIT
// Linear light to what a display takes: the sRGB transfer function (IEC 61966-2-1), clamped.
vec3 encodeSrgb(vec3 color) {
    vec3 low = color * 12.92;
    vec3 high = 1.055 * pow(max(color, vec3(1e-8)), vec3(1.0 / 2.4)) - 0.055;
    return clamp(mix(high, low, lessThanEqual(color, vec3(0.0031308))), 0.0, 1.0);
}
