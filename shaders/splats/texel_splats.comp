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
#include "include/photons/arriving.glsl"
#include "include/photons/ledger.glsl"
#include "include/surfaces/surface_data.glsl"
#include "maps/levels.glsl"
#include "include/views/seen_receiver.glsl"
#include "include/maps/deposit.glsl"

uniform int mapsPerView;
uniform int countsPerView;
uniform float diameter;   // texels
uniform int keepsEdges;   // 1: only texels that see the photon's own surface
uniform int atTexels;     // 1: centred on the texel that the photon falls into
uniform int level;
#ifdef BEAM_WIDTHS
uniform float widths;     // of a beam that a splat's diameter is
uniform float minimum;      // texels
uniform float maximum;
layout(std430) buffer CutSplats {
    Narrowed narrowed;
};
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
    float radius;  // texels
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
    float depth = depthOnPlane(texel, splat.normal, splat.position, facing);
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

void add(ivec2 texel, int set, vec3 flux) {
    sumAdd(placeOfLevel(level) + texel, viewIndex * mapsPerView + set + setOfLevel(level),
           flux * ledgerUnitsPerWatt);
}

void count(ivec2 texel, int set) {
#ifdef COUNTS
    imageAtomicAdd(photonCounts,
                   ivec3(placeOfLevel(level) + texel,
                         viewIndex * countsPerView + set + setOfLevel(level)), 1u);
#endif
}

void deposit(Splat splat, ivec2 texel, WEIGHT share, vec3 flux, vec3 direction) {
#ifdef FOUR_RADII
    for (int i = 0; i < 4; ++i) {
        if (share[i] <= 0.0) continue;
        add(texel, i, flux * share[i]);
        count(texel, i);
    }
    float widest = share[3];
#else
    add(texel, 0, flux * share);
    count(texel, 0);
    float widest = share;
#endif
    if (level == 0)
        depositGlossy(texel, viewIndex * mapsPerView + mapsPerView - 1, flux * widest, direction);
}

float reachOf(Splat splat) {
#ifdef FOUR_RADII
    return 7.5;
#else
    return max(splat.radius, 0.5);
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

float radiusOf(ivec2 texel, vec3 position) {
#ifdef BEAM_WIDTHS
    Beam beam = beamAt(texel);
    float width = sqrt(abs(determinant(beam.place +
                                       texelFetch(hitPosition, texel, 0).w * beam.turn)));
    float wanted = widths * width / pixelFootprint(-position.z);
    if (wanted > maximum) {
        atomicAdd(narrowed.count, 1u);
        atomicMax(narrowed.widestBits, floatBitsToUint(wanted));
    }
    return 0.5 * clamp(wanted, minimum, maximum);
#else
    return 0.5 * diameter;
#endif
}

// Of a photon that arrives at `positionVs`, in the current view; false where none of it lies there.
// A splat at the edge of one face of a cube goes on in the next.
bool splatOf(ivec2 texel, vec3 positionVs, vec3 normalVs, out Splat splat) {
    splat.position = pointFromEye(positionVs);
    if (-splat.position.z <= view.frustum.z) return false;
    splat.normal = directionFromEye(normalVs);
    splat.radius = radiusOf(texel, splat.position);
    splat.center = pixelOf(splat.position) / float(1 << level);
    if (atTexels == 1) splat.center = floor(splat.center) + 0.5;
    vec2 outside = max(-splat.center, splat.center - vec2(sizeOfLevel(level)));
    return all(lessThan(outside, vec2(reachOf(splat))));
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

void main() {
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
    for (int face = 0; face < viewCount; ++face) {
#ifdef MANY_VIEWS
        viewIndex = face;
#endif
        if (splatOf(texel, positionVs, surface.xyz, splat)) splatInView(splat, parts, flux, direction);
    }
}
