// SPDX-License-Identifier: MIT
// What the eye sees in and through specular surfaces (K06, section 4): its ray is bent at the first
// interface and then traced on the screen through the layers of the transmitting objects, and from
// mirror to mirror. Radiance changes by T at every interface and by 1/n² where what is seen lies in
// a medium of index n (hard case 28a), and is absorbed on the way.
#include "include/views/scene_look.glsl"
#include "include/views/view_outputs.glsl"
#ifdef DIELECTRICS
#include "view/refraction_next_interface.glsl"
#endif

#ifdef DIELECTRICS
const float kFar = 1e30;

// The medium of an open surface that a ray is in, or 0: what is inside of a closed object and is
// not traced out of it is taken to see what it would outside.
uint openMedium(uint media) {
    uint medium = innerMedium(media);
    return medium != 0u && isOpen(medium - 1u) ? medium : 0u;
}

// The dielectric that the eye's ray meets first: of the pixel's middle the first layer.
LayerSurface firstDielectric(ivec2 pixel) {
#ifdef BESIDE_MIDDLE
    vec4 data = texelFetch(sight, pixel, 0);
    return LayerSurface(data.x, 0.0, unpackUnitVector(data.yz), uint(data.w));
#else
    return layerAt(pixel, 0);
#endif
}
vec3 shadingOfFirst(ivec2 pixel) {
#ifdef BESIDE_MIDDLE
    return firstSurface(pixel).xyz;
#else
    return texelFetch(layerSurfaces, ivec3(pixel, 0), 0).xyz;
#endif
}

struct EyePath {
    MirrorPath at;  // its last piece; its share: also what interfaces leave, without 1/n²
    int interfaces;  // of dielectrics that it has hit
    int refractions;
    int reflections;
    int passed;  // the layer that it has passed last
    float ending;  // kPath…
};

// At an interface: the path goes on refracted, or totally reflected.
Interface bend(inout EyePath path, vec3 normal, uint material, int layer) {
    bool enters = dot(path.at.direction, normal) < 0.0;
    vec2 indices = indicesAt(material, path.at.media, enters);
    Interface interaction = interactAt(path.at.direction, normal, indices.x, indices.y);
    ++path.interfaces;
    path.at.media = withLeftSide(path.at.media, kLeftNone);
    if (interaction.reflectance >= 1.0) {
        ++path.reflections;
        path.at.direction = interaction.reflected;
        return interaction;
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
    // Beyond the layer when it comes from in front of it, and the other way round.
    path.passed = layer > path.passed ? layer : layer - 1;
    return interaction;
}

// To the next interface before `reach`; false: there is none. Beyond a mirror nothing is known of
// the order of the layers: all are asked.
bool advance(inout EyePath path, float reach) {
    RaySegment segment = clipToDielectrics(path.at.origin, path.at.direction, reach);
    if (!segment.visible) return false;
    TracedRay ray = tracedRay(path.at.origin, path.at.direction, path.at.media);
    int steps = stepCount(segment, 4, 16384);
    bool searchesAll = view_refraction_search == view_refraction_search_all || path.at.mirrors > 0;
    FirstHit found = searchesAll ? firstHitOfSteps(segment, ray, steps)
                             : searchBetweenLayers(segment, ray, path.passed, steps);
    if (found.hit.layer < 0) return false;
    vec4 surface = texelFetch(layerSurfaces, ivec3(found.pixel, found.hit.layer), 0);
    LayerSurface layer = layerAt(found.pixel, found.hit.layer);
    path.at.share *= mediumTransmittance(innerMedium(path.at.media), found.hit.t);
    path.at.origin += found.hit.t * path.at.direction;
    vec3 shading =
        found.isExit ? normalAtExit(path.at.origin, found.pixel, found.hit.layer)
                     : smoothSurfaceAt(path.at.origin, surface, layer).normal;
    vec3 normal =
        bendingNormal(path.at.direction, shading, layer.normal, layer.material, path.at.media);
    bend(path, normal, layer.material, found.hit.layer);
    return true;
}

// The path to what it sees at last.
SceneHit follow(inout EyePath path) {
    SceneHit seen;
    for (;;) {
        bool isInside = isInsideClosed(path.at.media);
        bool isReflected = path.reflections > view_refraction_reflections;
        bool isLast = isReflected || path.refractions >= view_refraction_interfaces;
        seen = noSceneHit();
#ifndef SCENE_INSIDE
        if (!isInside)
#endif
            seen = lookThrough(path.at.origin, path.at.direction, path.at.media);
        bool isFound = seen.material != 0u;
        if (isReflected) path.ending = kPathReflectionLimit;
        if (path.ending <= kPathLost) return seen;
        if (!isLast && advance(path, isFound ? seen.t : kFar)) continue;
        if (isFound && seen.isMirror) {
            if (path.at.mirrors >= lookMirrors) {
                path.ending = kPathMirrorLimit;
                return noSceneHit();
            }
            path.at.share *= mediumTransmittance(innerMedium(path.at.media), seen.t);
            reflectAt(path.at, path.at.origin + seen.t * path.at.direction, seen.normal,
                      seen.material);
            continue;
        }
        if (isInside && !isFound) path.ending = isLast ? kPathEndedInside : kPathLost;
        return seen;
    }
}
#endif

void look(ivec2 pixel) {
    radiance = radianceStraight(pixel);
    exitPosition = vec4(0.0);
    exitDirection = vec4(0.0);
    if (firstDepth(pixel) <= 0.0) return;
    vec3 viewing = viewRay(positionOfSample(pixel));
#ifndef DIELECTRICS
    MirrorView mirrored = lookIntoMirror(pixel, viewing);
    radiance = vec4(mirrored.radiance, 1.0);
    exitPosition = mirrored.exitPosition;
    exitDirection = mirrored.exitDirection;
#else
    vec3 direction = normalize(viewing);
    vec4 mirror = firstSurface(pixel);
    EyePath path = EyePath(MirrorPath(vec3(0.0), direction, vec3(1.0), 0u, 0), 0, 0, 0, -1,
                           kPathExited);
    uint mediaAtEye = 0u;
    vec3 reflected = vec3(0.0);
    if (materialKind(uint(mirror.w) - 1u) == kMaterialMirror) {
        reflectAt(path.at, viewing * firstDepth(pixel), mirror.xyz, uint(mirror.w));
    } else {
        LayerSurface surface = firstDielectric(pixel);
        if (surface.depth <= 0.0) return;
        vec3 entry = viewing * surface.depth;
        // An eye that looks at a dielectric from within is inside of it.
        bool isEyeInside = dot(direction, surface.normal) > 0.0;
        if (isEyeInside) mediaAtEye = enterMedium(0u, surface.material);
        path.at.origin = entry;
        path.at.media = mediaAtEye;
        path.at.share = mediumTransmittance(innerMedium(mediaAtEye), length(entry));
        vec3 reached = path.at.share;
        vec3 shading = shadingOfFirst(pixel);
        vec3 normal =
            bendingNormal(direction, shading, surface.normal, surface.material, mediaAtEye);
        Interface first = bend(path, normal, surface.material, 0);
        if (first.reflectance < 1.0) {
            reflected = reached * first.reflectance *
                        radianceReflected(entry, first.reflected, openMedium(mediaAtEye),
                                          mediaAtEye, pixel);
        }
    }
    SceneHit seen = follow(path);
    exitPosition = vec4(path.at.origin, float(path.interfaces + path.at.mirrors));
    exitDirection = vec4(path.at.direction, path.ending);

    // What was not traced out of an object is taken to see what one outside of it would.
    uint media = isInsideClosed(path.at.media) && seen.material == 0u
                     ? leaveMedium(path.at.media, innerMedium(path.at.media))
                     : path.at.media;
    float ratio = mediumIndex(innerMedium(mediaAtEye)) / mediumIndex(innerMedium(media));
    radiance.rgb = reflected + path.at.share * ratio * ratio *
                                   radianceAlong(path.at.origin, path.at.direction,
                                                 openMedium(media), seen, pixel);
    radiance.a = 1.0;
#endif
}

void main() {
    look(ivec2(gl_FragCoord.xy));
    finishPixel();
}
