// SPDX-License-Identifier: MIT
// What a ray of the eye meets first. MORE_SAMPLES: it is one of several of its pixel (view.samples);
// BESIDE_MIDDLE: it does not go through the middle.
#include "include/octahedral.glsl"
#include "include/view.glsl"

uniform sampler2D interfaceDepth;
uniform sampler2D interfaceSurface;
uniform sampler2D receiver;
uniform sampler2D receiverSurface;
uniform sampler2D receiverRadiance;
#ifdef MORE_SAMPLES
uniform float sampleShare;  // of the pixel
#endif
#ifdef BESIDE_MIDDLE
uniform vec2 sampleOffset;  // px
uniform sampler2D sight;    // SightTexel
uniform sampler2D sightSurface;
#endif

// Where in the picture the ray of this fragment starts, px.
vec2 positionOfSample() {
#ifdef BESIDE_MIDDLE
    return gl_FragCoord.xy + sampleOffset;
#else
    return gl_FragCoord.xy;
#endif
}

// View depth of the specular surface that the eye's ray meets first, m; 0: it meets none, or a
// receiver before.
float firstDepth(ivec2 pixel) {
#ifdef BESIDE_MIDDLE
    return max(texelFetch(sight, pixel, 0).x, 0.0);
#else
    return texelFetch(interfaceDepth, pixel, 0).x;
#endif
}

// Its shading normal, and its material index + 1.
vec4 firstSurface(ivec2 pixel) {
#ifdef BESIDE_MIDDLE
    return texelFetch(sightSurface, pixel, 0);
#else
    return texelFetch(interfaceSurface, pixel, 0);
#endif
}

// What the eye's ray sees that meets no specular surface: the receiver at the pixel's middle, unless
// the ray's is a nearer or a farther one, at an edge within the pixel; then that of the pixels
// beside which is nearest to it in depth.
vec4 radianceStraight(ivec2 pixel) {
#ifdef BESIDE_MIDDLE
    float depth = max(-texelFetch(sight, pixel, 0).x, 0.0);
    float middle = texelFetch(receiver, pixel, 0).x;
    float nearest = abs(depth - middle);
    vec3 normal = texelFetch(receiverSurface, pixel, 0).xyz;
    if (middle > 0.0 && nearest <= depthMargin(viewRay(gl_FragCoord.xy), middle, normal))
        return texelFetch(receiverRadiance, pixel, 0);
    ivec2 towards = ivec2(sampleOffset.x < 0.0 ? -1 : 1, sampleOffset.y < 0.0 ? -1 : 1);
    ivec2 best = pixel;
    for (int i = 1; i < 4; ++i) {
        ivec2 other = clamp(pixel + towards * ivec2(i & 1, i >> 1), ivec2(0),
                            ivec2(view.sizePixels.xy) - 1);
        float difference = abs(depth - texelFetch(receiver, other, 0).x);
        if (difference >= nearest) continue;
        nearest = difference;
        best = other;
    }
    return texelFetch(receiverRadiance, best, 0);
#else
    return texelFetch(receiverRadiance, pixel, 0);
#endif
}

// Of several samples each adds its share to the pixel; a middle that is none of them adds nothing.
void weigh(inout vec4 radiance) {
#ifdef MORE_SAMPLES
    radiance = sampleShare > 0.0 ? vec4(radiance.rgb, 1.0) * sampleShare : vec4(0.0);
#endif
}
