// SPDX-License-Identifier: MIT
// What a ray that has left the dielectrics sees (K06, section 4, Fig. 10), from mirror to mirror:
// the receivers of the eye buffer, where its image shows them, and else the environment.
// "This is an approximation that can only simulate the refraction of [...] objects that are visible
// to the viewer in the absence of the water surface". LOOK_IN_LAYERS: surfaces are looked for in
// the layered depth of the scene, as in the paper; one that the image does not show is lit here.
#include "include/views/hit_test.glsl"
#include "include/views/view_sample.glsl"
#include "include/surfaces/environment.glsl"
#include "include/views/mirror_path.glsl"
#include "include/views/shown_radiance.glsl"
#ifdef LOOK_IN_LAYERS
uniform sampler2DArray sceneDepths;
uniform sampler2DArray sceneSurfaces;
uniform int sceneLayers;
#endif

uniform int searchesScene;  // else only at the environment
uniform int reflectsScene;   // the same for reflections at the first interface
uniform int searchStride;      // px
uniform int lookMirrors;     // most mirrors that a ray hits one after the other
struct SceneHit {
    uint material;  // index + 1 of a receiver or a mirror; 0: nothing is found
    bool isMirror;
    bool isOpen;  // not found, because nothing is there: the ray leaves the scene on the screen
    float t;      // m; not found: to where the scene ends
    ivec2 lastPixel;  // not found: of the screen, where the ray leaves the scene or next to that
    vec3 normal;      // of a mirror: unit, outward
    vec3 radiance;    // of a receiver
};

SceneHit noSceneHit() {
    return SceneHit(0u, false, true, 0.0, ivec2(-1), vec3(0.0), vec3(0.0));
}

// What the ray passes last, where the screen shows nothing of what it hits.
SceneHit emptySceneHit(vec3 origin, vec3 direction, bool isOpen) {
    float low = 0.0;
    float high = 3.0e38;
    cutToBox(origin, direction, view.boundsCenterVs.xyz, view.boundsHalfExtent.xyz, low, high);
    cutToNearPlane(origin, direction, low, high);
    SceneHit none = noSceneHit();
    none.isOpen = isOpen;
    if (high < low) return none;
    none.t = high;
    vec3 end = origin + high * direction;
    vec2 pixel = pixelOf(vec3(end.xy, min(end.z, -view.frustum.z)));
    none.lastPixel = ivec2(clamp(floor(pixel), vec2(0.0), view.sizePixels.xy - 1.0));
    return none;
}

// A mirror's normal, which may be curved, between the pixels around; `surface` is the hit pixel's.
vec3 mirrorNormalAround(vec3 hitVs, vec4 surface) {
    vec2 corner = pixelOf(hitVs) - 0.5;
    ivec2 first = ivec2(floor(corner));
    vec2 f = corner - vec2(first);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        ivec2 other = clamp(first + step, ivec2(0), ivec2(view.sizePixels.xy) - 1);
        vec4 there = texelFetch(receiverSurface, other, 0);
        if (texelFetch(receiver, other, 0).x >= 0.0 || there.w != surface.w) continue;
        // A crease of more than 60 degrees is an edge, not a curve.
        if (dot(there.xyz, surface.xyz) < 0.5) continue;
        vec2 axis = mix(1.0 - f, f, vec2(step));
        sum += axis.x * axis.y * there.xyz;
    }
    float size = length(sum);
    return size > 1e-3 ? sum / size : surface.xyz;
}

#ifndef LOOK_IN_LAYERS
// The first receiver or mirror of a pixel, by its shading normal; depth 0: there is none.
LayerSurface seenAt(ivec2 texel) {
    vec4 surface = texelFetch(receiverSurface, texel, 0);
    float depth = abs(texelFetch(receiver, texel, 0).x);
    float margin = depthMargin(viewRay(vec2(texel) + 0.5), depth, surface.xyz);
    return LayerSurface(depth, margin, surface.xyz, uint(surface.w));
}

const int kBefore = 0;
const int kAround = 1;  // so near that the pixel's depth in its middle does not tell
const int kBehind = 2;

// The first receiver or mirror that the eye sees. `searchStride` pixels are looked at together: where
// the ray comes from in front of the surfaces to beyond them, or is near one, all pixels between
// are asked, and the last ones, since the ray ends just behind the scene's last surface.
SceneHit searchScene(TracedRay ray) {
    RaySegment segment = clipRay(ray.origin, ray.direction);
    if (!segment.visible) return emptySceneHit(ray.origin, ray.direction, false);
    int n = stepCount(segment, 4, 16384);
    int before = kBefore;
    for (int look = 0; look < n; look += searchStride) {
        int last = min(look + searchStride, n) - 1;
        LayerSurface there = seenAt(texelOfStep(segment, last, n));
        float beyond = depthAtIndex(segment, float(last) + 1.0, float(n)) - there.depth;
        int place = there.depth <= 0.0 || beyond < -there.margin ? kBefore
                    : beyond > there.margin                      ? kBehind
                                                                 : kAround;
        bool isQueried = before == kAround || place == kAround || last == n - 1 ||
                       (before == kBefore && place == kBehind);
        before = place;
        for (int i = isQueried ? look : last + 1; i <= last; ++i) {
            RayStep at = rayStep(segment, i, n);
            LayerSurface surface = seenAt(at.texel);
            if (surface.depth <= 0.0) continue;
            float t = crossLayer(ray, at, surface);
            if (t <= 0.0 || !isFacingAt(ray, at.texel, surface)) continue;
            vec3 hitVs = ray.origin + t * ray.direction;
            if (materialKind(surface.material - 1u) == kMaterialMirror) {
                vec4 shaded = vec4(surface.normal, float(surface.material));
                return SceneHit(surface.material, true, false, t, at.texel,
                                mirrorNormalAround(hitVs, shaded), vec3(0.0));
            }
            return SceneHit(surface.material, false, false, t, at.texel, vec3(0.0),
                            radianceOfSeen(hitVs, ray.direction, at.texel, surface.normal,
                                           surface.material, surface.normal));
        }
    }
    return emptySceneHit(ray.origin, ray.direction,
                        before != kBehind && segment.cause == kAccountUnresolved);
}
#else
LayerSurface sceneLayerAt(ivec2 texel, int layer) {
    vec4 data = texelFetch(sceneDepths, ivec3(texel, layer), 0);
    vec3 normal = unpackUnitVector(data.yz);
    float margin = depthMargin(viewRay(vec2(texel) + 0.5), data.x, normal);
    return LayerSurface(data.x, margin, normal, uint(data.w));
}

struct SceneLayerHit {
    float t;  // 0: none
    ivec2 texel;
    int layer;
};

// The first surface of all layers; `includesDielectrics`: of those too. A hit may lie half a step
// beyond its own, and the next step know a nearer one: it is asked too.
SceneLayerHit searchSceneLayers(TracedRay ray, RaySegment segment, bool includesDielectrics) {
    SceneLayerHit best = SceneLayerHit(0.0, ivec2(0), -1);
    int n = stepCount(segment, 4, 16384);
    int end = n;
    for (int i = 0; i < end; ++i) {
        RayStep at = rayStep(segment, i, n);
        for (int layer = 0; layer < sceneLayers; ++layer) {
            LayerSurface surface = sceneLayerAt(at.texel, layer);
            if (surface.depth <= 0.0) break;
            if (!includesDielectrics && materialKind(surface.material - 1u) == kMaterialDielectric)
                continue;
            float t = crossLayer(ray, at, surface);
            if (t <= 0.0 || (best.layer >= 0 && t >= best.t)) continue;
            if (!isFacingAt(ray, at.texel, surface)) continue;
            if (best.layer < 0) end = min(end, i + 2);
            best = SceneLayerHit(t, at.texel, layer);
        }
    }
    return best;
}

// Reflectance of a material over all of its surface: where on it a hidden point lies is not known.
vec3 meanAlbedo(uint material) {
    MaterialData data = materials[material];
    uint pattern = uint(data.patternAlbedo.w);
    // A checker's squares are alike; of tiles the joints take 4 % of each side.
    float second = pattern == 1u ? 0.5 : pattern == 2u ? 1.0 - 0.96 * 0.96 : 0.0;
    vec3 albedo = mix(data.albedo.rgb, data.patternAlbedo.rgb, second);
    if (data.uv.z >= 0.0) albedo *= textureLod(sceneImages, vec3(0.5, 0.5, data.uv.z), 99.0).rgb;
    return albedo;
}

// Radiance of a receiver that the image does not show, back along a ray: of its fill light, and of
// the lights what comes through the layers (K06, section 5), past whatever lies off the screen.
// `normal`: unit, towards the side that is looked at.
vec3 radianceOfHidden(vec3 hitVs, vec3 direction, vec3 normal, uint material) {
    vec3 albedo = meanAlbedo(material - 1u);
    vec4 lobe = materials[material - 1u].specular;
    vec3 radiance = (albedo + lobe.rgb) * (1.0 / 3.14159265) * view.ambient.rgb;
    for (int i = 0; i < lightCount; ++i) {
        LightData light = lights[i];
        vec3 toLight = -lightDirection(light, hitVs);
        float cosine = dot(normal, toLight);
        if (cosine <= 0.0) continue;
        TracedRay ray = tracedRay(hitVs, toLight, withLeftSide(0u, kLeftBothSides));
        RaySegment segment = clipRay(ray.origin, ray.direction);
        if (segment.visible) {
            SceneLayerHit blocker = searchSceneLayers(ray, segment, true);
            float reach = uint(light.positionVs.w) == kLightDirectional
                              ? 3.0e38
                              : length(light.positionVs.xyz - hitVs);
            if (blocker.layer >= 0 && blocker.t < reach) continue;
        }
        radiance += lightIrradiance(light, hitVs) * cosine *
                    receiverBrdf(albedo, lobe.rgb, lobe.w, normal, toLight, -direction);
    }
    return radiance;
}

SceneHit searchScene(TracedRay ray) {
    RaySegment segment = clipRay(ray.origin, ray.direction);
    if (!segment.visible) return emptySceneHit(ray.origin, ray.direction, false);
    SceneLayerHit hit = searchSceneLayers(ray, segment, false);
    if (hit.layer < 0) {
        return emptySceneHit(ray.origin, ray.direction, segment.cause == kAccountUnresolved);
    }
    LayerSurface surface = sceneLayerAt(hit.texel, hit.layer);
    vec4 shaded = texelFetch(sceneSurfaces, ivec3(hit.texel, hit.layer), 0);
    vec3 hitVs = ray.origin + hit.t * ray.direction;
    float seen = texelFetch(receiver, hit.texel, 0).x;
    // Whether the image shows this very surface.
    bool isSeen = abs(abs(seen) - surface.depth) <= 1e-5 * surface.depth;
    if (materialKind(surface.material - 1u) == kMaterialMirror) {
        return SceneHit(surface.material, true, false, hit.t, hit.texel,
                        isSeen ? mirrorNormalAround(hitVs, shaded) : shaded.xyz, vec3(0.0));
    }
    bool isFront = dot(ray.direction, surface.normal) < 0.0;
    // The image shows one side of a surface.
    bool isShown = isSeen && seen > 0.0 && isFront == (dot(hitVs, surface.normal) < 0.0);
    vec3 emitted = isFront ? materials[surface.material - 1u].emission.rgb : vec3(0.0);
    vec3 radiance = isShown
                        ? radianceOfSeen(hitVs, ray.direction, hit.texel, surface.normal,
                                         surface.material, shaded.xyz)
                        : emitted + radianceOfHidden(hitVs, ray.direction,
                                                     isFront ? shaded.xyz : -shaded.xyz,
                                                     surface.material);
    return SceneHit(surface.material, false, false, hit.t, hit.texel, vec3(0.0), radiance);
}
#endif

// What the ray that goes on sees; `media` as for a photon.
SceneHit lookThrough(vec3 origin, vec3 direction, uint media) {
    return searchesScene != 0 ? searchScene(tracedRay(origin, direction, media))
                               : noSceneHit();
}

// From mirror to mirror through the medium `medium` (material index + 1) or 0, until something
// other than a mirror is seen. True: more mirrors than may be were hit.
bool followMirrors(inout MirrorPath path, inout SceneHit seen, uint medium) {
    while (seen.material != 0u && seen.isMirror) {
        if (path.mirrors >= lookMirrors) {
            seen = noSceneHit();
            return true;
        }
        path.share *= mediumTransmittance(medium, seen.t);
        reflectAt(path, path.origin + seen.t * path.direction, seen.normal, seen.material);
        seen = lookThrough(path.origin, path.direction, path.media);
    }
    return false;
}

// Mean radiance of one material's receivers around a pixel: what its pattern does there says
// nothing of a place next to the screen. False: the pixel has none.
bool meanRadianceAround(ivec2 pixel, out vec3 mean) {
    const int kReach = 3;
    const int kStep = 5;  // px
    mean = vec3(0.0);
    bool isThere = pixel.x >= 0 && texelFetch(receiver, pixel, 0).x > 0.0;
    float material = isThere ? texelFetch(receiverSurface, pixel, 0).w : 0.0;
    float count = 0.0;
    int side = isThere ? 2 * kReach + 1 : 0;  // devices without branches still leave a loop out
    for (int i = 0; i < side * side; ++i) {
        ivec2 step = kStep * (ivec2(i % side, i / side) - kReach);
        ivec2 other = clamp(pixel + step, ivec2(0), ivec2(view.sizePixels.xy) - 1);
        if (texelFetch(receiver, other, 0).x <= 0.0) continue;
        if (texelFetch(receiverSurface, other, 0).w != material) continue;
        mean += texelFetch(receiverRadiance, other, 0).rgb;
        count += 1.0;
    }
    mean /= max(count, 1.0);
    return isThere;
}

// Radiance along a ray that starts at `origin` within the medium `medium` (material index + 1) of
// an open surface, or 0, of which `seen` is known. Where nothing is known of what it hits: in
// water, which has no end to see, the receiver straight beyond the surface at `pixel`, else those
// that the screen shows next to where the ray leaves the scene; in the open the environment.
vec3 radianceAlong(vec3 origin, vec3 direction, uint medium, SceneHit seen, ivec2 pixel) {
    if (seen.material != 0u) return seen.radiance * mediumTransmittance(medium, seen.t);
    if (medium != 0u && !seen.isOpen) {
        float straight = texelFetch(receiver, pixel, 0).x;
        if (straight > -origin.z) {
            float behind = (straight + origin.z) * length(viewRay(vec2(pixel) + 0.5));
            return texelFetch(receiverRadiance, pixel, 0).rgb * mediumTransmittance(medium, behind);
        }
        vec3 mean;
        if (meanRadianceAround(seen.lastPixel, mean))
            return mean * mediumTransmittance(medium, seen.t);
    }
    return environmentRadiance(direction) * mediumTransmittance(medium, 1e30);
}

// Radiance of the reflection at the first interface, of a ray in `medium`.
vec3 radianceReflected(vec3 origin, vec3 direction, uint medium, uint media, ivec2 pixel) {
    if (reflectsScene == 0) {
        return radianceAlong(origin, direction, medium, noSceneHit(), pixel);
    }
    MirrorPath path = MirrorPath(origin, direction, vec3(1.0), media, 0);
    SceneHit seen = lookThrough(origin, direction, media);
    followMirrors(path, seen, medium);
    return path.share * radianceAlong(path.origin, path.direction, medium, seen, pixel);
}

// What the eye's ray sees that hits a mirror first: where it leaves the last one.
struct MirrorView {
    vec3 radiance;
    vec4 exitPosition;   // as ExitPosition
    vec4 exitDirection;  // as ExitDirection
};
MirrorView lookIntoMirror(ivec2 pixel, vec3 viewing) {
    vec4 surface = firstSurface(pixel);
    MirrorPath path = MirrorPath(vec3(0.0), normalize(viewing), vec3(1.0), 0u, 0);
    reflectAt(path, viewing * firstDepth(pixel), surface.xyz, uint(surface.w));
    SceneHit seen = reflectsScene != 0 ? lookThrough(path.origin, path.direction, path.media)
                                       : noSceneHit();
    bool isCut = followMirrors(path, seen, 0u);
    return MirrorView(
        path.share * radianceAlong(path.origin, path.direction, 0u, seen, pixel),
        vec4(path.origin, float(path.mirrors)),
        vec4(path.direction, isCut ? kPathMirrorLimit : kPathExited));
}
