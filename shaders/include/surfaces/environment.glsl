// SPDX-License-Identifier: MIT
// What comes from outside of the scene: the background radiance, times the environment's picture
// where there is one (scene/environment.h has the same in double).
#include "include/surfaces/scene_images.glsl"
#include "include/views/view.glsl"

// Radiance that comes along a ray which hits nothing more, W/m²/sr. `directionVs`: unit, along the
// ray, away from the eye.
vec3 environmentRadiance(vec3 directionVs) {
    if (view.environment.x < 0.0) return view.background.rgb;
    const float kTurn = 6.28318531;
    vec3 d = mat3(view.viewToWorld) * directionVs;
    float longitude = d.x == 0.0 && d.z == 0.0 ? 0.0 : atan(d.x, -d.z);
    float side = float(textureSize(sceneImages, 0).x);
    // The array repeats its images; above this one there is not what lies below.
    float latitude = clamp(0.5 + asin(clamp(d.y, -1.0, 1.0)) / (0.5 * kTurn), 0.5 / side,
                           1.0 - 0.5 / side);
    vec2 at = vec2(0.5 + (longitude + view.environment.y) / kTurn, latitude);
    return view.background.rgb *
           textureLod(sceneImages, vec3(at, view.environment.x), 0.0).rgb;
}
