// SPDX-License-Identifier: MIT
// Whether light reaches a point past the surfaces that raster_views/light_sight.frag has drawn from the light.
// A texel stands for the plane of its triangle.

// By how much a curved surface may lie beyond the plane of a triangle next to it, in what its depth
// differs by over a texel. More takes less of `tree` for the wrong side and more of
// `cornell-bunny`: with 0.25, 0.5, 1 and 2 it is 1.01, 0.97, 0.96, 0.93 % and 0.04, 0.04, 0.07,
// 0.12 % (400x300).
const float kCurvature = 0.5;

// How far off a point of the eye's view may lie, as a share of its distance: what 32 bits round, and
// rasterisers that move corners to a 256th of a pixel. A flat scene lies at the light's near plane,
// whose own depth says nothing of that.
const float kUncertainty = 1e-5;

// `nearest`: a texel, x: planar depth from the light, m, 0 none; yz: its growth a texel, as a share
// of it. `neighbourOffset`: the point from the texel's middle, texels; `depth`: its own, m;
// `fromEye`: how far from the eye it is, m; `normalLs`: of the surface it lies on, unit;
// `texelMeters`: what a texel covers at the point.
bool reachesLight(vec4 nearest, vec2 neighbourOffset, vec2 texelMeters, float depth, float fromEye,
                  vec3 normalLs) {
    vec2 growth = nearest.yz * nearest.x;
    float extent = abs(growth.x) + abs(growth.y);
    float plane = nearest.x + clamp(dot(growth, neighbourOffset), -2.0 * extent, 2.0 * extent);
    // A surface that turns by more than 60 degrees is another one.
    vec3 blocker = vec3(growth / texelMeters, 1.0);
    float facing = dot(blocker, normalLs);
    bool isSame = facing * facing > 0.25 * dot(blocker, blocker);
    float margin = (isSame ? kCurvature * extent : 0.0) + 1e-4 * depth + kUncertainty * fromEye;
    return nearest.x <= 0.0 || depth <= plane + margin;
}
