// SPDX-License-Identifier: MIT
// reconstruct.edges: which pixels of the eye's view have to be looked at more closely: those one of
// whose eight neighbours sees another surface than they do, or a receiver where they see none. A
// thing so thin that it lies between the middles of all of them is not found. One thread a pixel.
#include "reconstruct/edges.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D receiver;
uniform sampler2D receiverSurface;
layout(rgba32f) writeonly uniform image2D edgeReceiver;

bool isAtEdge(ivec2 pixel) {
    float depth = texelFetch(receiver, pixel, 0).x;
    vec3 normal = texelFetch(receiverSurface, pixel, 0).xyz;
    vec2 middle = vec2(pixel) + 0.5;
    vec3 point = viewPoint(middle, depth);
    float margin = depthMargin(viewRay(middle), depth, normal);
    ivec2 last = ivec2(view.sizePixels.xy) - 1;
    for (int i = 0; i < 9; ++i) {
        ivec2 neighbour = pixel + ivec2(i % 3, i / 3) - 1;
        if (any(lessThan(neighbour, ivec2(0))) || any(greaterThan(neighbour, last))) continue;
        if (neighbour == pixel) continue;
        float seen = texelFetch(receiver, neighbour, 0).x;
        if (depth <= 0.0) {
            if (seen > 0.0) return true;
        } else if (!continuesPlane(point, normal, margin, vec2(neighbour) + 0.5, seen,
                           texelFetch(receiverSurface, neighbour, 0).xyz)) {
            return true;
        }
    }
    return false;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(view.sizePixels.xy)))) return;
    uint number = 0u;
    if (isAtEdge(pixel)) {
        uint place = atomicAdd(edges.count, 1u);
        if (place < edgeCapacity) {
            edgePixels[place] = uint(pixel.x) | uint(pixel.y) << 16u;
            number = place + 1u;
        }
    }
    imageStore(edgeReceiver, pixel, vec4(texelFetch(receiver, pixel, 0).xy, float(number), 0.0));
}
