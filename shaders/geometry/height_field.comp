// SPDX-License-Identifier: MIT
// The vertices of a height field, y = sum of amplitude cos(k·x + phase), with exact normals. One
// thread a vertex; rows along x from the corner with the least x and z.
#include "include/thread.glsl"
#include "framework/transport/types.h"

layout(std430) writeonly buffer Vertices {
    VertexData vertices[];
};
layout(std430) readonly buffer Waves {
    vec4 waves[];  // xy: wave vector, rad/m; z: amplitude, m; w: phase at this time, rad
};
uniform ivec2 cells;
uniform vec2 sizeMeters;
uniform int firstVertex;
uniform int firstWave;
uniform int waveCount;

void main() {
    int columns = cells.x + 1;
    int index = int(threadNumber());
    if (index >= columns * (cells.y + 1)) return;
    vec2 corner = vec2(index % columns, index / columns) / vec2(cells);
    vec2 xz = (corner - 0.5) * sizeMeters;
    float height = 0.0;
    vec2 slope = vec2(0.0);
    for (int i = 0; i < waveCount; ++i) {
        vec4 wave = waves[firstWave + i];
        float phase = dot(wave.xy, xz) + wave.w;
        height += wave.z * cos(phase);
        slope -= wave.z * sin(phase) * wave.xy;
    }
    vec2 uv = corner * sizeMeters;
    vec3 normal = normalize(vec3(-slope.x, 1.0, -slope.y));
    vertices[firstVertex + index] = VertexData(vec3(xz.x, height, xz.y), uv.x, normal, uv.y);
}
