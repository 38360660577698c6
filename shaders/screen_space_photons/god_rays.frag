// SPDX-License-Identifier: MIT
// In-scattered radiance that one photon's path adds at one pixel, W/m²/sr, the mean over the pixel:
//     L = ∫ Φ(t) σs p(cosθ) Tr(eye) |r| / (z³ a²) dt
// over the part of the path that the pixel sees; r is the point in view space, z its depth, a² the
// area of a pixel at a depth of 1 m, z³ a² / |r| the pixel's solid angle times |r|². With i along
// the line on the screen 1/z goes from 1/z0 to 1/z1 linearly, and so dt/z² = (t1 - t0)/(z0 z1) di:
// nothing is singular for a path towards the eye, and a column of pixels gets its share of the line
// exactly (hard case 36). Across the line the shares of a column's pixels add up to 1.
#include "include/flux_sum.glsl"
#include "screen_space_photons/god_rays.glsl"

flat in vec4 pathPixels;
flat in vec4 pathEnds;
flat in vec3 pathDirection;
flat in vec3 pathExtinction;
flat in vec3 pathPower;  // Φ(0) σs (t1 - t0) / (z0 z1 a²), W/m³ (σs of each channel)
flat in vec2 pathWidth;
flat in int isSteep;

uniform sampler2D receiver;
uniform float radianceScale;  // units of the sums are so many of the ledger's, 1/(m² sr)

// The part of a parabola on [-1, 1], of area 1, that lies below x.
float parabolaBelow(float x) {
    x = clamp(x, -1.0, 1.0);
    return 0.5 + x * (0.75 - 0.25 * x * x);
}

// The part of the line that lies in this column of pixels, as its share from 0 to 1.
vec2 partInColumn(float column) {
    float begin = pathPixels.x;
    float extent = pathPixels.z - pathPixels.x;
    // Too short to be cut at a pixel's edge in 32 bits: all of it is where its middle is.
    if (abs(extent) < 1e-2) {
        return floor(begin + 0.5 * extent) == column ? vec2(0.0, 1.0) : vec2(1.0, 0.0);
    }
    vec2 part = clamp((vec2(column, column + 1.0) - begin) / extent, 0.0, 1.0);
    return extent > 0.0 ? part : part.yx;
}

// Cut to what lies in front of a surface at this depth.
vec2 partBefore(vec2 part, float depth) {
    float rise = pathEnds.y - pathEnds.x;
    float low = 1.0 / depth - pathEnds.x;
    if (rise == 0.0) return low <= 0.0 ? part : vec2(1.0, 0.0);
    float end = low / rise;
    return rise > 0.0 ? vec2(max(part.x, end), part.y) : vec2(part.x, min(part.y, end));
}

void main() {
    vec2 pixel = floor(gl_FragCoord.xy);
    vec2 turned = isSteep != 0 ? pixel.yx : pixel;
    vec2 part = partInColumn(turned.x);
    // A mirror hides what is beyond it too; its depth is negative.
    float hidden = abs(texelFetch(receiver, ivec2(pixel), 0).x);
    if (hidden > 0.0) part = partBefore(part, hidden);
    if (part.x >= part.y) discard;

    RaySegment path;
    path.nearNearness = pathEnds.x;
    path.farNearness = pathEnds.y;
    path.nearT = pathEnds.z;
    path.farT = pathEnds.w;
    // The middle of a pixel's part; of more pieces where a pixel holds much of the path.
    int pieces = clamp(int(ceil(64.0 * (part.y - part.x))), 1, 64);
    float piece = (part.y - part.x) / float(pieces);
    vec3 sum = vec3(0.0);
    for (int k = 0; k < pieces; ++k) {
        float i = part.x + piece * (float(k) + 0.5);
        vec2 at = mix(pathPixels.xy, pathPixels.zw, i);
        float depth = depthAtIndex(path, i, 1.0);
        float reach = halfWidth(pathWidth.x, 1.0 / depth) * pathWidth.y;
        float across = parabolaBelow((turned.y + 1.0 - at.y) / reach) -
                       parabolaBelow((turned.y - at.y) / reach);
        if (across <= 0.0) continue;
        vec3 ray = viewRay(isSteep != 0 ? at.yx : at);
        float slant = length(ray);
        vec3 opticalDepth = pathExtinction * parameterAtIndex(path, i, 1.0) +
                            view.mediumExtinction.rgb * (slant * depth);
        float cosine = -dot(pathDirection, ray) / slant;
        sum += across * slant * phaseFunction(cosine) * exp(-opticalDepth);
    }
    vec3 radiance = pathPower * (sum * piece);
    sumAdd(ivec2(pixel), 0, radiance * (ledgerUnitsPerWatt / radianceScale));
}
