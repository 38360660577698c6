// SPDX-License-Identifier: MIT
// The first surface that a light sees: its object's index + 1, and which triangle of it.
flat in uint object;

layout(location = 0) out uvec4 seen;

void main() {
    seen = uvec4(object + 1u, uint(gl_PrimitiveID), 0u, 0u);
}
