// SPDX-License-Identifier: MIT
// A map of flux looked up at a place in the scene, as a shadow map is (WD06; U08, section 4.3). Of the
// four texels around it those count that see the place's own surface, on its own side, by their
// planes: nothing leaks over an edge, and nothing is lost at one. The flux of a texel over its area
// on the receiver is the irradiance.
//   MAP_IS_CUBE, MAP_IS_PARALLEL  what the map's views are
//   MEAN_INCIDENCE                also where the light comes from
//   SEVERAL_CUBES                 of several, one after the other in the arrays, mapCube says which
#include "framework/transport/types.h"

layout(std140) uniform MapViews {
    ViewData mapViews[kMaxViews];
};
#ifdef MAP_IS_CUBE
uniform sampler2DArray mapReceiver;
uniform sampler2DArray mapSurface;
#else
uniform sampler2D mapReceiver;
uniform sampler2D mapSurface;
#endif
uniform sampler2DArray filteredFlux;
uniform int mapCount;  // of its views
uniform int setsPerView;
#ifdef SEVERAL_CUBES
int mapCube = 0;
vec3 mapShift = vec3(0.0);  // of its middle from the first one's, the eye's view space, m
int mapLayer(int face) {
    return mapCube * mapCount + face;
}
#else
const vec3 mapShift = vec3(0.0);
int mapLayer(int face) {
    return face;
}
#endif

vec2 mapReceiverAt(ivec2 texel, int face) {
#ifdef MAP_IS_CUBE
    return texelFetch(mapReceiver, ivec3(texel, mapLayer(face)), 0).xy;
#else
    return texelFetch(mapReceiver, texel, 0).xy;
#endif
}
vec3 mapNormalAt(ivec2 texel, int face) {
#ifdef MAP_IS_CUBE
    return texelFetch(mapSurface, ivec3(texel, mapLayer(face)), 0).xyz;
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
        vec3 point = (mapViews[face].fromEye * vec4(positionVs - mapShift, 1.0)).xyz;
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

// `towards`: from whoever looks to the place; all in the eye's view space, m.
Gathered gatherAt(vec3 positionVs, vec3 normalVs, vec3 towards) {
    Gathered result = Gathered(vec3(0.0), vec3(0.0));
    MapPlace place = placeOf(positionVs, normalVs);
    if (place.face < 0) return result;
    // Whoever looks and the map look at the same side.
    bool eyesFront = dot(normalVs, towards) < 0.0;
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
        int set = mapLayer(place.face) * setsPerView;
        float overArea = weight / seen.y;
        result.irradiance += texelFetch(filteredFlux, ivec3(texel, set), 0).rgb * overArea;
#ifdef MEAN_INCIDENCE
        result.direction += texelFetch(filteredFlux, ivec3(texel, set + 1), 0).rgb * overArea;
#endif
    }
    if (weights <= 0.0) return result;
    result.irradiance /= weights;
    result.direction /= weights;
    return result;
}

