// SPDX-License-Identifier: MIT
// The first surface on a ray among the layers around a caustic generator (U08, section 3): linear
// search for a change from in front of a slot's surface to beyond it or back, then secants within
// that bracket, bounded. A texel stands for the plane of its triangle. What the bracket ends with
// is a hit if it lies on that surface by what a texel resolves, the residual.
#include "include/photons/traced_photon.glsl"

uniform usampler2DArray layerOrder;

const int kMaxSlots = 8;
const uint kNoLayer = 15u;
// What a slot has none of is taken to be infinitely far.
const float kNoDistance = 1.0e30;

// A ray in the world's axes from the reference point, m.
struct AroundRay {
    vec3 origin;
    vec3 direction;
    float far;
};

// Where a point is in the cube, whose face becomes the view.
struct AroundPlace {
    ivec2 texel;
    vec3 point;  // of the face's view
    uint order;
};

vec3 toWorld(vec3 inView) {
    return mat3(view.viewToWorld) * inView;
}
vec3 fromWorld(vec3 world) {
    return world * mat3(view.viewToWorld);
}

AroundPlace placeAt(vec3 world) {
    vec3 size = abs(world);
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    viewIndex = 2 * axis + (world[axis] < 0.0 ? 1 : 0);
    AroundPlace place;
    place.point = fromWorld(world);
    place.point.z = min(place.point.z, -1e-3 * view.frustum.z);
    place.texel =
        clamp(ivec2(floor(pixelOf(place.point))), ivec2(0), ivec2(view.sizePixels.xy) - 1);
    place.order = texelFetch(layerOrder, ivec3(place.texel, viewIndex), 0).x;
    return place;
}

int layerOfSlot(AroundPlace place, int slot) {
    uint layer = bitfieldExtract(place.order, 4 * slot, 4);
    return layer == kNoLayer ? -1 : int(layer);
}

// By how much the place lies beyond a slot's surface, in depth, m: overshooting; below 0:
// undershooting.
float beyondSlot(AroundPlace place, int slot) {
    int layer = layerOfSlot(place, slot);
    if (layer < 0) return -kNoDistance;
    vec4 data = texelFetch(layerDepths, layerTexel(place.texel, layer), 0);
    vec3 normal = unpackUnitVector(data.yz);
    float depth = -place.point.z;
    float atMiddle = dot(normal, viewRay(vec2(place.texel) + 0.5));
    float facing = dot(normal, place.point) / depth;
    // Seen edge-on a plane says nothing of the rest of the texel.
    bool isEdgeOn = abs(facing) < 1e-2 || facing * atMiddle <= 0.0;
    return depth - data.x * (isEdgeOn ? 1.0 : atMiddle / facing);
}

// Ray parameters by the angle that the reference point sees: equal steps of it are equal numbers of
// texels.
struct AngularSteps {
    float middle;    // parameter nearest to the reference point, m
    float distance;  // there, m
    float first;     // angles at the ends, rad
    float last;
    int count;
};

AngularSteps angularSteps(AroundRay ray, float stride, int maximum) {
    AngularSteps steps;
    steps.middle = -dot(ray.origin, ray.direction);
    steps.distance =
        max(length(ray.origin + steps.middle * ray.direction), view.frustum.z);
    steps.first = atan(-steps.middle, steps.distance);
    steps.last = atan(ray.far - steps.middle, steps.distance);
    float texel = 2.0 * view.sizePixels.z;  // rad, in the middle of a face
    float wanted = ceil((steps.last - steps.first) / (stride * texel));
    steps.count = int(clamp(wanted, 2.0, float(maximum)));
    return steps;
}

float parameterOf(AngularSteps steps, AroundRay ray, int i) {
    if (i >= steps.count) return ray.far;
    float angle = mix(steps.first, steps.last, float(i) / float(steps.count));
    return clamp(steps.middle + steps.distance * tan(angle), 0.0, ray.far);
}

struct Bracket {
    float low;   // ray parameters, m
    float high;
    float beyondLow;  // beyondSlot there, of different signs
    float beyondHigh;
    int slot;
};

// Whether something is seen about where the plane of a texel is met: in that texel its surface, in
// another one any. Past a silhouette nothing is, and planes have no end.
bool isSurfaceAt(vec3 world, FirstHit found, float margin) {
    AroundPlace place = placeAt(world);
    bool isSame = place.texel == found.pixel && viewIndex == found.face;
    for (int slot = 0; slot < layerCount && !isSame; ++slot) {
        int layer = layerOfSlot(place, slot);
        if (layer < 0) continue;
        float allowed = max(margin, layerAt(place.texel, layer).margin);
        isSame = abs(beyondSlot(place, slot)) <= allowed;
    }
    viewIndex = found.face;
    return isSame;
}

bool arrivesAt(FirstHit found) {
    uint material = uint(texelFetch(layerSurfaces, layerTexel(found.pixel, found.hit.layer), 0).w);
    return isReceiver(materialKind(material - 1u));
}

// Where the ray meets the slot's surface within the bracket, and by which texel and layer; layer < 0
// where no place that was looked at lies on it. Never more than `maximum` looks (hard case 35).
FirstHit secantIn(AroundRay ray, TracedRay photon, Bracket bracket, int maximum) {
    FirstHit found = noHit();
    float low = bracket.low;
    float high = bracket.high;
    float beyondLow = bracket.beyondLow;
    float beyondHigh = bracket.beyondHigh;
    float nearest = kNoDistance;
    int side = 0;
    for (int i = 0; i < maximum; ++i) {
        float difference = beyondHigh - beyondLow;
        bool isSecant = abs(difference) < 0.5 * kNoDistance && difference != 0.0;
        float share = isSecant ? -beyondLow / difference : 0.5;
        float t = mix(low, high, clamp(share, 0.0, 1.0));
        AroundPlace place = placeAt(ray.origin + t * ray.direction);
        float beyond = beyondSlot(place, bracket.slot);
        if (abs(beyond) < nearest) {
            nearest = abs(beyond);
            found.hit = LayerHit(t, layerOfSlot(place, bracket.slot));
            found.pixel = place.texel;
            found.face = viewIndex;
        }
        if (nearest <= 1e-6 * -place.point.z) break;
        // An end that stays twice counts half (Illinois), so that the other one comes nearer too.
        if ((beyond < 0.0) == (beyondLow < 0.0)) {
            low = t;
            beyondLow = beyond;
            if (side < 0 && isSecant) beyondHigh *= 0.5;
            side = -1;
        } else {
            high = t;
            beyondHigh = beyond;
            if (side > 0 && isSecant) beyondLow *= 0.5;
            side = 1;
        }
    }
    if (found.hit.layer < 0) return found;
    viewIndex = found.face;
    LayerSurface surface = layerAt(found.pixel, found.hit.layer);
    vec3 origin = fromWorld(ray.origin);
    vec3 direction = fromWorld(ray.direction);
    TracedRay here = TracedRay(origin, direction, photon.media, photon.around);
    if (nearest > surface.margin || !isFacingAt(here, found.pixel, surface)) {
        found.hit.layer = -1;
        return found;
    }
    // On the plane itself, where that is about there.
    float closing = dot(surface.normal, direction);
    float slack = 0.5 * (bracket.high - bracket.low);
    if (abs(closing) > 1e-4) {
        float t = -heightAbove(origin, surface.normal, found.pixel, surface.depth) / closing;
        if (abs(t - found.hit.t) <= slack && t > 0.0) {
            if (arrivesAt(found) && !isSurfaceAt(ray.origin + t * ray.direction, found, surface.margin)) {
                found.hit.layer = -1;
                return found;
            }
            found.hit.t = t;
        }
    }
    return found;
}

// `isCut`: it ends beyond more surfaces than there are slots.
FirstHit searchAround(Photon photon, float stride, int maximum, int refinements, out bool isCut) {
    FirstHit first = noHit();
    isCut = false;
    if (!isNumber(photon)) return first;
    viewIndex = 0;
    vec3 origin = pointFromEye(photon.positionVs);
    vec3 direction = directionFromEye(photon.directionVs);
    float low = 0.0;
    float high = 3.0e38;
    cutToBox(origin, direction, view.boundsCenterVs.xyz, view.boundsHalfExtent.xyz, low, high);
    if (low > high) return first;
    AroundRay ray = AroundRay(toWorld(origin), toWorld(direction), high);
    TracedRay traced = tracedRay(origin, direction, photon.media);
    AngularSteps steps = angularSteps(ray, stride, maximum);
    float before = 0.0;
    float beyondBefore[kMaxSlots];
    AroundPlace place = placeAt(ray.origin);
    for (int slot = 0; slot < kMaxSlots; ++slot)
        beyondBefore[slot] = slot < layerCount ? beyondSlot(place, slot) : -kNoDistance;
    for (int i = 1; i <= steps.count && first.hit.layer < 0; ++i) {
        float t = max(parameterOf(steps, ray, i), before);
        place = placeAt(ray.origin + t * ray.direction);
        int face = viewIndex;
        isCut = i == steps.count;
        for (int slot = 0; slot < layerCount; ++slot) {
            viewIndex = face;
            float beyond = beyondSlot(place, slot);
            if (beyond < 0.0) isCut = false;
            if ((beyond < 0.0) != (beyondBefore[slot] < 0.0)) {
                Bracket bracket = Bracket(before, t, beyondBefore[slot], beyond, slot);
                FirstHit found = secantIn(ray, traced, bracket, refinements);
                if (found.hit.layer >= 0 && (first.hit.layer < 0 || found.hit.t < first.hit.t))
                    first = found;
            }
            beyondBefore[slot] = beyond;
        }
        before = t;
    }
    return first;
}
