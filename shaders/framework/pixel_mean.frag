// SPDX-License-Identifier: MIT
// The mean of the samples of a pixel (eye.samples), a square of texels.
layout(location = 0) out vec4 mean;

uniform sampler2D ofSamples;
uniform int samplesPerSide;

void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * samplesPerSide;
    vec4 sum = vec4(0.0);
    for (int y = 0; y < samplesPerSide; ++y) {
        for (int x = 0; x < samplesPerSide; ++x)
            sum += texelFetch(ofSamples, first + ivec2(x, y), 0);
    }
    mean = sum / float(samplesPerSide * samplesPerSide);
}
