// SPDX-License-Identifier: MIT
// One step of the horizontal reduce: of two neighbours in a row, the nearer hit (K06, section 2.1).
uniform sampler2D source;

flat in int sourceWidth;

layout(location = 0) out vec4 nearer;

void main() {
    ivec2 left = ivec2(2 * int(gl_FragCoord.x), int(gl_FragCoord.y));
    vec2 a = texelFetch(source, left, 0).xy;
    vec2 b = left.x + 1 < sourceWidth ? texelFetch(source, left + ivec2(1, 0), 0).xy : vec2(0.0);
    bool takesRight = b.x > 0.0 && (a.x <= 0.0 || b.x < a.x);
    nearer = vec4(takesRight ? b : a, 0.0, 0.0);
}
