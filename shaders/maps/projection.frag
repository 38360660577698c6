// SPDX-License-Identifier: MIT
// gather.project, gather.cube: what the caustic map of a light or of a generator holds where the eye's
// receivers lie. A pixel that spans several texels is the mean of several places of it.
//   MAP_HAS_PARTS        parts of it are in finer maps (reconstruct.map_cascades)
//   GLOSSY_RECEIVERS     also what glossy receivers reflect, of light from where the map is seen from
//   USES_MEAN_DIRECTION  or from about the mean of the directions in which it arrives
#include "include/surfaces/bands.glsl"
#include "include/views/view.glsl"
#ifdef GLOSSY_RECEIVERS
#ifdef USES_MEAN_DIRECTION
#define MEAN_INCIDENCE
#endif
#include "include/surfaces/receiver_brdf.glsl"
#include "include/maps/mean_direction.glsl"
#endif
#ifdef USES_MEAN_DIRECTION
#include "include/maps/long_directions.glsl"
#endif
#include "include/maps/map_lookup.glsl"
#include "include/maps/undersampled.glsl"
#include "techniques/raster_views/map_border.h"

uniform sampler2D receiver;
uniform sampler2D receiverSurface;
uniform int maxSamples;  // along a side of a pixel
#ifdef MAP_HAS_PARTS
layout(std140) uniform MapParts {
    ViewData mapParts[kMaxViews];
};
uniform int partCount;
uniform int part;  // that this map is, 0: the whole
#endif

layout(location = 0) out vec4 irradiance;
#ifdef GLOSSY_RECEIVERS
layout(location = 1) out vec4 radiance;
#endif

// What is seen of the receiver's plane so many pixels next to the middle.
vec3 sampleOnPlane(vec2 offset, vec3 positionVs, vec3 normalVs) {
    vec3 ray = viewRay(gl_FragCoord.xy + offset);
    float facing = dot(normalVs, ray);
    // Edge-on there is no telling.
    if (abs(facing) < 0.05 * length(ray)) return positionVs;
    return ray * (dot(normalVs, positionVs) / facing);
}

// Places along a side of the pixel that would be enough: one a texel that it spans.
int placesWanted(vec3 positionVs, vec3 normalVs) {
    MapPlace middle = placeOf(positionVs, normalVs);
    if (middle.face < 0) return 1;
    float texels = 0.0;
    for (int axis = 0; axis < 2; ++axis) {
        vec2 offset = 0.5 * vec2(1 - axis, axis);
        MapPlace edge = placeOf(sampleOnPlane(offset, positionVs, normalVs), normalVs);
        if (edge.face == middle.face)
            texels = max(texels, 2.0 * distance(edge.pixel, middle.pixel));
    }
    return int(clamp(ceil(texels - 0.25), 1.0, 1e6));
}

#ifdef MAP_HAS_PARTS
// Whether a part is looked up at a place: not in its border, where light is missing that has arrived
// next to it and reaches in.
bool isCoveredBy(ViewData map, vec3 positionVs) {
    vec3 point = (map.fromEye * vec4(positionVs, 1.0)).xyz;
    if (-point.z <= map.frustum.z) return false;
    vec2 at = mapPixelOf(map, point) * map.sizePixels.zw;
    return all(greaterThanEqual(at, vec2(kBorderOfPart))) &&
           all(lessThan(at, vec2(1.0 - kBorderOfPart)));
}

// Of all maps one is looked up in a pixel: the finest that has its middle, which is the last.
bool isOwn(vec3 positionVs) {
    int finest = partCount;
    while (finest > 0 && !isCoveredBy(mapParts[finest - 1], positionVs)) --finest;
    return finest == part;
}
#else
bool isOwn(vec3 positionVs) { return true; }
#endif

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
    if (!isOwn(positionVs)) return;
    int wanted = placesWanted(positionVs, surface.xyz);
    int places = min(wanted, maxSamples);
    Gathered sum = Gathered(vec3(0.0), vec3(0.0));
    for (int i = 0; i < places * places; ++i) {
        vec2 offset = (vec2(i % places, i / places) + 0.5) / float(places) - 0.5;
        vec3 there =
            places == 1 ? positionVs : sampleOnPlane(offset, positionVs, surface.xyz);
        Gathered one = gatherAt(there, surface.xyz, there);
        sum.irradiance += one.irradiance;
        sum.direction += one.direction;
    }
    float overPlaces = 1.0 / float(places * places);
    irradiance = vec4(rec709OfFlux(sum.irradiance) * overPlaces, 0.0);
    if (wanted > places && any(greaterThan(sum.irradiance, vec3(0.0))))
        countUndersampled(float(wanted) / float(places));
#ifdef GLOSSY_RECEIVERS
    float all = irradiance.r + irradiance.g + irradiance.b;
    if (all <= 0.0) return;
#ifdef USES_MEAN_DIRECTION
    MeanDirection mean = meanDirectionOf(sum.irradiance, sum.direction);
    if (mean.resultant <= 0.0) return;
    checkDirection(mean.resultant, all * texelFetch(receiver, pixel, 0).y);
#else
    vec3 fromCentre =
        mat3(transpose(mapViews[0].fromEye)) * (mapViews[0].fromEye * vec4(positionVs, 1.0)).xyz;
    MeanDirection mean = MeanDirection(-normalize(fromCentre), 1.0);
#endif
    radiance =
        vec4(irradiance.rgb * meanReflection(pixel, surface, mean.towards, mean.resultant), 0.0);
#endif
}
