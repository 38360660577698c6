// SPDX-License-Identifier: MIT
// gather.project: what a light's caustic map holds where the eye's receivers lie, as a shadow map is
// looked up (WD06). Of the four texels around a place those count that see the eye's own surface, on
// its own side, by their planes: nothing leaks over an edge, and nothing is lost at one. The flux of
// a texel over its area on the receiver is the irradiance. A pixel that spans several texels is the
// mean of several places of it.
#include "include/view.glsl"
#ifdef GLOSSY_RECEIVERS
#include "include/receiver_brdf.glsl"
#endif

layout(std140) uniform MapViews {
    ViewData mapViews[kMostViews];
};
#ifdef MAP_IS_CUBE
uniform sampler2DArray mapReceiver;
uniform sampler2DArray mapSurface;
#else
uniform sampler2D mapReceiver;
uniform sampler2D mapSurface;
#endif
uniform sampler2DArray filteredFlux;
uniform sampler2D receiver;
uniform sampler2D receiverSurface;
uniform int mapCount;
uniform int setsPerView;

layout(location = 0) out vec4 irradiance;
#ifdef GLOSSY_RECEIVERS
layout(location = 1) out vec4 radiance;
#endif

vec2 mapReceiverAt(ivec2 texel, int face) {
#ifdef MAP_IS_CUBE
    return texelFetch(mapReceiver, ivec3(texel, face), 0).xy;
#else
    return texelFetch(mapReceiver, texel, 0).xy;
#endif
}
vec3 mapNormalAt(ivec2 texel, int face) {
#ifdef MAP_IS_CUBE
    return texelFetch(mapSurface, ivec3(texel, face), 0).xyz;
#else
    return texelFetch(mapSurface, texel, 0).xyz;
#endif
}

// Towards a texel's middle, of a depth of 1 m, and where it is at depth 0.
vec3 mapRay(ViewData map, vec2 pixel) {
#ifdef MAP_IS_PARALLEL
    return vec3(0.0, 0.0, -1.0);
#else
    return vec3((pixel * map.sizePixels.zw * 2.0 - 1.0) * map.frustum.xy, -1.0);
#endif
}
vec3 mapPoint(ViewData map, vec2 pixel, float depth) {
#ifdef MAP_IS_PARALLEL
    return vec3((pixel * map.sizePixels.zw * 2.0 - 1.0) * map.frustum.xy, -depth);
#else
    return mapRay(map, pixel) * depth;
#endif
}
vec2 mapPixelOf(ViewData map, vec3 point) {
#ifdef MAP_IS_PARALLEL
    vec2 ndc = point.xy / map.frustum.xy;
#else
    vec2 ndc = point.xy / (-point.z * map.frustum.xy);
#endif
    return (ndc * 0.5 + 0.5) * map.sizePixels.xy;
}
float mapFootprint(ViewData map, float depth) {
#ifdef MAP_IS_PARALLEL
    return map.frustum.w;
#else
    return map.frustum.w * depth;
#endif
}

// A place on the eye's receiver, as a map sees it.
struct MapPlace {
    int face;  // -1: none of the map's
    vec3 point;
    vec3 normal;
    vec2 pixel;
};

MapPlace placeOf(vec3 positionVs, vec3 normalVs) {
    for (int face = 0; face < mapCount; ++face) {
        vec3 point = (mapViews[face].fromEye * vec4(positionVs, 1.0)).xyz;
        if (-point.z <= mapViews[face].frustum.z) continue;
        vec2 pixel = mapPixelOf(mapViews[face], point);
        if (any(lessThan(pixel, vec2(0.0)))) continue;
        if (any(greaterThanEqual(pixel, mapViews[face].sizePixels.xy))) continue;
        return MapPlace(face, point, mat3(mapViews[face].fromEye) * normalVs, pixel);
    }
    return MapPlace(-1, vec3(0.0), vec3(0.0), vec2(0.0));
}

// How far a surface may turn between a texel's middle and the place: 60 degrees, as for shadows.
const float kSameSurface = 0.5;

// Whether a texel sees the surface that the place lies on.
bool seesPlace(MapPlace place, ivec2 texel, vec2 seen, vec3 normal) {
    if (seen.x <= 0.0 || dot(normal, place.normal) < kSameSurface) return false;
    ViewData map = mapViews[place.face];
    vec3 middle = mapPoint(map, vec2(texel) + 0.5, seen.x);
    vec3 ray = mapRay(map, vec2(texel) + 0.5);
    // A curved surface leaves the plane of a texel by a share of what the texel spans of it.
    float slant = max(abs(dot(normal, normalize(ray))), 0.1);
    float allowed = 0.5 * mapFootprint(map, seen.x) / slant + 1e-5 * seen.x;
    return abs(dot(normal, place.point - middle)) <= allowed;
}

struct Gathered {
    vec3 irradiance;
    vec3 direction;  // flux of all channels times 1 + direction, over the area
};

Gathered gatherAt(vec3 positionVs, vec3 normalVs) {
    Gathered result = Gathered(vec3(0.0), vec3(0.0));
    MapPlace place = placeOf(positionVs, normalVs);
    if (place.face < 0) return result;
    // The eye and the light look at the same side.
    bool eyesFront = dot(normalVs, positionVs) < 0.0;
    bool lightsFront = dot(place.normal, mapRay(mapViews[place.face], place.pixel)) < 0.0;
    if (eyesFront != lightsFront) return result;
    vec2 corner = place.pixel - 0.5;
    ivec2 first = ivec2(floor(corner));
    vec2 f = corner - vec2(first);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        ivec2 texel = first + step;
        if (any(lessThan(texel, ivec2(0)))) continue;
        if (any(greaterThanEqual(texel, ivec2(mapViews[place.face].sizePixels.xy)))) continue;
        vec2 seen = mapReceiverAt(texel, place.face);
        if (!seesPlace(place, texel, seen, mapNormalAt(texel, place.face))) continue;
        vec2 axis = mix(1.0 - f, f, vec2(step));
        float weight = max(axis.x * axis.y, 1e-6);
        weights += weight;
        int set = place.face * setsPerView;
        float overArea = weight / seen.y;
        result.irradiance += texelFetch(filteredFlux, ivec3(texel, set), 0).rgb * overArea;
#ifdef GLOSSY_RECEIVERS
        result.direction += texelFetch(filteredFlux, ivec3(texel, set + 1), 0).rgb * overArea;
#endif
    }
    if (weights <= 0.0) return result;
    result.irradiance /= weights;
    result.direction /= weights;
    return result;
}

// What is seen of the receiver's plane so many pixels beside the middle.
vec3 besideMiddle(vec2 offset, vec3 positionVs, vec3 normalVs) {
    vec3 ray = viewRay(gl_FragCoord.xy + offset);
    float facing = dot(normalVs, ray);
    // Edge-on there is no telling.
    if (abs(facing) < 0.05 * length(ray)) return positionVs;
    return ray * (dot(normalVs, positionVs) / facing);
}

// Places along a side of the pixel: one a texel that it spans.
int placesAcross(vec3 positionVs, vec3 normalVs) {
    MapPlace middle = placeOf(positionVs, normalVs);
    if (middle.face < 0) return 1;
    float texels = 0.0;
    for (int axis = 0; axis < 2; ++axis) {
        vec2 offset = 0.5 * vec2(1 - axis, axis);
        MapPlace edge = placeOf(besideMiddle(offset, positionVs, normalVs), normalVs);
        if (edge.face == middle.face)
            texels = max(texels, 2.0 * distance(edge.pixel, middle.pixel));
    }
    return clamp(int(ceil(texels - 0.25)), 1, gather_project_places);
}

void main() {
    irradiance = vec4(0.0);
#ifdef GLOSSY_RECEIVERS
    radiance = vec4(0.0);
#endif
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(receiver, pixel, 0).x;
    if (depth <= 0.0) return;
    vec4 surface = texelFetch(receiverSurface, pixel, 0);
    vec3 positionVs = viewRay(gl_FragCoord.xy) * depth;
    int places = placesAcross(positionVs, surface.xyz);
    Gathered sum = Gathered(vec3(0.0), vec3(0.0));
    for (int i = 0; i < places * places; ++i) {
        vec2 offset = (vec2(i % places, i / places) + 0.5) / float(places) - 0.5;
        vec3 there =
            places == 1 ? positionVs : besideMiddle(offset, positionVs, surface.xyz);
        Gathered one = gatherAt(there, surface.xyz);
        sum.irradiance += one.irradiance;
        sum.direction += one.direction;
    }
    float overPlaces = 1.0 / float(places * places);
    irradiance = vec4(sum.irradiance * overPlaces, 0.0);
#ifdef GLOSSY_RECEIVERS
    float all = sum.irradiance.r + sum.irradiance.g + sum.irradiance.b;
    if (all <= 0.0) return;
    vec3 direction = sum.direction / all - 1.0;
    float size = length(direction);
    if (!(size > 1e-6)) return;
    radiance = vec4(irradiance.rgb * receiverReflection(pixel, surface, -direction / size), 0.0);
#endif
}
