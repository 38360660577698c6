// SPDX-License-Identifier: MIT
// What the eye sees in and through a caustic generator: its ray is followed among the layers around
// that (U08, section 6: "when secondary reflective or refractive rays are traced" the cube map "can be
// looked up" too), and where it ends, whether the picture shows that or not, the receiver is lit by
// the lights past what casts shadows there, as the lights' own maps tell, and by the light that is
// stored around the generator.
// Radiance changes by T at every interface and by 1/n² where what is seen lies in a medium of index n
// (hard case 28a), and is absorbed on the way. Fragments of other generators are left out.
//   HAS_LIGHTS         the scene has any
//   LIGHT_IS_STORED    there is a map of it
//   GLOSSY_RECEIVERS   which knows where it comes from
#include "tracing/secant.glsl"
#include "include/surfaces/environment.glsl"
#include "include/views/view_outputs.glsl"
#include "include/surfaces/generators.glsl"
#ifdef HAS_LIGHTS
#include "include/views/light_shadow.glsl"
#endif
#define MAP_IS_CUBE
#ifdef GLOSSY_RECEIVERS
#define MEAN_INCIDENCE
#endif
#include "include/maps/map_lookup.glsl"
#include "include/maps/mean_direction.glsl"
#include "include/surfaces/spread_lobe.glsl"

uniform sampler2DArray mapAlbedo;
uniform int generatorIndex;
#ifdef HAS_LIGHTS
uniform int lightCount;
#endif
uniform vec4 eyeFrustum;  // as ViewData has them
uniform vec4 eyeSizePixels;

FirstHit firstAround(vec3 origin, vec3 direction, uint media) {
    bool isCut;
    return searchAround(Photon(origin, 0.0, direction, kFateInFlight, vec3(0.0), media),
                        view_around_stride, view_around_max_steps, view_around_refinements, isCut);
}

// The map of a generator.
void lookUpIn(int generator) {
#ifdef SEVERAL_CUBES
    mapCube = generator;
    mapShift = (generators.references[generator] - generators.references[0]).xyz *
               mat3(generators.eyeToWorld);
#endif
}

// Of a receiver: where the reference point sees it, else its material's first colour.
vec3 albedoAt(vec3 positionVs, vec3 normalVs, uint material) {
    lookUpIn(generatorIndex);
    MapPlace place = placeOf(positionVs, normalVs);
    if (place.face >= 0) {
        ivec2 texel = ivec2(floor(place.pixel));
        vec2 seen = mapReceiverAt(texel, place.face);
        if (seesPlace(place, texel, seen, mapNormalAt(texel, place.face)))
            return texelFetch(mapAlbedo, ivec3(texel, place.face), 0).rgb;
    }
    return materials[material - 1u].albedo.rgb;
}

// Radiance of a receiver back along a ray; `normal`: unit, towards the side that is looked at.
vec3 radianceOf(vec3 positionVs, vec3 direction, vec3 normal, uint material) {
    vec3 albedo = albedoAt(positionVs, normal, material);
    vec4 lobe = materials[material - 1u].specular;
    viewIndex = 0;
    vec3 sum = (albedo + lobe.rgb) * (1.0 / 3.14159265) * view.ambient.rgb;
#ifdef HAS_LIGHTS
    for (int i = 0; i < lightCount; ++i) {
        vec3 toLight = -lightDirection(lights[i], positionVs);
        float cosine = dot(normal, toLight);
        vec3 irradiance = cosine > 0.0 ? lightIrradiance(lights[i], positionVs) : vec3(0.0);
        if (irradiance == vec3(0.0)) continue;
        // Everything specular blocks it: what passes through that is stored light.
        float visible = visibleShare(shadowPlaceOf(positionVs, shadowLayersOf(i)), normal);
        sum += irradiance * (visible * cosine) *
               receiverBrdf(albedo, lobe.rgb, lobe.w, normal, toLight, -direction);
    }
#endif
#ifdef LIGHT_IS_STORED
    Gathered stored = Gathered(vec3(0.0), vec3(0.0));
    for (int i = 0; i < int(generators.count.x); ++i) {
        lookUpIn(i);
        Gathered one = gatherAt(positionVs, normal, direction);
        stored.irradiance += one.irradiance;
        stored.direction += one.direction;
    }
    stored.irradiance = rec709OfFlux(stored.irradiance);
    float all = stored.irradiance.r + stored.irradiance.g + stored.irradiance.b;
    if (all > 0.0) {
        MeanDirection mean = MeanDirection(normal, 1.0);
#ifdef GLOSSY_RECEIVERS
        mean = meanDirectionOf(stored.irradiance, stored.direction);
#endif
        sum += stored.irradiance * spreadBrdf(albedo, lobe.rgb, lobe.w, normal, mean.towards,
                                              -direction, mean.resultant);
    }
#endif
    return sum;
}

struct AroundPath {
    vec3 origin;  // of its last piece
    vec3 direction;
    vec3 share;  // of the radiance that mirrors, interfaces and media leave, without 1/n²
    uint media;
    int hits;
    float ending;  // kPath…
};

// At a specular surface with this normal, by bendingNormal: on, refracted, or where all is reflected
// or it is a mirror, reflected. The share that a dielectric reflects, and its direction.
float turn(inout AroundPath path, vec3 positionVs, vec3 normal, uint material,
           out vec3 reflectedDirection) {
    bool enters = dot(path.direction, normal) < 0.0;
    path.origin = positionVs;
    ++path.hits;
    path.media = withLeftSide(path.media, kLeftNone);
    reflectedDirection = normalize(reflect(path.direction, normal));
    if (materialKind(material - 1u) == kMaterialMirror) {
        path.share *= materials[material - 1u].albedo.rgb;
        path.direction = reflectedDirection;
        if (isOpen(material - 1u))
            path.media = withLeftSide(path.media, enters ? kLeftOutside : kLeftInside);
        return 0.0;
    }
    vec2 indices = indicesAt(material, path.media, enters);
    Interface interaction = interactAt(path.direction, normal, indices.x, indices.y);
    reflectedDirection = interaction.reflected;
    if (interaction.reflectance >= 1.0) {
        path.direction = interaction.reflected;
        return 0.0;
    }
    path.direction = interaction.refracted;
    path.share *= 1.0 - interaction.reflectance;
    if (enters && !canEnter(path.media, material)) {
        path.ending = kPathNestingLimit;
    } else {
        path.media = enters ? enterMedium(path.media, material)
                            : leaveMedium(path.media, material);
    }
    return interaction.reflectance;
}

// Reflected parts of the eye's ray that wait to be followed.
const int kMaxBranches = 8;
AroundPath waiting[kMaxBranches];
int waitingCount = 0;
int branchCount = 1;  // of this ray of the eye, the refracted one included

// Whether the branch will be followed: there is room for `view.around.branches` of a ray.
bool keepForLater(AroundPath branch) {
    if (branchCount >= view_around_branches) return false;
    ++branchCount;
    waiting[waitingCount] = branch;
    ++waitingCount;
    return true;
}

// At a specular surface, where the refracted part goes on and the reflected one waits. Without room
// for both the stronger is followed, unless the path is the one that exits are told of
// (`isRefracted`), which is refracted unless all is reflected.
void part(inout AroundPath path, vec3 positionVs, vec3 normal, uint material, bool isRefracted) {
    AroundPath reflected = path;
    float reflectance = turn(path, positionVs, normal, material, reflected.direction);
    if (reflectance <= 0.0) return;
    reflected.origin = positionVs;
    reflected.share *= reflectance;
    reflected.media = withLeftSide(reflected.media, kLeftNone);
    ++reflected.hits;
    if (!keepForLater(reflected) && !isRefracted && reflectance > 0.5) path = reflected;
}

// Of a path that comes to nothing that the layers show, W/m²/sr. Outside of water that is the
// environment; water ends at something, which the reference points do not see, and of which the
// receiver straight behind the pixel is what is known (as include/views/scene_look.glsl has it).
vec3 radianceOfUnseen(AroundPath path, ivec2 pixel) {
    uint medium = innerMedium(path.media);
    if (medium != 0u && isOpen(medium - 1u)) {
        float behind = texelFetch(receiver, pixel, 0).x + path.origin.z;
        if (behind > 0.0) {
            // Along a ray that hardly goes away from the eye no farther than ten times that.
            float meters = behind / max(-path.direction.z, 0.1);
            return texelFetch(receiverRadiance, pixel, 0).rgb * mediumTransmittance(medium, meters);
        }
    }
    return environmentRadiance(directionFromEye(path.direction)) *
           mediumTransmittance(medium, 1e30);
}

// What the path sees at last, W/m²/sr, with what is left of it.
vec3 follow(inout AroundPath path, ivec2 pixel, bool isRefracted) {
    for (int i = 0; i <= view_around_interfaces && path.ending > kPathLost; ++i) {
        FirstHit first = firstAround(path.origin, path.direction, path.media);
        if (first.hit.layer < 0) {
            if (isInsideClosed(path.media)) path.ending = kPathLost;
            viewIndex = 0;
            return path.share * radianceOfUnseen(path, pixel);
        }
        viewIndex = first.face;
        vec4 surface = texelFetch(layerSurfaces, layerTexel(first.pixel, first.hit.layer), 0);
        LayerSurface layer = layerAt(first.pixel, first.hit.layer);
        vec3 there = path.origin + first.hit.t * path.direction;
        path.share *= mediumTransmittance(innerMedium(path.media), first.hit.t);
        uint material = layer.material;
        vec3 geometric = directionToEye(layer.normal);
        if (isReceiver(materialKind(material - 1u))) {
            vec3 normal = receiverNormal(there, path.direction, directionToEye(surface.xyz), geometric);
            float side = dot(path.direction, geometric) < 0.0 ? 1.0 : -1.0;
            vec3 emitted = side > 0.0 ? materials[material - 1u].emission.rgb : vec3(0.0);
            return path.share *
                   (emitted + radianceOf(there, path.direction, side * normal, material));
        }
        if (i == view_around_interfaces) break;
        vec3 shading =
            directionToEye(smoothSurfaceAt(pointFromEye(there), surface, layer).normal);
        vec3 normal = bendingNormal(path.direction, shading, geometric, material, path.media);
        part(path, there, normal, material, isRefracted);
    }
    if (path.ending > kPathLost) path.ending = kPathEndedInside;
    viewIndex = 0;
    return path.share * environmentRadiance(directionFromEye(path.direction));
}

// 1/n² of where it ends, times n² of where the eye is.
float solidAngles(uint mediaAtEye, uint media) {
    float ratio = mediumIndex(innerMedium(mediaAtEye)) / mediumIndex(innerMedium(media));
    return ratio * ratio;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = firstDepth(pixel);
    if (depth <= 0.0) discard;
    vec3 viewing =
        vec3((positionOfSample(pixel) * eyeSizePixels.zw * 2.0 - 1.0) * eyeFrustum.xy, -1.0);
    vec3 entry = viewing * depth;
    if (generators.count.x > 1u && generatorOf(entry) != generatorIndex) discard;
    vec4 surface = firstSurface(pixel);
    uint material = uint(surface.w);
    vec3 direction = normalize(viewing);
    // An eye that looks at a dielectric from within is inside of it.
    bool isEyeInside = materialKind(material - 1u) == kMaterialDielectric &&
                       dot(direction, surface.xyz) > 0.0;
    uint mediaAtEye = isEyeInside ? enterMedium(0u, material) : 0u;
    AroundPath path =
        AroundPath(vec3(0.0), direction, mediumTransmittance(innerMedium(mediaAtEye), length(entry)),
                   mediaAtEye, 0, kPathExited);
    vec3 normal = bendingNormal(direction, surface.xyz, surface.xyz, material, mediaAtEye);
    part(path, entry, normal, material, true);
    vec3 seen = follow(path, pixel, true);
    exitPosition = vec4(path.origin, float(path.hits));
    exitDirection = vec4(path.direction, path.ending);
    seen *= solidAngles(mediaAtEye, path.media);
    while (waitingCount > 0) {
        --waitingCount;
        AroundPath branch = waiting[waitingCount];
        vec3 reflected = follow(branch, pixel, false);
        seen += reflected * solidAngles(mediaAtEye, branch.media);
    }
    radiance = vec4(seen, 1.0);
    finishPixel();
}
