// SPDX-License-Identifier: MIT
// One photon a vertex of a specular mesh, for one light: a thread a vertex. What the light does not
// see first is nobody. ONLY_BEAMS: their beams and extents instead, since OpenGL grants a program no
// more than eight images. VERTEX_GRID: the mesh is a grid, whose vertices stand for quarters of its
// cells.
#include "include/thread.glsl"
#include "include/photons/neighbour_batch.glsl"
#include "include/photons/cell_extent.glsl"
#include "include/views/light_depth.glsl"
#include "include/photons/beam.glsl"
#include "include/photons/lights.glsl"
#include "include/surfaces/specular.glsl"
#include "include/photons/next_photon_list.glsl"
#ifdef ONLY_BEAMS
#include "include/photons/store_beams.glsl"
#else
#include "include/photons/store_hits.glsl"
#include "include/photons/store_photons.glsl"
#endif

layout(std430) readonly buffer Instances {
    InstanceData instances[];
};
layout(std430) readonly buffer MeshVertices {
    VertexData meshVertices[];
};
layout(std430) readonly buffer Fans {
    uvec2 fans[];  // the other two corners of each triangle around a vertex
};
layout(std430) readonly buffer FanFirsts {
    uint fanFirsts[];
};
uniform sampler2DArray lightDepths;
uniform mat4 projection;
uniform mat4 eyeToLight;
uniform int lightIndex;
uniform uint object;
uniform int sides;         // from which light comes, kFrom…
uniform uint vertexCount;  // of the object
uniform uint firstVertex;
uniform uint firstFan;
uniform uint firstCell;
uniform int batchCells;    // of one light in this batch
uniform int firstOfBatch;  // the cell that the batch begins with
uniform ivec2 ownCells;    // from and before: others are there to be joined with
uniform int firstOfLight;  // where its photons begin in the list
#ifdef VERTEX_GRID
uniform ivec2 gridSize;  // vertices along both sides
const float kShareOfTriangle = 0.25;
#else
const float kShareOfTriangle = 1.0 / 3.0;
#endif
#if defined(VERTEX_GRID) && defined(ONLY_BEAMS)
layout(rg32ui) writeonly uniform uimage2D nextExtents;
#endif

const int kFromOutside = 1;
const int kFromInside = 2;

// What of the triangles around a vertex the light hits from one side.
struct LitArea {
    float across;  // the vertex's share of their areas across the light's direction, m²
    vec3 outward;  // mean normal, weighted by area; any length
};

void addTriangle(inout LitArea lit, float across, vec3 area) {
    lit.across += 0.5 * kShareOfTriangle * across;
    lit.outward += area;
}

// The side that light comes from; where a sheet shows both at a vertex, the one that takes more.
LitArea litAround(uint vertex, vec3 direction, out bool isWithin) {
    mat3 toView = mat3(instances[object].modelToView);
    // A mirrored mesh is wound the other way round.
    float winding = determinant(toView) < 0.0 ? -1.0 : 1.0;
    LitArea outside = LitArea(0.0, vec3(0.0));
    LitArea within = LitArea(0.0, vec3(0.0));
    vec3 middle = meshVertices[firstVertex + vertex].position;
    uint end = fanFirsts[firstFan + vertex + 1u];
    for (uint i = fanFirsts[firstFan + vertex]; i < end; ++i) {
        vec3 b = toView * (meshVertices[firstVertex + fans[i].x].position - middle);
        vec3 c = toView * (meshVertices[firstVertex + fans[i].y].position - middle);
        vec3 area = winding * cross(b, c);
        float across = dot(direction, area);
        if (across < 0.0) {
            addTriangle(outside, -across, area);
        } else if (across > 0.0) {
            addTriangle(within, across, area);
        }
    }
    isWithin = sides == kFromInside || (sides != kFromOutside && within.across > outside.across);
    return isWithin ? within : outside;
}

#ifdef PHOTON_BEAMS
vec3 unitNormalVs(uint vertex) {
    vec3 normal = mat3(instances[object].normalToView) * meshVertices[vertex].normal;
    return normal / max(length(normal), 1e-12);
}

// How the normals around a vertex turn, by least squares over the corners of its triangles.
vec3 shapeAround(uint vertex, vec3 normal) {
    mat3 toView = mat3(instances[object].modelToView);
    mat2x3 tangents = basisAcross(normal);
    vec3 middle = meshVertices[firstVertex + vertex].position;
    vec3 own = unitNormalVs(firstVertex + vertex);
    mat2 moved = mat2(0.0);
    mat2 turned = mat2(0.0);
    uint end = fanFirsts[firstFan + vertex + 1u];
    for (uint i = fanFirsts[firstFan + vertex]; i < end; ++i) {
        for (int k = 0; k < 2; ++k) {
            uint corner = firstVertex + fans[i][k];
            vec2 offset = (toView * (meshVertices[corner].position - middle)) * tangents;
            vec2 turn = (unitNormalVs(corner) - own) * tangents;
            moved += outerProduct(offset, offset);
            turned += outerProduct(turn, offset);
        }
    }
    // Scaled to about 1, so that nothing underflows.
    float size = moved[0][0] + moved[1][1];
    if (!(size > 0.0)) return vec3(0.0);
    moved /= size;
    if (!(determinant(moved) > 1e-6)) return vec3(0.0);
    return shapeOfForm((turned / size) * inverse(moved));
}
#endif

#ifdef ONLY_BEAMS
#ifdef VERTEX_GRID
ivec2 placeInGrid(uint vertex) {
    return ivec2(int(vertex) % gridSize.x, int(vertex) / gridSize.x);
}

// From a vertex to the next along one side of the mesh, m: the mean of the steps to either side, or
// the only one at a border.
vec3 stepAlong(uint vertex, ivec2 side) {
    ivec2 at = placeInGrid(vertex);
    ivec2 low = max(at - side, ivec2(0));
    ivec2 high = min(at + side, gridSize - 1);
    uint a = firstVertex + uint(low.y * gridSize.x + low.x);
    uint b = firstVertex + uint(high.y * gridSize.x + high.x);
    ivec2 steps = high - low;
    return mat3(instances[object].modelToView) *
           (meshVertices[b].position - meshVertices[a].position) / float(steps.x + steps.y);
}

// How the next vertices' rays differ. `spread`: by how much the light turns, rad/m.
Beam beamOf(uint vertex, vec3 direction, float spread) {
    mat2x3 steps = mat2x3(stepAlong(vertex, ivec2(1, 0)), stepAlong(vertex, ivec2(0, 1)));
    mat2 place = transpose(basisAcross(direction)) * steps;
    return beamFromPoint(place, spread * place);
}

// A vertex at the border of the mesh stands for nothing beyond it.
uvec2 extentOf(uint vertex) {
    ivec2 at = placeInGrid(vertex);
    CellQuarter quarters[4];
    bool isWhole = true;
    for (uint i = 0u; i < 4u; ++i) {
        ivec2 across = at + ivec2(sideOfQuarter(i));
        bvec2 isInside = equal(across, clamp(across, ivec2(0), gridSize - 1));
        vec2 reach = mix(vec2(0.0), vec2(0.5), isInside);
        quarters[i] = CellQuarter(reach.x, reach.y, reach);
        isWhole = isWhole && all(isInside);
    }
    return isWhole ? uvec2(0u) : packedExtent(quarters);
}
#else
// A vertex has no cell: its beam is as wide as the area around it, either way.
Beam beamOf(float footprint, float spread) {
    return beamFromPoint(mat2(footprint), mat2(spread * footprint));
}
#endif
#endif

// Whether the light sees the point before anything else: by most of the four texels around it, each
// by its nearness, so that no shadow's edge is off by more than half a texel on the average.
bool isSeen(vec3 positionVs, vec3 normalVs) {
    vec3 positionLs = (eyeToLight * vec4(positionVs, 1.0)).xyz;
    vec4 clip = projection * vec4(positionLs, 1.0);
    // The view ends at the outermost vertices, give or take their rounding.
    if (!(clip.w > 0.0) || any(greaterThan(abs(clip.xy), vec2(1.0001 * clip.w)))) return false;
    ivec2 size = textureSize(lightDepths, 0).xy;
    vec2 at = (clip.xy / clip.w * 0.5 + 0.5) * vec2(size);
    vec2 texelMeters = 2.0 * clip.w / (vec2(projection[0][0], projection[1][1]) * vec2(size));
    vec3 normalLs = mat3(eyeToLight) * normalVs;
    ivec2 first = ivec2(floor(at - 0.5));
    vec2 f = at - 0.5 - vec2(first);
    float seen = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        ivec2 texel = clamp(first + step, ivec2(0), size - 1);
        vec2 axis = mix(1.0 - f, f, vec2(step));
        vec4 nearest = texelFetch(lightDepths, ivec3(texel, lightOfBand(uint(lightIndex))), 0);
        vec2 neighbourOffset = at - (vec2(texel) + 0.5);
        bool reaches = reachesLight(nearest, neighbourOffset, texelMeters, -positionLs.z,
                                    length(positionVs), normalLs);
        seen += reaches ? axis.x * axis.y : 0.0;
    }
    return seen >= 0.5;
}

void main() {
    uint vertex = threadNumber();
    if (vertex >= vertexCount) return;
    uint cell = firstCell + vertex;
    int inBatch = int(cell) - firstOfBatch;
    if (inBatch < 0 || inBatch >= batchCells) return;
    takeBandOf(uint(lightIndex));
    InstanceData instance = instances[object];
    LightData light = lights[lightIndex];
    VertexData data = meshVertices[firstVertex + vertex];
    vec3 positionVs = (instance.modelToView * vec4(data.position, 1.0)).xyz;
    if (!isFinite(positionVs)) return;
    vec3 direction = lightDirection(light, positionVs);
    bool isWithin;
    LitArea lit = litAround(vertex, direction, isWithin);
    float size = length(lit.outward);
    if (!(lit.across > 0.0) || !(size > 0.0)) return;
    vec3 geometric = lit.outward / size;
    if (!isSeen(positionVs, geometric)) return;

    uint material = instance.material.x;
    bool isDielectric = materialKind(material) == kMaterialDielectric;
    uint media = isDielectric && isWithin ? enterMedium(0u, material + 1u) : 0u;
    float footprint = sqrt(lit.across);
    float spread = 0.0;  // of the light, rad/m
    vec3 flux = light.power.rgb * lit.across;
    if (uint(light.positionVs.w) != kLightDirectional) {
        float distance = length(positionVs - light.positionVs.xyz);
        spread = 1.0 / distance;
        flux = lightIntensity(light, positionVs, footprint / distance) *
               (lit.across / (distance * distance)) *
               mediumTransmittance(innerMedium(media), distance);
    }
    flux = fluxOfBand(flux);
    if (!isFinite(flux) || !(flux.r + flux.g + flux.b > 0.0)) return;
    if (int(cell) < ownCells.x || int(cell) >= ownCells.y) flux *= kNegligible;
    vec3 shading = mat3(instance.normalToView) * data.normal;
    float length2 = dot(shading, shading);
    shading = length2 > 1e-24 ? shading * inversesqrt(length2) : geometric;
    vec3 normal = bendingNormal(direction, shading, geometric, material + 1u, media);
    uint slot = uint(firstOfLight + inBatch);
#ifdef ONLY_BEAMS
#ifdef VERTEX_GRID
    storeNextBeam(slot, beamOf(vertex, direction, spread));
    imageStore(nextExtents, ivec2(photonTexel(nextPhotons, slot)), uvec4(extentOf(vertex), 0u, 0u));
#else
    storeNextBeam(slot, beamOf(footprint, spread));
#endif
#else
    storeNext(slot, Photon(positionVs, footprint, direction, kFateSpecular, flux, media),
              PhotonOrigin(cell, uint(lightIndex), kEmittedPath, 0u, 0u));
    vec3 shape = vec3(0.0);
#ifdef PHOTON_BEAMS
    shape = shapeAround(vertex, normal);
#endif
    storeHit(ivec2(photonTexel(nextPhotons, slot)),
             Hit(positionVs, 0.0, normal, material + 1u, flux, kFateSpecular, shape));
#endif
}
