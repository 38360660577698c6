// SPDX-License-Identifier: MIT
// How a receiver reflects light that comes from many directions, of which a mean is known.
#include "framework/transport/brdf.h"

// The mean of a receiver's BRDF over those directions, 1/sr. `toMean`: unit, towards their mean;
// `resultant`: how long the mean of their unit vectors is, 1 where all are the same. Spread
// directions make the lobe wider, as Toksvig 2005 has it for normals ("Mipmapping Normal Maps"): a
// convolution on the sphere keeps a lobe's integral, and its mean cosine, (n + 1)/(n + 2) of cos^n,
// becomes `resultant` times as large. The lobe here is the one of a cosine's power that has both.
vec3 spreadBrdf(vec3 albedo, vec3 specular, float exponent, vec3 normal, vec3 toMean, vec3 toEye,
                float resultant) {
    float loss = (exponent + 1.0) * (1.0 - clamp(resultant, 0.0, 1.0));
    float wider = max((exponent - 2.0 * loss) / (1.0 + loss), 1e-3);
    vec3 kept = specular * ((exponent + 2.0) * (wider + 1.0) / ((exponent + 1.0) * (wider + 2.0)));
    return receiverBrdf(albedo, kept, wider, normal, toMean, toEye);
}
