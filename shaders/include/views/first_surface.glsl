// SPDX-License-Identifier: MIT
// What a ray of the eye meets first. MORE_SAMPLES: it is one of several of its pixel (view.samples);
// BESIDE_MIDDLE: it does not go through the middle.
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

// Where in the picture the pixel's ray starts, px.
vec2 positionOfSample(ivec2 pixel) {
#ifdef BESIDE_MIDDLE
    return vec2(pixel) + 0.5 + sampleOffset;
#else
    return vec2(pixel) + 0.5;
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

// Of several samples each adds its share to the pixel; a middle that is none of them adds nothing.
void weigh(inout vec4 radiance) {
#ifdef MORE_SAMPLES
    radiance = sampleShare > 0.0 ? vec4(radiance.rgb, 1.0) * sampleShare : vec4(0.0);
#endif
}
