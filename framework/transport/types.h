// SPDX-License-Identifier: MIT
// The types that flow between stages, defined once: C++ and GLSL both read this file. SI units,
// linear Rec.709, view space of the eye (right-handed, the eye looks down -Z, camera-relative);
// depth is planar view depth, -z, in metres, of the view that a texture was rasterised in.
#pragma once

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace kaustik::transport {
using glm::mat4;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = unsigned int;
#endif

// A view, the eye's or another, in a uniform block (std140).
struct ViewData {
    // xy: tan of half the field of view, or where rays are parallel half of the extent in m; z:
    // near plane in m; w: metres that a pixel covers at a depth of 1 m, or at any.
    vec4 frustum;
    vec4 sizePixels;      // width, height, 1/width, 1/height
    mat4 viewToWorld;     // rotation only
    mat4 fromEye;         // from the eye's view space to this view's, rigid
    vec4 farMeters;       // x: far plane where rays are parallel, m
    vec4 boundsCenterVs;  // of the scene's world-axis bounding box, m
    // Half of the box's extent along the world's axes, m; w: the margin in it that rays are cut
    // with (viewData), m.
    vec4 boundsHalfExtent;
    vec4 background;        // radiance that comes from outside of the scene, W/m²/sr
    vec4 ambient;           // constant fill light for the picture, W/m²
    vec4 mediumScattering;  // of what fills the scene: rgb 1/m; w: Henyey-Greenstein g
    vec4 mediumExtinction;  // rgb: scattering and absorption, 1/m
    vec4 environment;       // x: image layer of the environment, -1 none; y: its turn, rad
};

const uint kMaxViews = 6u;  // of a block: the faces of a cube, a light's further maps

// One placed mesh, for one view (std430).
struct InstanceData {
    mat4 modelToView;
    mat4 normalToView;  // inverse transpose, upper 3x3
    // x: index into the materials; y: the number of its first triangle, of all in the order in
    // which the scene is drawn; z: its first index; w: 2 * its first vertex, + 1 where that is one
    // of the height fields' (include/surfaces/scene_triangle.glsl).
    uvec4 material;
};

const uint kMaterialLambertian = 0u;
const uint kMaterialDielectric = 1u;
const uint kMaterialMirror = 2u;
const uint kMaterialGlossy = 3u;

// One material (std430).
struct MaterialData {
    vec4 albedo;         // rgb: reflectance; w: kind
    vec4 patternAlbedo;  // rgb: second colour; w: pattern (0 none, 1 checker, 2 tiles)
    vec4 absorption;     // rgb: 1/m inside; w: index of refraction
    vec4 uv;          // xy: scale; z: image layer, -1 none; w: 1 where the surface is open (water)
    vec4 specular;    // glossy, the lobe of brdf.h: rgb its reflectance; w: exponent
    vec4 emission;    // rgb: radiance of its front, W/m²/sr
    vec4 normalMap;   // x: image layer, -1 none; y: what its x and y are multiplied by
    vec4 dispersion;  // of the index (include/surfaces/bands.glsl)
    // x: a dielectric's number (scene/dielectrics.h), 0 for what is none; y: index + 1 of the
    // material with the number of this one's index + 1; z: the base of stacks of such numbers, and
    // w: what is above all that fit (media_stack.h), the same in every material.
    vec4 medium;
};

// One light, in the view space of the eye (std430).
const uint kLightDirectional = 0u;
const uint kLightPoint = 1u;
const uint kLightSpot = 2u;
const uint kLightSurface = 3u;  // a point of one: its intensity falls with the cosine
struct LightData {
    vec4 positionVs;   // w: kind
    vec4 directionVs;  // unit, from the light outwards; w: range in m, 0 unlimited
    vec4 power;    // rgb: W/m² (directional) or W/sr; w: the radius of the disc of a light with
                   // a size that it stands for, rad (directional) or m, 0: a point
    vec4 cone;     // x: cos of the inner half-angle, y: of the outer; z: tan of the outer
    vec4 rightVs;  // spot, the image that multiplies its power: unit, to its right; w: layer, -1
                   // none
    vec4 upVs;     // unit, to its top
};

// A part of the spectrum (scene/spectrum.h), in a uniform block (std140). Lights come band by band,
// as many in each.
struct BandData {
    vec4 tint;        // xyz: times a colour, the share of light that it lets through; w: the place
    vec4 ofLight[3];  // columns: times a light's Rec.709, its flux
};
const uint kMaxBands = 64u;
struct BandTable {
    vec4 rec709FromFlux[3];  // columns
    vec4 lights;             // x: how many there are in each band
    BandData bands[kMaxBands];
};

// One vertex (std430); also a vertex buffer.
struct VertexData {
    vec3 position;
    float u;
    vec3 normal;
    float v;
};

// What has become of a photon.
const uint kFateNone = 0u;      // there is no photon: its texel hit no specular surface
const uint kFateInFlight = 1u;  // it is to be traced
const uint kFateReceiver = 2u;  // it has reached a receiver
const uint kFateSpecular = 3u;  // it has reached a specular surface and will interact there
const uint kFateEnded = 4u;     // its flux is in the ledger

// What a stack of dielectrics takes of a number that a float holds exactly; kLeft… takes the rest.
const uint kMediaRoom = 4194304u;
const uint kLeftNone = 0u;  // or what it cannot hit again from the same side: see hit_test.glsl
const uint kLeftOutside = 1u;
const uint kLeftInside = 2u;
// A ray that asks whether anything is in its way: it hits every surface from either side, but for
// the one that it starts on.
const uint kLeftBothSides = 3u;

// How many photons there are. They are texels 0, 1, ... of their textures, row by row from the
// bottom; what lies beyond holds no photons. The last seven are the arguments of an indirect
// dispatch of kPhotonGroup threads and of an indirect draw of an instance of four vertices a
// photon.
struct PhotonList {
    uint count;
    uint rowLength;  // texels
    uint groupsX;
    uint groupsY;
    uint groupsZ;
    uint vertices;
    uint instances;
    uint firstVertex;
    uint firstInstance;
};
const uint kPhotonGroup = 64u;
const uint kMaxGroupsX = 32768u;

// A cell of a light's view, of 2^level by 2^level, from the lower left (std430): what adaptive
// photons are emitted by (WN09, section 3.2).
struct LightCell {
    uint x;
    uint y;
    uint level;
    // Bits 0 to 3: of its four quarters, right: 1, up: 2, those whose light its photon carries;
    // none of them: it carries the whole cell's. From bit 8 on: the light.
    uint lightAndQuarters;
};

// What has become of an adaptive traversal, on the device.
const uint kSquareLevels = 16u;
struct CellCounts {
    uint moreCells;    // not 0: there are cells to look at and room for what comes of them
    uint moreBatches;  // not 0: there are cells left once the batch's photons are done
    uint waiting;      // cells
    uint taken;        // of them, in this round
    uint photons;      // of this batch
    // The counts from here on are of the whole frame.
    uint probes;
    uint emitted;    // photons
    uint merged;     // of them those that stand for several of a cell's quarters
    uint discarded;  // cells that hold nothing specular
    uint deepest;    // level of a photon's cell
    uint rounds;
    uint batches;
    // Of a mip map of photons those that a walk from its top has looked at, of 2^i by 2^i cells.
    uint squares[kSquareLevels];
};

// Where a photon comes from: one texel, RGBA32UI, which has `branch` above the light's 16 bits.
struct PhotonOrigin {
    uint cell;  // of its light's grid, row by row; or the number that its emitter gave it
    uint light;
    uint path;    // a bit an interaction, the last one lowest: 1 reflected, 0 refracted, below a 1
    uint parent;  // in the list before its last interaction
    // Of the photons that one emitted has become, by the byte: its number, and how many more than
    // itself it may become (specular.split); the following ones' numbers follow its own.
    uint branch;
};
const uint kEmittedPath = 1u;

// A photon after its last specular interaction: one texel of the transfer map (K06, section 2),
// three RGBA32F textures.
struct Photon {
    vec3 positionVs;
    float footprintMeters;  // side of the square that its beam covers, at right angles to it, when
                            // it is emitted: interactions leave it as it is
    vec3 directionVs;       // unit
    uint fate;
    vec3 fluxWatts;  // where the scene has bands: as scene/spectrum.h has it
    uint media;      // the dielectrics around it, and the side that it has just left: media_stack.h
};

// The place where a photon arrived: three RGBA32F textures, and a fourth where photons have beams,
// by the photon's own texel.
struct Hit {
    vec3 positionVs;
    float distanceMeters;  // travelled since the last interaction
    vec3 normalVs;         // outward: the shading normal, or the triangle's where the shading
                    // normal would send light to the wrong side (include/surfaces/specular.glsl)
    uint material;   // index + 1; 0: no surface
    vec3 fluxWatts;  // that arrives
    uint fate;
    vec3 shape;  // how the normal turns, 1/m (include/photons/beam.glsl); where photons have beams
};

// How the eye's path through specular surfaces has ended; above 0 it has come out.
const float kPathExited = 1.0f;
const float kPathLost = 0.0f;
// The path has reached a cap. kPathReflectionLimit: it was totally reflected too often, or was
// refracted as often as may be and is still inside of a closed object, out of which it is taken to
// have come as it was.
const float kPathReflectionLimit = -1.0f;
const float kPathMirrorLimit = -2.0f;   // by mirrors; it is taken to see the environment
const float kPathNestingLimit = -3.0f;  // in more dielectrics at once than a stack holds
const float kPathEndedInside = 2.0f;
// What is added to them where a texel that says how a path has ended is 0 if there was none.
const float kPathMet = 4.0f;

// Accounts of the energy ledger (framework/README.md, "The energy ledger"). The device sums the
// three channels; reports say their mean (transport/watts.h).
const uint kAccountEmitted = 0u;
const uint kAccountDeposited = 1u;
const uint kAccountAbsorbed = 2u;
const uint kAccountLeftScene = 3u;
const uint kAccountUntracedBranch = 4u;
const uint kAccountEmissionSampling = 5u;
const uint kAccountOffScreen = 6u;
const uint kAccountBehindEye = 7u;
const uint kAccountBeyondLastLayer = 8u;
const uint kAccountEdgeOn = 9u;
const uint kAccountMissedByTracer = 10u;
const uint kAccountInternalReflectionLimit = 11u;
const uint kAccountBounceLimit = 12u;
// Light between photons that cannot be joined to triangles, where nothing else covers it.
const uint kAccountDiscardedTriangle = 13u;
const uint kAccountOccludedSplat = 14u;
const uint kAccountNotANumber = 15u;
const uint kAccountUnresolved = 16u;
// What arrived at receivers before it was reconstructed; this is not part of the balance.
const uint kAccountArrived = 17u;
// Light in a dielectric inside of more others than a stack holds.
const uint kAccountNestingLimit = 18u;
// Light stored in another view than the eye's: what arrived next to that view, and behind what it
// sees.
const uint kAccountOutsideMap = 19u;
const uint kAccountHiddenInMap = 20u;
// Lost because a paper is followed to the letter, where no light is lost in truth.
const uint kAccountAsPublished = 21u;
// Those before this one are all that a reference has.
const uint kReferenceAccounts = 21u;
// Not part of the balance: what lights send onto what they see of specular surfaces, however it is
// emitted; measured alone.
const uint kAccountEmittable = 22u;
// Not part of the balance: rays with more receivers than slots.
const uint kAccountFullSlots = 23u;
// Not part of the balance: light that a shading normal would send to the wrong side of its
// triangle, and that is bent by the triangle's own normal.
const uint kAccountTriangleNormal = 24u;
const uint kAccountCount = 25u;

// A sum of watts in 64-bit fixed point, so that it neither drifts nor depends on the order:
// watts = (high * 2^32 + low) * quantum. `events` counts the additions.
struct LedgerEntry {
    uint low;
    uint high;
    uint events;
    uint traced;  // of the first account: photons of all lists that were handed to tracers
};

// A map of flux is summed the same way, three channels of two words each: layers 2c and 2c + 1 of
// an array of R32UI are the low and the high word of channel c.
const uint kFluxWords = 6u;
// Radiant intensity towards the eye may be much larger than the flux that it is of: its quantum is
// so much larger, 1/sr.
const float kIntensityQuantum = 1024.0f;

// Counts over the pixels of the layered depth (K06, section 2.2).
struct LayerStatistics {
    uint complexity;     // most fragments in a pixel
    uint fragments;      // in all pixels
    uint skipped;        // fragments beyond the last layer
    uint pixelsSkipped;  // pixels that have such fragments
};

// Lines, splats or beams whose width is a bound and not what their photons asked for (std430). A
// photon that several batches bring counts in one of them.
struct Clamped {
    uint count;
    // By which factor that differs at most, above 1; the bits of a float, which are ordered as
    // their values are.
    uint factorBits;
    uint lowUnits;  // flux of all channels, as the ledger has it
    uint highUnits;
};

// In the word of a hit's step (HitOrder): its surroundings lie beyond the border of the tile.
const uint kStrayed = 0x80000000u;

#ifdef __cplusplus
}  // namespace kaustik::transport
#endif
