// SPDX-License-Identifier: MIT
// Where the light of a map comes from at a place: its flux of all channels times 1 + the direction
// in which it arrives, over its flux, is 1 + the mean of those directions.

struct MeanDirection {
    vec3 towards;     // unit, back to where light comes from; 0 where there is no light
    float resultant;  // length of the mean: 1 where all directions are the same
};

// Both over the same area. `moment`: as include/maps/deposit.glsl adds it up.
MeanDirection meanDirectionOf(vec3 irradiance, vec3 moment) {
    float all = irradiance.r + irradiance.g + irradiance.b;
    if (!(all > 0.0)) return MeanDirection(vec3(0.0), 0.0);
    vec3 mean = moment / all - 1.0;
    float size = length(mean);
    // Where light comes from everywhere alike any direction is its mean.
    return MeanDirection(size > 1e-6 ? -mean / size : vec3(0.0, 0.0, 1.0), size);
}
