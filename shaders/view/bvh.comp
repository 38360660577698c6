// SPDX-License-Identifier: MIT
// What the eye sees in and through specular surfaces, by rays that are traced exactly: refracted
// and totally reflected as often as it takes, both branches followed at the first interfaces.
// Radiance changes by T or R at every interface and by 1/n² where what is seen lies in a medium of
// index n (hard case 28a), and is absorbed on the way. One thread a pixel of those that look at
// something specular.
#include "include/surfaces/bvh.glsl"
#include "include/surfaces/environment.glsl"
#include "include/surfaces/side_rule.glsl"
#include "include/views/mirror_path.glsl"
#include "include/thread.glsl"
#include "view/bvh_pixels.glsl"

// What the ray that is being traced may hit.
const uint kHitsAll = 0u;        // from the eye: every surface from both sides
const uint kHitsBySide = 1u;     // as a photon would
const uint kHitsBlockers = 2u;   // to a light: every surface, but for the triangle that it starts on
uint raysHits = kHitsAll;
TracedRay tracedNow;
uint startTriangle = kBvhNone;
float resolvedNow = 0.0;  // m

bool isSurfaceHit(BvhRay ray, uint triangle, vec3 normal, float height) {
    if (raysHits == kHitsAll) return true;
    if (raysHits == kHitsBlockers) return triangle != startTriangle && abs(height) > resolvedNow;
    return isFacing(tracedNow, bvhSources[triangle].material, normal, height, resolvedNow);
}

const uint kMaxBranches = 4u;  // view.bvh.branches, at most

struct EyePath {
    MirrorPath at;  // its last piece; its share: also what interfaces leave, without 1/n²
    bool isFromEye;  // it has met nothing yet
    int interfaces;  // of dielectrics that it has hit
    int refractions;
    int reflections;  // total ones
    float meters;     // long
    float ending;     // kPath…
};

float indexAtEye = 1.0;  // of what is around it

// A surface that a path has hit.
struct Seen {
    vec3 positionVs;
    vec3 shading;    // unit, outward
    vec3 geometric;  // the same of the triangle
    uint material;   // + 1; 0: there is none
    float pathMeters;  // from the eye, where it is a receiver
    BvhHit hit;
};
#include "view/seen_receiver.glsl"

Seen seenBy(EyePath path) {
    BvhRay ray = bvhRay(path.at.origin, path.at.direction);
    raysHits = path.isFromEye ? kHitsAll : kHitsBySide;
    tracedNow = tracedRay(ray.origin, ray.direction, path.at.media);
    // A ray that is traced exactly is known to a few roundings.
    resolvedNow = localRounding + 4e-6 * length(path.at.origin);
    BvhHit hit = traceBvh(ray, 3.0e38);
    Seen seen = Seen(path.at.origin, vec3(0.0), vec3(0.0), 0u, 0.0, hit);
    if (hit.triangle == kBvhNone) return seen;
    PointOnTriangle point = pointOfHit(ray, hit);
    seen.positionVs = path.at.origin + hit.distance * path.at.direction;
    seen.shading = localToEye(shadingNormal(point.normal, point.geometric));
    seen.geometric = localToEye(point.geometric);
    seen.material = bvhSources[hit.triangle].material;
    return seen;
}

// Over what a pixel's footprint after a path of this length covers. By the place alone: of the ray
// that has hit it Mesa's software rasteriser has forgotten some of what threads knew that left the
// loop before others.
vec3 albedoOfSeen(Seen seen) {
    VertexData corners[3];
    for (uint i = 0u; i < 3u; ++i)
        corners[i] = bvhCornerAt(seen.hit.triangle, i);
    vec3 place = (localFromEye * vec4(seen.positionVs, 1.0)).xyz;
    vec3 area = cross(corners[1].position - corners[0].position,
                      corners[2].position - corners[0].position);
    float size2 = max(dot(area, area), 1e-30);
    vec2 uv = vec2(0.0);
    for (int i = 0; i < 3; ++i) {
        vec3 across = cross(corners[(i + 1) % 3].position - place,
                            corners[(i + 2) % 3].position - place);
        uv += dot(across, area) / size2 * vec2(corners[i].u, corners[i].v);
    }
    vec2 uvSide = vec2(corners[1].u - corners[0].u, corners[1].v - corners[0].v);
    float side = max(distance(corners[1].position, corners[0].position), 1e-12);
    float width = pixelFootprint(seen.pathMeters) * length(uvSide) / side;
    return albedoOver(seen.material - 1u, uv, vec2(width, 0.0), vec2(0.0, width));
}

bool isShadowed(Seen seen, int light, vec3 toLight) {
    bool isSun = uint(lights[light].positionVs.w) == kLightDirectional;
    float reach = isSun ? 3.0e38 : length(lights[light].positionVs.xyz - seen.positionVs);
    BvhRay ray = bvhRay(seen.positionVs, toLight);
    raysHits = kHitsBlockers;
    startTriangle = seen.hit.triangle;
    resolvedNow = localRounding + 4e-6 * length(seen.positionVs);
    return isBlocked(ray, reach);
}

// View depth where the path's last piece begins, m, where that lies under water.
float depthUnderWater(EyePath path) {
    uint medium = innerMedium(path.at.media);
    bool isUnderWater = medium != 0u && isOpen(medium - 1u) && path.refractions > 0;
    return isUnderWater ? -path.at.origin.z : kNotUnderWater;
}

// What is seen in the end, times what the path leaves of it.
vec3 radianceAtEnd(EyePath path, Seen seen) {
    uint media = path.at.media;
    // What was not traced out of an object is taken to see what one outside of it would.
    while (seen.material == 0u && isInsideClosed(media))
        media = leaveMedium(media, innerMedium(media));
    uint medium = innerMedium(media);
    float ratio = indexAtEye / mediumIndex(medium);
    vec3 sum = seen.material == 0u
                   ? environmentRadiance(path.at.direction) * mediumTransmittance(medium, 1e30)
                   : radianceOfReceiver(seen, path.at.direction, depthUnderWater(path));
    return path.at.share * ratio * ratio * sum;
}

EyePath waiting[kMaxBranches + 1u];  // still to be followed
int waitingCount = 0;

// At a dielectric: the path goes on refracted, or totally reflected; the other branch waits where it
// is to be followed.
void bend(inout EyePath path, vec3 normal, uint material) {
    bool enters = dot(path.at.direction, normal) < 0.0;
    vec2 indices = indicesAt(material, path.at.media, enters);
    Interface interaction = interactAt(path.at.direction, normal, indices.x, indices.y);
    path.at.media = withLeftSide(path.at.media, kLeftNone);
    ++path.interfaces;
    if (interaction.reflectance >= 1.0) {
        ++path.reflections;
        path.at.direction = interaction.reflected;
        return;
    }
    if (path.interfaces <= view_bvh_branches && interaction.reflectance > 0.0) {
        EyePath reflected = path;
        reflected.at.direction = interaction.reflected;
        reflected.at.share *= interaction.reflectance;
        waiting[waitingCount++] = reflected;
    }
    ++path.refractions;
    path.at.direction = interaction.refracted;
    path.at.share *= 1.0 - interaction.reflectance;
    if (enters && !canEnter(path.at.media, material)) {
        path.ending = kPathNestingLimit;
    } else {
        path.at.media = enters ? enterMedium(path.at.media, material)
                               : leaveMedium(path.at.media, material);
    }
}

// An eye that looks at a dielectric from within is inside of it.
void meetFirst(inout EyePath path, Seen seen) {
    path.isFromEye = false;
    bool isDielectric = materialKind(seen.material - 1u) == kMaterialDielectric;
    if (isDielectric && dot(path.at.direction, seen.geometric) > 0.0)
        path.at.media = enterMedium(0u, seen.material);
    indexAtEye = mediumIndex(innerMedium(path.at.media));
}

// To what the path sees in the end.
Seen follow(inout EyePath path) {
    while (true) {
        Seen seen = seenBy(path);
        if (seen.material == 0u) {
            if (isInsideClosed(path.at.media)) path.ending = kPathLost;
            return seen;
        }
        if (path.isFromEye) meetFirst(path, seen);
        uint kind = materialKind(seen.material - 1u);
        path.at.share *= mediumTransmittance(innerMedium(path.at.media), seen.hit.distance);
        path.meters += seen.hit.distance;
        if (isReceiver(kind)) {
            seen.pathMeters = path.meters;
            return seen;
        }
        path.at.origin = seen.positionVs;
        vec3 normal = bendingNormal(path.at.direction, seen.shading, seen.geometric, seen.material,
                                    path.at.media);
        if (kind == kMaterialMirror) {
            if (path.at.mirrors >= view_bvh_mirrors) path.ending = kPathMirrorLimit;
            reflectAt(path.at, seen.positionVs, normal, seen.material);
        } else {
            bend(path, normal, seen.material);
        }
        if (path.reflections > view_bvh_reflections) path.ending = kPathReflectionLimit;
        if (path.refractions > view_bvh_interfaces) path.ending = kPathEndedInside;
        seen.material = 0u;
        if (path.ending != kPathExited) return seen;
    }
}

void storeExitOf(EyePath path) {
    // At a silhouette the ray may pass what the picture has there.
    int hits = path.interfaces + path.at.mirrors;
    storeExit(pixelNow, vec4(path.at.origin, float(hits)),
              hits > 0 ? vec4(path.at.direction, path.ending) : vec4(0.0));
}

vec3 radianceThroughPixel() {
    vec3 viewing = viewRay(positionOfSample(pixelNow));
    waiting[0] = EyePath(MirrorPath(viewing * view.frustum.z, normalize(viewing), vec3(1.0), 0u, 0),
                         true, 0, 0, 0, length(viewing * view.frustum.z), kPathExited);
    waitingCount = 1;
    bool isFirst = true;
    vec3 sum = vec3(0.0);
    while (waitingCount > 0) {
        EyePath path = waiting[--waitingCount];
        Seen seen = follow(path);
        if (isFirst) storeExitOf(path);
        isFirst = false;
        sum += radianceAtEnd(path, seen);
    }
    return sum;
}

void main() {
    uint index = threadNumber();
    if (index >= lookedThrough.count) return;
    pixelNow = listedPixel(index);
    storeRadiance(pixelNow, vec4(radianceThroughPixel(), 1.0));
}
