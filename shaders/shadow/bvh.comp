// SPDX-License-Identifier: MIT
// Whether the light reaches each receiver: nothing is on the ray back to it. One thread a pixel.
#include "include/surfaces/bvh.glsl"
#include "shadow/ray_to_light.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D receiver;
uniform sampler2D receiverSurface;
layout(r32f) writeonly uniform image2DArray visibility;
uniform int lightIndex;

float resolved = 0.0;  // of where the ray starts, m

// From both sides, but for the surface that it starts on.
bool isSurfaceHit(BvhRay ray, uint triangle, vec3 normal, float height) {
    return abs(height) > resolved;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(view.sizePixels.xy)))) return;
    LightData light = lights[lightIndex];
    vec4 seen = texelFetch(receiver, pixel, 0);
    vec4 surface = seen.x > 0.0 ? texelFetch(receiverSurface, pixel, 0) : vec4(0.0);
    Photon ray = rayToLight(pixel, seen, surface, light);
    bool isLit = ray.fate == kFateInFlight;
    if (isLit && isNumber(ray)) {
        resolved = resolvedByPicture(ray.positionVs, pixelFootprint(abs(ray.positionVs.z)));
        isLit = !isBlocked(bvhRay(ray.positionVs, ray.directionVs),
                           reachOfRay(light, ray.positionVs));
    }
    imageStore(visibility, ivec3(pixel, lightIndex), vec4(isLit ? 1.0 : 0.0));
}
