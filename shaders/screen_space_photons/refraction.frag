// SPDX-License-Identifier: MIT
// What the eye sees in and through specular surfaces (K06, section 4): its ray is bent at the first
// interface and then traced on the screen through the layers of the transmitting objects. Radiance
// changes by T at every interface and by 1/n² where what is seen lies in a medium of index n (hard
// case 28a), and is absorbed on the way.
#include "screen_space_photons/next_interface.glsl"
#include "screen_space_photons/refracted_scene.glsl"

const float kFar = 1e30;

// The medium of an open surface that a ray is in, or 0: what is inside of a closed object and is
// not traced out of it is taken to see what it would outside.
uint openMedium(uint media) {
    uint medium = innerMedium(media);
    return medium != 0u && isOpen(medium - 1u) ? medium : 0u;
}

struct EyePath {
    vec3 origin;     // of its last piece
    vec3 direction;
    vec3 throughput;  // what interfaces and media leave of the radiance, without 1/n²
    uint media;
    int met;  // interfaces
    int refractions;
    int reflections;
    int passed;  // the layer that it has passed last
    float ending;  // kWay…
};

// At an interface: the path goes on refracted, or totally reflected.
Interface bend(inout EyePath path, vec3 normal, uint material, int layer) {
    bool enters = dot(path.direction, normal) < 0.0;
    vec2 indices = indicesAt(material, path.media, enters);
    Interface meeting = interactAt(path.direction, normal, indices.x, indices.y);
    ++path.met;
    if (meeting.reflectance >= 1.0) {
        ++path.reflections;
        path.direction = meeting.reflected;
        return meeting;
    }
    ++path.refractions;
    path.direction = meeting.refracted;
    path.throughput *= 1.0 - meeting.reflectance;
    if (enters && !canEnter(path.media, material)) path.ending = kWayNestedTooDeep;
    else path.media = enters ? enterMedium(path.media, material) : leaveMedium(path.media, material);
    // Behind the layer when it comes from before it, and the other way round.
    path.passed = layer > path.passed ? layer : layer - 1;
    return meeting;
}

// To the next interface before `reach`; false: there is none.
bool advance(inout EyePath path, float reach) {
    RaySegment segment = clipToDielectrics(path.origin, path.direction, reach);
    if (!segment.visible) return false;
    TracedRay ray = tracedRay(path.origin, path.direction, path.media);
    int steps = stepCount(segment, 4, 16384);
    FirstHit found = view_refraction_search == view_refraction_search_all
                         ? firstHitOfSteps(segment, ray, steps)
                         : searchBetweenLayers(segment, ray, path.passed, steps);
    if (found.hit.layer < 0) return false;
    vec4 surface = texelFetch(layerSurfaces, ivec3(found.pixel, found.hit.layer), 0);
    LayerSurface met = layerAt(found.pixel, found.hit.layer);
    path.throughput *= mediumTransmittance(innerMedium(path.media), found.hit.t);
    path.origin += found.hit.t * path.direction;
    vec3 shading =
        found.isExit ? normalAtExit(path.origin, found.pixel, found.hit.layer)
                     : normalAtHit(path.origin, surface, met, false);
    vec3 normal = bendingNormal(path.direction, shading, met.normal, met.material, path.media);
    bend(path, normal, met.material, found.hit.layer);
    return true;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    radiance = texelFetch(receiverRadiance, pixel, 0);
    exitPosition = vec4(0.0);
    exitDirection = vec4(0.0);
    if (texelFetch(interfaceDepth, pixel, 0).x <= 0.0) return;
    vec3 viewing = viewRay(gl_FragCoord.xy);
    vec3 direction = normalize(viewing);
    vec4 mirror = texelFetch(interfaceSurface, pixel, 0);
    MaterialData data = materials[uint(mirror.w) - 1u];
    if (uint(data.albedo.w) == kMaterialMirror) {
        writeMirror(pixel, viewing, mirror.xyz, data.albedo.rgb);
        return;
    }
    // The first layer is what the eye sees first.
    LayerSurface surface = layerAt(pixel, 0);
    uint material = surface.material;
    if (surface.depth <= 0.0) return;
    vec3 entry = viewing * surface.depth;
    // An eye that looks at a dielectric from within is inside of it.
    bool isEyeInside = dot(direction, surface.normal) > 0.0;
    uint mediaAtEye = isEyeInside ? enterMedium(0u, material) : 0u;

    EyePath path = EyePath(entry, direction, vec3(1.0), mediaAtEye, 0, 0, 0, -1, kWayCameOut);
    path.throughput *= mediumTransmittance(innerMedium(mediaAtEye), length(entry));
    vec3 reached = path.throughput;
    vec3 shading = texelFetch(layerSurfaces, ivec3(pixel, 0), 0).xyz;
    vec3 normal = bendingNormal(direction, shading, surface.normal, material, mediaAtEye);
    Interface first = bend(path, normal, material, 0);
    SceneHit seen;
    for (;;) {
        bool isInside = isInsideClosed(path.media);
        bool isReflected = path.reflections > view_refraction_reflections;
        bool isLast = isReflected || path.ending == kWayNestedTooDeep || path.refractions >= view_refraction_interfaces;
        seen = nothingThere();
#ifndef RECEIVERS_INSIDE
        if (!isInside)
#endif
            seen = lookThrough(path.origin, path.direction);
        if (isLast) {
            if (isInside && !seen.isFound && path.ending > 0.0) path.ending = kWayStoppedInside;
            if (isReflected) path.ending = kWayReflectedTooOften;
            break;
        }
        if (!advance(path, seen.isFound ? seen.t : kFar)) {
            if (isInside && !seen.isFound) path.ending = kWayLost;
            break;
        }
    }
    exitPosition = vec4(path.origin, float(path.met));
    exitDirection = vec4(path.direction, path.ending);

    // What was not traced out of an object is taken to see what one outside of it would.
    uint media = isInsideClosed(path.media) && !seen.isFound
                     ? leaveMedium(path.media, innerMedium(path.media)) : path.media;
    float ratio = mediumIndex(innerMedium(mediaAtEye)) / mediumIndex(innerMedium(media));
    radiance.rgb = path.throughput * ratio * ratio *
                   radianceAlong(path.origin, path.direction, openMedium(media), seen, pixel);
    if (first.reflectance < 1.0) {
        SceneHit mirrored = lookIntoMirror(entry, first.reflected);
        radiance.rgb +=
            reached * first.reflectance *
            radianceAlong(entry, first.reflected, openMedium(mediaAtEye), mirrored, pixel);
    }
    radiance.a = 1.0;
}
