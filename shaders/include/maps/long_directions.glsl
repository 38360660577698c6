// SPDX-License-Identifier: MIT
// What a gather says of mean directions that are longer than 1 (techniques/maps/directions.h).
#include "include/photons/ledger_unit.glsl"

layout(std430) buffer LongDirections {
    uvec2 longDirections;  // how many, and the longest, the bits of a float
};

// What a map's rounding to whole units brings to a length is less, of as many units as asked for.
const float kMaxResultant = 1.001;
const float kMinUnits = 1e5;

// `watts`: of all channels, at the place.
void checkDirection(float resultant, float watts) {
    if (resultant <= kMaxResultant || watts * ledgerUnitsPerWatt < kMinUnits) return;
    atomicAdd(longDirections.x, 1u);
    atomicMax(longDirections.y, floatBitsToUint(resultant));
}
