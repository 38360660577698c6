// SPDX-License-Identifier: MIT
// A pixel of a layer before anything is drawn to it: no surface, and infinitely far.
layout(location = 0) out vec4 layerDepth;
layout(location = 1) out vec4 layerSurface;

void main() {
    gl_FragDepth = 1.0;
    layerDepth = vec4(0.0);
    layerSurface = vec4(0.0);
}
