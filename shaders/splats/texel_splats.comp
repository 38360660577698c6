// SPDX-License-Identifier: MIT
// Photons as Gaussian splats of a map's texels (WD06, WD08): one size for all, four sizes at once,
// or as wide as each photon's beam; in one level of the map's resolution. Weights are summed over
// the texels first, so that exactly the photon's flux is deposited, or counted where something
// nearer hides it or the map ends (hard cases 31, 32); what hangs off the surface's edge is
// redistributed on it. One thread a photon.
//   FOUR_RADII    a set of the map a size, and counts of photons next to them
//   BEAM_WIDTHS   as wide as the photon's beam is where it arrives
//   ONE_LEVEL     only photons whose beams are as wide as the level's texels
//   LEVELS        the map holds coarser ones of itself; `level` is this draw's
#include "include/photons/ledger_of_group.glsl"
#include "include/photons/arriving.glsl"
#include "include/surfaces/surface_data.glsl"
#include "maps/levels.glsl"
#include "include/views/seen_receiver.glsl"
#include "include/maps/deposit.glsl"
#ifdef BEAM_WIDTHS
#include "splats/pixel_on_plane.glsl"
#endif

uniform int mapsPerView;
uniform int fluxSets;     // the first of them; what is kept for glossy receivers follows
uniform float diameter;   // texels
uniform int keepsEdges;   // 1: only texels that see the photon's own surface
uniform int atTexels;     // 1: centred on the texel that the photon falls into
uniform int level;
#ifdef BEAM_WIDTHS
#include "include/photons/clamped.glsl"
uniform float widths;     // of a beam that a splat's diameter is
uniform int isRound;      // as the beam is across, whatever the receiver's slant
uniform float minimum;      // texels
uniform float maximum;
// Entries of the counts.
const uint kAboveMaximum = 0u;
const uint kBelowMinimum = 1u;
#endif
#ifdef ONE_LEVEL
uniform int levels;
#endif
#ifdef COUNTS
layout(r32ui) uniform uimage2DArray photonCounts;
#endif

#ifdef FOUR_RADII
const vec4 kDiameters = vec4(3.0, 7.0, 11.0, 15.0);  // WD08, section 4.1
#define WEIGHT vec4
#else
#define WEIGHT float
#endif

struct Splat {
    vec2 center;  // of the level's texels
    vec3 position;
    vec3 normal;
    float radius;  // texels; of an ellipse along its longer axis
#ifdef BEAM_WIDTHS
    mat2 metric;  // 1/texel²: x · metric x is 1 at its edge
    vec2 extent;  // texels, to each side
    vec2 wanted;  // the shorter and the longer diameter that the beam asks for, texels
#endif
};

float gaussian(float offset, float radius) {
    float share = offset / radius;
    return exp(-4.5 * share * share);
}

// A point of OpenGL is a square, of which the Gaussian ends at three standard deviations.
WEIGHT weightAt(Splat splat, ivec2 texel) {
    vec2 offset = abs(vec2(texel) + 0.5 - splat.center);
    float farther = max(offset.x, offset.y);
#ifdef FOUR_RADII
    vec4 weights;
    for (int i = 0; i < 4; ++i) {
        float radius = 0.5 * kDiameters[i];
        weights[i] = farther <= radius ? gaussian(offset.x, radius) * gaussian(offset.y, radius) : 0.0;
    }
    return weights;
#elif defined(BEAM_WIDTHS)
    if (any(greaterThan(offset, max(splat.extent, vec2(0.5))))) return 0.0;
    offset = vec2(texel) + 0.5 - splat.center;
    float squared = dot(offset, splat.metric * offset);
    // As the corners of a square; however small, it lies on the texel that it falls into.
    if (squared > 2.0 && farther > 0.5) return 0.0;
    return max(exp(-4.5 * squared), 1e-30);
#else
    // However small, it lies on the texel that it falls into.
    if (farther > splat.radius && farther > 0.5) return 0.0;
    return max(gaussian(offset.x, splat.radius) * gaussian(offset.y, splat.radius), 1e-30);
#endif
}

// How a texel of the map's own resolution sees the photon's surface.
int lookAt(Splat splat, ivec2 texel) {
    float facing = dot(splat.normal, viewRay(vec2(texel) + 0.5));
    if (abs(facing) < 1e-5) return kSeenOutside;
    float depth = depthOnPlane(vec2(texel) + 0.5, splat.normal, splat.position, facing);
    if (!(depth > view.frustum.z)) return kSeenOutside;
    float tolerance = (0.5 * splat.radius + 1.0) * pixelFootprint(depth);
    float area;
    return seenAt(texel, depth, splat.normal, tolerance, area);
}

// What becomes of the part of a splat that lies on a texel; kSeenOutside: the others have it.
int fateOfPart(Splat splat, ivec2 texel) {
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, sizeOfLevel(level)))) {
#ifdef MANY_VIEWS
        return kSeenOutside;  // the next face has it
#else
        return kSeenOffScreen;
#endif
    }
    if (keepsEdges == 0 || level > 0) return kSeenOn;
    return lookAt(splat, texel);
}

// Sums of weights.
struct Parts {
    WEIGHT deposited;
    WEIGHT hidden;
    WEIGHT clipped;
};

// To a set of flux, with what belongs to it for glossy receivers.
void add(ivec2 texel, int set, vec3 flux, vec3 direction) {
    ivec2 place = placeOfLevel(level) + texel;
    int first = set + setOfLevel(level);
    sumAdd(place, viewIndex * mapsPerView + first, flux * ledgerUnitsPerWatt);
    depositGlossy(place, viewIndex * mapsPerView + fluxSets + first, flux, direction);
#ifdef COUNTS
    imageAtomicAdd(photonCounts, ivec3(place, viewIndex * fluxSets + first), 1u);
#endif
}

void deposit(Splat splat, ivec2 texel, WEIGHT share, vec3 flux, vec3 direction) {
#ifdef FOUR_RADII
    for (int i = 0; i < 4; ++i) {
        if (share[i] > 0.0) add(texel, i, flux * share[i], direction);
    }
#else
    add(texel, 0, flux * share, direction);
#endif
}

vec2 reachOf(Splat splat) {
#ifdef FOUR_RADII
    return vec2(7.5);
#elif defined(BEAM_WIDTHS)
    return max(splat.extent, vec2(0.5));
#else
    return vec2(max(splat.radius, 0.5));
#endif
}
// Of a cube's face no farther than it goes: the next one has the rest.
ivec2 firstOf(Splat splat) {
    ivec2 first = ivec2(ceil(splat.center - reachOf(splat) - 0.5));
#ifdef MANY_VIEWS
    first = max(first, ivec2(0));
#endif
    return first;
}
ivec2 lastOf(Splat splat) {
    ivec2 last = ivec2(floor(splat.center + reachOf(splat) - 0.5));
#ifdef MANY_VIEWS
    last = min(last, sizeOfLevel(level) - 1);
#endif
    return last;
}

void addParts(Splat splat, inout Parts parts) {
    ivec2 first = firstOf(splat);
    ivec2 last = lastOf(splat);
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            WEIGHT weight = weightAt(splat, ivec2(x, y));
            int fate = fateOfPart(splat, ivec2(x, y));
            if (fate == kSeenOn) parts.deposited += weight;
            if (fate == kSeenOccluded) parts.hidden += weight;
            if (fate == kSeenOffScreen) parts.clipped += weight;
        }
    }
}

// Counts what of a splat is not deposited, of those of the map's first set.
void countLost(Parts parts, vec3 flux) {
#ifdef FOUR_RADII
    int used = 0;
    while (used < 3 && parts.deposited[used] <= 0.0) ++used;
    float deposited = parts.deposited[used];
    float hidden = parts.hidden[used];
    float clipped = parts.clipped[used];
#else
    float deposited = parts.deposited;
    float hidden = parts.hidden;
    float clipped = parts.clipped;
#endif
    vec3 ofWeight = flux / (deposited + hidden + clipped);
    if (hidden > 0.0) ledgerAdd(kAccountHidden, ofWeight * hidden);
    if (clipped > 0.0) ledgerAdd(kAccountOutside, ofWeight * clipped);
}

// `parts`: of the splat in all views.
void splatInView(Splat splat, Parts parts, vec3 flux, vec3 direction) {
    WEIGHT total = max(parts.deposited + parts.hidden + parts.clipped, WEIGHT(1e-37));
    ivec2 first = firstOf(splat);
    ivec2 last = lastOf(splat);
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            ivec2 texel = ivec2(x, y);
            if (fateOfPart(splat, texel) != kSeenOn) continue;
            WEIGHT share = weightAt(splat, texel) / total;
#ifdef FOUR_RADII
            // A small splat that finds no texel is as wide as the next.
            for (int i = 2; i >= 0; --i) {
                if (parts.deposited[i] <= 0.0) share[i] = share[i + 1];
            }
            deposit(splat, texel, share, flux, direction);
#else
            if (share > 0.0) deposit(splat, texel, share, flux, direction);
#endif
        }
    }
}

#ifdef BEAM_WIDTHS
// A round beam on the receiver, as the view's texels see it, or as round on them as it is.
// `direction`: of the photon, in the current view.
void shapeByBeam(inout Splat splat, ivec2 texel, vec3 direction) {
    Beam beam = beamAt(texel);
    float width =
        sqrt(abs(determinant(beam.place + texelFetch(hitPosition, texel, 0).w * beam.turn)));
    float footprint = pixelFootprint(-splat.position.z);
    float radius = max(0.5 * widths * width, 1e-4 * footprint);  // m
    mat2x3 pixel = pixelOnPlane(splat.position, splat.normal, footprint);
    mat2x3 across = (pixel - outerProduct(direction, direction * pixel)) / radius;
    if (isRound == 1) across = mat2x3(1.0, 0.0, 0.0, 0.0, 1.0, 0.0) * (footprint / radius);
    // Its axes: eigenvectors of the metric, the shorter one first.
    mat2 metric = transpose(across) * across;
    float halfDifference = 0.5 * (metric[0][0] - metric[1][1]);
    float larger = 0.5 * (metric[0][0] + metric[1][1]) +
                   sqrt(halfDifference * halfDifference + metric[0][1] * metric[0][1]);
    vec3 normal = cross(across[0], across[1]);
    float smaller = dot(normal, normal) / larger;
    float angle = metric[0][1] == 0.0 && halfDifference == 0.0
                      ? 0.0
                      : 0.5 * atan(metric[0][1], halfDifference);
    mat2 axes = mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
    vec2 wanted = inversesqrt(max(vec2(larger, smaller), vec2(1e-12)));
    splat.wanted = 2.0 * wanted;
    vec2 halves = clamp(wanted, 0.5 * minimum, 0.5 * maximum);
    splat.radius = halves.y;
    splat.metric = axes * mat2(1.0 / (halves.x * halves.x), 0.0, 0.0, 1.0 / (halves.y * halves.y)) *
                   transpose(axes);
    vec2 squares = halves * halves;
    splat.extent =
        sqrt(vec2(dot(squares, vec2(axes[0].x, axes[1].x) * vec2(axes[0].x, axes[1].x)),
                  dot(squares, vec2(axes[0].y, axes[1].y) * vec2(axes[0].y, axes[1].y))));
}

// `wanted`: the shorter and the longer diameter.
void countBounds(vec2 wanted, vec3 flux) {
    if (wanted.y > maximum) countClamped(kAboveMaximum, wanted.y / maximum, flux);
    if (wanted.x < minimum)
        countClamped(kBelowMinimum, minimum / max(wanted.x, 1e-6 * minimum), flux);
}
#endif

// Of a photon that arrives at `positionVs`, in the current view; false where none of it lies there.
// A splat at the edge of one face of a cube goes on in the next.
bool splatOf(ivec2 texel, vec3 positionVs, vec3 normalVs, out Splat splat) {
    splat.position = pointFromEye(positionVs);
    if (-splat.position.z <= view.frustum.z) return false;
    splat.normal = directionFromEye(normalVs);
#ifdef BEAM_WIDTHS
    shapeByBeam(splat, texel, directionFromEye(texelFetch(photonDirection, texel, 0).xyz));
#else
    splat.radius = 0.5 * diameter;
#endif
    splat.center = pixelOf(splat.position) / float(1 << level);
    if (atTexels == 1) splat.center = floor(splat.center) + 0.5;
    vec2 outside = max(-splat.center, splat.center - vec2(sizeOfLevel(level)));
    return all(lessThan(outside, reachOf(splat)));
}

// Whether the ledger counts what this level does not take.
bool isBooked() {
#ifdef ONE_LEVEL
    return true;
#else
    return level == 0;
#endif
}

// Whether the photon is this level's, as the current view sees it.
bool isOfLevel(ivec2 texel, vec3 positionVs) {
#ifdef ONE_LEVEL
    vec3 point = pointFromEye(positionVs);
    Beam beam = beamAt(texel);
    float width = sqrt(abs(determinant(beam.place +
                                       texelFetch(hitPosition, texel, 0).w * beam.turn)));
    float wanted = width / pixelFootprint(max(-point.z, view.frustum.z));
    return clamp(int(ceil(log2(clamp(wanted, 1.0, 65536.0)))), 0, levels - 1) == level;
#else
    return true;
#endif
}

bool isInView(Splat splat) {
    vec2 at = pixelOf(splat.position);
    return all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, view.sizePixels.xy));
}

void threadMain() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    if (!hasArrived(texel)) return;
    vec3 flux = texelFetch(hitFlux, texel, 0).rgb;
    vec3 positionVs = texelFetch(hitPosition, texel, 0).xyz;
    vec4 surface = texelFetch(hitSurface, texel, 0);
    vec3 direction = texelFetch(photonDirection, texel, 0).xyz;
    Parts parts = Parts(WEIGHT(0.0), WEIGHT(0.0), WEIGHT(0.0));
    uint account = kAccountOutside;  // of a photon that finds no texel
    Splat splat;
    bool isOwn = false;
    bool isLit = true;
#ifdef BEAM_WIDTHS
    vec2 wanted = vec2(minimum);
#endif
    for (int face = 0; face < viewCount; ++face) {
#ifdef MANY_VIEWS
        viewIndex = face;
#endif
        if (!splatOf(texel, positionVs, surface.xyz, splat)) continue;
        if (isInView(splat)) isOwn = isOfLevel(texel, positionVs);
        if (isInView(splat)) {
            isLit = !isOpen(uint(surface.w) - 1u) ||
                         seesLitSide(splat.position, splat.normal, directionFromEye(direction));
            bool isHidden = lookAt(splat, ivec2(floor(pixelOf(splat.position)))) == kSeenOccluded;
            account = isHidden || !isLit ? kAccountHidden : kAccountEdgeOn;
            if (!isLit) break;
#ifdef BEAM_WIDTHS
            wanted = splat.wanted;
#endif
        }
        addParts(splat, parts);
    }
#ifdef FOUR_RADII
    bool finds = parts.deposited.w > 0.0;
#else
    bool finds = parts.deposited > 0.0;
#endif
#ifdef ONE_LEVEL
    // Next to all views it is the finest level's to say.
    if (account == kAccountOutside) isOwn = level == 0;
    if (!isOwn) return;
#endif
    // Where it arrives next to all views, or on the far side of what they see, what of it reaches into
    // one is not all of it.
    if (account == kAccountOutside || !isLit) finds = false;
    // Of coarser levels nothing is seen; what the map's own texel does not see is not in them.
    if (level > 0 && keepsEdges == 1 && account == kAccountHidden) finds = false;
    if (!finds) {
        if (isBooked()) ledgerAdd(account, flux);
        return;
    }
    if (isBooked()) countLost(parts, flux);
#ifdef BEAM_WIDTHS
    countBounds(wanted, flux);
#endif
    for (int face = 0; face < viewCount; ++face) {
#ifdef MANY_VIEWS
        viewIndex = face;
#endif
        if (splatOf(texel, positionVs, surface.xyz, splat)) splatInView(splat, parts, flux, direction);
    }
}
