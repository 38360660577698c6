// SPDX-License-Identifier: MIT
// Replaces what a sample of a frame gives by the mean over the samples so far (eye.samples).
layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f) uniform image2D meanOfSamples;  // remembered from sample to sample
layout(rgba32f) uniform image2D ofSample;
uniform int sampleNumber;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(meanOfSamples)))) return;
    vec4 mean = imageLoad(ofSample, pixel);
    if (sampleNumber > 0) {
        vec4 before = imageLoad(meanOfSamples, pixel);
        mean = before + (mean - before) / float(sampleNumber + 1);
    }
    imageStore(meanOfSamples, pixel, mean);
    imageStore(ofSample, pixel, mean);
}
