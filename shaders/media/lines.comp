// SPDX-License-Identifier: MIT
// The in-scattered radiance that one photon's path adds at the pixels of its line, W/m²/sr, the mean
// over each:
//     L = ∫ Φ(t) σs p(cosθ) Tr(eye) |r| / (z³ a²) dt
// over the part of the path that the pixel sees; r is the point in view space, z its depth, a² the
// area of a pixel at a depth of 1 m, z³ a² / |r| the pixel's solid angle times |r|². With i along
// the line on the screen 1/z goes from 1/z0 to 1/z1 linearly, and so dt/z² = (t1 - t0)/(z0 z1) di:
// nothing is singular for a path towards the eye, and a column of pixels gets its share of the line
// exactly (hard case 36), whatever a device's rules for lines are (hard case 6). Across the line the
// shares of a column's pixels add up to 1. One thread a photon, for so many of its columns.
#include "include/maps/flux_sum.glsl"
#include "include/photons/clamped.glsl"
#include "include/photons/hits.glsl"
#include "include/photons/photon_thread.glsl"
#include "media/lines.glsl"

uniform sampler2D receiver;
uniform float radianceScale;  // units of the sums are so many of the ledger's, 1/(m² sr)
uniform int firstColumn;      // of the line's
uniform int columnCount;

// The line; on the screen the longer axis comes first.
vec4 pathPixels;     // of both ends
vec4 pathEnds;       // 1/z and t of both ends
vec3 pathDirection;
vec3 pathExtinction;  // 1/m
vec3 pathPower;       // Φ(0) σs (t1 - t0) / (z0 z1 a²), W/m³ (σs of each channel)
mat2 pathWidth;       // across the line, along u and v: m, and what a metre adds
float pathStretch;    // of the width along the shorter axis over that across the line
bool isSteep;

RaySegment pathSegment() {
    RaySegment path;
    path.nearNearness = pathEnds.x;
    path.farNearness = pathEnds.y;
    path.nearT = pathEnds.z;
    path.farT = pathEnds.w;
    return path;
}

// How wide the photon's beam is across the line after so many metres, m.
float footprintAfter(float t) {
    return length(pathWidth[0] + t * pathWidth[1]);
}

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

// Whether the photon has a line.
bool setPath(ivec2 texel) {
    Photon photon = photonAt(texel);
    if (photon.fate != kFateInFlight || !isNumber(photon)) return false;
    // Another batch brings it as well (include/photons/neighbour_batch.glsl).
    if (dot(photon.fluxWatts, vec3(ledgerUnitsPerWatt)) < 0.25) return false;
    uint fate = uint(texelFetch(hitFlux, texel, 0).w);
    bool hasHit = fate == kFateReceiver || fate == kFateSpecular;
    float end = hasHit ? texelFetch(hitPosition, texel, 0).w : 3.0e38;
    RaySegment path = clipPath(photon.positionVs, photon.directionVs, end,
                               0.5 * float(media_lines_maximum) + 1.0);
    if (!path.visible) return false;
    vec2 along = path.farPixel - path.nearPixel;
    isSteep = abs(along.y) > abs(along.x);
    pathPixels = isSteep ? vec4(path.nearPixel.yx, path.farPixel.yx)
                         : vec4(path.nearPixel, path.farPixel);
    if (isSteep) along = along.yx;
    pathEnds = vec4(path.nearNearness, path.farNearness, path.nearT, path.farT);
    pathDirection = photon.directionVs;
    pathExtinction = extinctionAround(photon.media);
    float pixel = view.frustum.w;
    pathPower = photon.fluxWatts * tinted(view.mediumScattering.rgb) *
                ((path.farT - path.nearT) * path.nearNearness * path.farNearness / (pixel * pixel));
    // A line of less than a pixel has no direction on the screen.
    float slope = abs(along.x) > 1.0 ? along.y / along.x : 0.0;
    pathWidth = mat2(photon.footprintMeters, 0.0, 0.0, 0.0);
#ifdef PHOTON_BEAMS
    // The line and the eye lie in one plane, and so what is across the line is the same all along.
    vec3 across = cross(photon.directionVs, photon.positionVs);
    float size = length(across);
    if (size > 1e-6 * length(photon.positionVs)) {
        Beam beam = beamAt(texel);
        vec2 inBasis = (across / size) * basisAcross(photon.directionVs);
        pathWidth = mat2(inBasis * beam.place, inBasis * beam.turn);
    }
#endif
    pathStretch = sqrt(1.0 + slope * slope);
    return true;
}

// What a part of the line, as its share from 0 to 1, adds at a pixel of its column.
vec3 scatteredTo(ivec2 pixel, vec2 part) {
    // A mirror hides what is behind it too; its depth is negative.
    float hidden = abs(texelFetch(receiver, pixel, 0).x);
    if (hidden > 0.0) part = partBefore(part, hidden);
    if (part.x >= part.y) return vec3(0.0);
    float row = float(isSteep ? pixel.x : pixel.y);
    RaySegment path = pathSegment();
    // The middle of a pixel's part; of more pieces where a pixel holds much of the path.
    int pieces = clamp(int(ceil(64.0 * (part.y - part.x))), 1, 64);
    float piece = (part.y - part.x) / float(pieces);
    vec3 sum = vec3(0.0);
    for (int k = 0; k < pieces; ++k) {
        float i = part.x + piece * (float(k) + 0.5);
        vec2 at = mix(pathPixels.xy, pathPixels.zw, i);
        float depth = depthAtIndex(path, i, 1.0);
        float t = parameterAtIndex(path, i, 1.0);
        float reach = halfWidth(footprintAfter(t), 1.0 / depth) * pathStretch;
        float across = parabolaBelow((row + 1.0 - at.y) / reach) - parabolaBelow((row - at.y) / reach);
        if (across <= 0.0) continue;
        vec3 ray = viewRay(isSteep ? at.yx : at);
        float slant = length(ray);
        vec3 opticalDepth = pathExtinction * t +
                            tinted(view.mediumExtinction.rgb) * (slant * depth);
        float cosine = -dot(pathDirection, ray) / slant;
        sum += across * slant * phaseFunction(cosine) * exp(-opticalDepth);
    }
    return pathPower * (sum * piece);
}

void main() {
    uint index = photonOfThread();
    if (index >= photons.count || !setPath(ivec2(photonTexel(photons, index)))) return;
    // Of the line's two ends; between them it is no wider than the wider footprint at the nearer.
    float wanted = max(wantedWidth(footprintAfter(pathEnds.z), pathEnds.x),
                       wantedWidth(footprintAfter(pathEnds.w), pathEnds.y));
    if (firstColumn == 0 && wanted > float(media_lines_maximum)) {
        vec3 flux = texelFetch(photonFlux, ivec2(photonTexel(photons, index)), 0).rgb;
        countClamped(0u, wanted / float(media_lines_maximum), flux);
    }
    ivec2 size = ivec2(isSteep ? view.sizePixels.yx : view.sizePixels.xy);
    int first = max(int(floor(min(pathPixels.x, pathPixels.z))), 0) + firstColumn;
    int last = min(int(floor(max(pathPixels.x, pathPixels.z))), size.x - 1);
    last = min(last, first + columnCount - 1);
    for (int column = first; column <= last; ++column) {
        vec2 part = partInColumn(float(column));
        if (part.x >= part.y) continue;
        // The rows that this part may reach.
        vec2 rows = mix(pathPixels.yy, pathPixels.ww, part);
        vec2 nearness = mix(pathEnds.xx, pathEnds.yy, part);
        RaySegment path = pathSegment();
        float widest = max(footprintAfter(parameterAtIndex(path, part.x, 1.0)),
                           footprintAfter(parameterAtIndex(path, part.y, 1.0)));
        float reach = halfWidth(widest, max(nearness.x, nearness.y)) * pathStretch;
        int low = max(int(floor(min(rows.x, rows.y) - reach)), 0);
        int high = min(int(floor(max(rows.x, rows.y) + reach)), size.y - 1);
        for (int row = low; row <= high; ++row) {
            ivec2 pixel = isSteep ? ivec2(row, column) : ivec2(column, row);
            vec3 radiance = scatteredTo(pixel, part);
            sumAdd(pixel, 0, radiance * (ledgerUnitsPerWatt / radianceScale));
        }
    }
}
